#pragma once
// Cuts a mesh of tetrahedra along the surface where a field is zero, so that both sides share their nodes on it.

#include <functional>
#include <vector>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

struct SplitMesh {
  std::vector<bool> above;          // of each tetrahedron of the mesh now: where the field is above zero
  std::vector<std::size_t> parent;  // which tetrahedron of the mesh before it was, or was part of
};

/// As stuffing does: where the field crosses an edge near to its end, that node moves onto the crossing if the tetrahedra round it stay of good
/// shape, and counts as on the surface where it is if not; then what is left is cut. Outer nodes move along outer edges only.
/// @param field  of a place; continuous. What is exactly zero counts as above
SplitMesh split_mesh(physics::TetMesh& mesh, const std::function<double(const Vec3&)>& field);

}  // namespace palpate
