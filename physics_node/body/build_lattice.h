#pragma once
// From a shape to masses and elements.

#include "common/scene/scene_fwd.h"
#include "physics_node/body/cells.h"
#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// Masses at the corners of deformable cells, elements along the edges of their five tetrahedra. The share of a mass is
/// as many eighths of a cell as it has deformable cells around it.
Lattice voxel_lattice(const Cells& cells);

/// Masses at the points of a face-centred cubic lattice inside a shape, elements between all neighbours. The cubic axes are
/// those of the shape, but for the knife, whose edge is a row of neighbours.
///
///   sphere, tube  centred on a mass
///   box           starts at a mass in its lowest corner
///   knife         two (100) planes half a diagonal apart, the lower corner of the one in the tip; so the edge is one row
///   needle        a wall of two layers of masses. Masses with fewer than three elements, at the end of the bevel, are left out,
///                 and the lowest of the others is the tip; on its axis the cubic axis z.
///
/// @throws InputError: a cavity that takes nothing, a wall that fills the tube
Lattice fcc_lattice(const BodySpec& body);

/// The same inside an image: a mass wherever the cell nearest to its place is filled. Centred on a mass.
Lattice fcc_lattice(const BodySpec& body, const Cells& image);

/// Is this mass a corner of a filled cell that does not deform? Then it is held by the scenery.
bool touches_rigid_cell(const Cells& cells, const Lattice& lattice, Index cell);

/// Cell coordinate (i, j, k) of the image whose lowest corner is grid coordinate (0, 0, 0) of the lattice.
Vec3i lattice_corner(const Cells& cells, const Lattice& lattice);

}  // namespace palpate::physics
