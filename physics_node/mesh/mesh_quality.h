#pragma once
// How good the tetrahedra of a mesh are for stepping.

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

/// Angles between two faces of a tetrahedron, of all in a mesh. A small one is a sliver, which shortens the step; a large one a flat
/// one, which is too stiff. Of an equilateral tetrahedron all are 70.5 degrees.
struct DihedralAngles {
  double least = 0, largest = 0;  // [rad]
};
DihedralAngles dihedral_angles(const TetMesh& mesh);

/// Of all tetrahedra, from a corner to the face across. [m]
double smallest_altitude(const TetMesh& mesh);

}  // namespace palpate::physics
