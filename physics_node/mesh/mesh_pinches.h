#pragma once
// Where the surface of a mesh of tetrahedra touches itself: there a body would hang together by an edge or a point alone.

#include "physics_node/mesh/mesh_parts.h"

namespace palpate::physics {

struct Pinches {
  std::size_t edges = 0;      // of the surface that more than two of its triangles have
  std::size_t nodes = 0;      // of it, at whose triangles one cannot go round to all over edges
  Vec3 where = Vec3::Zero();  // the first of them [m]
  bool none() const noexcept { return edges == 0 && nodes == 0; }
};
Pinches pinches_of(const TetMesh& mesh, const OuterFaces& faces);

/// Of each tetrahedron: the number of the piece that it hangs together with over faces, from 0 on in the order of the tetrahedra.
std::vector<Index> pieces_of(const TetMesh& mesh);
std::size_t n_pieces_of(const TetMesh& mesh);

}  // namespace palpate::physics
