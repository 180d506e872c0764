#pragma once
// A mesh made by formulas, for those who have none of an organ: a rounded, tapered and bent lobe of tetrahedra.

#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

/// About 120 x 86 x 48 mm, flat below and domed above, its +x end thinner and lower: 1,056 cells in six tetrahedra each, jittered inside.
/// Dihedral angles from 19 to 147 degrees. The same bits every time.
physics::TetMesh lobe_phantom();

/// What one unit of its file has [m].
inline constexpr double lobe_unit = 0.001;

}  // namespace palpate
