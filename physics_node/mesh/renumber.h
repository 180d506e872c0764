#pragma once
// An order in which neighbours are near each other in memory.

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

/// Nodes along Morton's curve through the box of the mesh; tetrahedra by region, then by lowest node, so that a run of them has few
/// nodes. The same mesh in another order comes out the same, but for nodes at one place.
/// @return of each node where it was before  (nodes)
std::vector<Index> renumber(TetMesh& mesh);

}  // namespace palpate::physics
