#pragma once
// From a shape to masses and elements.

#include "physics_node/body/cells.h"
#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// Masses at the corners of deformable cells, elements along the edges of their five tetrahedra. The share of a mass is
/// as many eighths of a cell as it has deformable cells around it.
Lattice voxel_lattice(const Cells& cells);

/// Masses at the points of a face-centred cubic lattice inside a sphere, box or tube, elements between all
/// neighbours. The sphere and the tube are centred on a mass; a box starts at a mass in its lowest corner.
Lattice fcc_lattice(const BodySpec& body);

/// Is this mass a corner of a filled cell that does not deform? Then it is held by the scenery.
bool touches_rigid_cell(const Cells& cells, const Lattice& lattice, Index cell);

/// Cell coordinate (i, j, k) of the image whose lowest corner is grid coordinate (0, 0, 0) of the lattice.
Vec3i lattice_corner(const Cells& cells, const Lattice& lattice);

}  // namespace palpate::physics
