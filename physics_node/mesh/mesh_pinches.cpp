#include "physics_node/mesh/mesh_pinches.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace palpate::physics {
namespace {

/// What hangs together, as trees whose roots name the piece.
class Pieces {
 public:
  explicit Pieces(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t a) noexcept {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  /// @return false if they were one already
  bool join(std::size_t a, std::size_t b) noexcept {
    a = root(a), b = root(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
};

using Edge = std::array<Index, 2>;

Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

Pinches pinches_of(const TetMesh& mesh, const OuterFaces& faces) {
  const auto& triangles = faces.triangles;
  const auto place = [&](Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  Pinches found;
  const auto note = [&](const Vec3& where) {
    if (found.none()) found.where = where;
  };
  std::vector<std::pair<Edge, std::size_t>> at_edge;  // and the triangle
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t n = 0; n < 3; ++n)
      at_edge.emplace_back(edge_of(triangles[t][n], triangles[t][(n + 1) % 3]), t);
  std::ranges::sort(at_edge);

  // A corner of each triangle; those at one node are joined over the edges that they share there.
  Pieces fans(3 * triangles.size());
  const auto corner = [&](std::size_t t, Index node) {
    return 3 * t + static_cast<std::size_t>(std::ranges::find(triangles[t], node) - triangles[t].begin());
  };
  std::vector<bool> on_pinch(mesh.nodes.size());
  for (std::size_t first = 0; first < at_edge.size();) {
    std::size_t end = first + 1;
    for (; end < at_edge.size() && at_edge[end].first == at_edge[first].first; ++end)
      for (const Index node : at_edge[first].first)
        fans.join(corner(at_edge[first].second, node), corner(at_edge[end].second, node));
    if (end - first > 2) {
      const Edge& edge = at_edge[first].first;
      note(0.5 * (place(edge[0]) + place(edge[1])));
      ++found.edges;
      for (const Index node : edge) on_pinch[static_cast<std::size_t>(node)] = true;
    }
    first = end;
  }
  std::vector<std::size_t> n_fans(mesh.nodes.size());
  for (std::size_t c = 0; c < 3 * triangles.size(); ++c)
    if (fans.root(c) == c) ++n_fans[static_cast<std::size_t>(triangles[c / 3][c % 3])];
  for (std::size_t node = 0; node < n_fans.size(); ++node) {
    if (n_fans[node] < 2 || on_pinch[node]) continue;
    note(mesh.nodes[node]);
    ++found.nodes;
  }
  return found;
}

std::vector<Index> pieces_of(const TetMesh& mesh) {
  std::vector<std::pair<MeshTriangle, std::size_t>> of_face;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      MeshTriangle face{};
      for (std::size_t a = 0, n = 0; a < 4; ++a)
        if (a != left_out) face[n++] = mesh.tets[t][a];
      std::ranges::sort(face);
      of_face.emplace_back(face, t);
    }
  std::ranges::sort(of_face);
  Pieces pieces(mesh.tets.size());
  for (std::size_t f = 1; f < of_face.size(); ++f)
    if (of_face[f].first == of_face[f - 1].first) pieces.join(of_face[f].second, of_face[f - 1].second);
  std::vector<Index> number(mesh.tets.size());
  Index n = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)  // a root is the least of its piece
    number[t] = pieces.root(t) == t ? n++ : number[pieces.root(t)];
  return number;
}

std::size_t n_pieces_of(const TetMesh& mesh) {
  const std::vector<Index> piece = pieces_of(mesh);
  return piece.empty() ? 0 : static_cast<std::size_t>(*std::ranges::max_element(piece)) + 1;
}

}  // namespace palpate::physics
