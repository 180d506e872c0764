#pragma once
// What a mesh of tetrahedra is made of, as others see it: its outer faces, the tetrahedra that it fills, and which nodes are joined.

#include <span>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

using MeshTriangle = std::array<Index, 3>;

/// Of second order the faces and tetrahedra below are those that the nodes in the middle of edges cut them into: four of a face, eight of
/// a tetrahedron.
struct OuterFaces {
  std::vector<MeshTriangle>
      triangles;            // of faces that one tetrahedron has; anticlockwise from outside; by first corner
  std::size_t of_more = 0;  // faces that more than two tetrahedra have: the mesh goes through itself
};
OuterFaces outer_faces(const TetMesh& mesh);

/// By first corner.
std::vector<std::array<Index, 4>> filled_tets(const TetMesh& mesh);

/// A list for each node.
class NodeLists {
 public:
  NodeLists() = default;
  /// @param pairs  (node, what is in its list); sorted
  NodeLists(std::size_t n_nodes, std::span<const std::pair<Index, Index>> pairs);
  std::span<const Index> of(Index node) const noexcept {
    const auto n = static_cast<std::size_t>(node);
    return {entries_.data() + begin_[n], entries_.data() + begin_[n + 1]};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Index> entries_;
};

/// Of each node those that share a tetrahedron with it, in rising order.
NodeLists neighbours_of(const TetMesh& mesh);

/// Numbers of the entries of `parts` that begin with each node. @param parts  triangles or tetrahedra, by first corner
template <class Part>
NodeLists parts_of_first(std::size_t n_nodes, const std::vector<Part>& parts) {
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t p = 0; p < parts.size(); ++p) pairs.emplace_back(parts[p][0], static_cast<Index>(p));
  return NodeLists(n_nodes, pairs);
}

}  // namespace palpate::physics
