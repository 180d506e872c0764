#include "physics_node/mesh/mesh_parts.h"

#include <algorithm>
#include <utility>

namespace palpate::physics {
namespace {

/// Which of the middles lies between two corners.
std::size_t edge_between(std::size_t a, std::size_t b) {
  for (std::size_t e = 0; e < tet_edges.size(); ++e)
    if ((tet_edges[e][0] == a && tet_edges[e][1] == b) || (tet_edges[e][0] == b && tet_edges[e][1] == a))
      return e;
  return 0;  // a and b differ, so it was found
}

struct Face {
  MeshTriangle sorted;
  std::size_t tet = 0, face = 0;
};

void add_triangles(const TetMesh& mesh, const Face& of, std::vector<MeshTriangle>& triangles) {
  const auto& corners = mesh.tets[of.tet];
  const auto& face = tet_faces[of.face];
  const Index a = corners[face[0]], b = corners[face[1]], c = corners[face[2]];
  if (mesh.middles.empty()) {
    triangles.push_back({a, b, c});
    return;
  }
  const auto middle = [&](std::size_t i, std::size_t j) {
    return mesh.middles[of.tet][edge_between(face[i], face[j])];
  };
  const Index ab = middle(0, 1), bc = middle(1, 2), ca = middle(2, 0);
  for (const MeshTriangle& part :
       {MeshTriangle{a, ab, ca}, MeshTriangle{ab, b, bc}, MeshTriangle{ca, bc, c}, MeshTriangle{ab, bc, ca}})
    triangles.push_back(part);
}

}  // namespace

OuterFaces outer_faces(const TetMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t f = 0; f < tet_faces.size(); ++f) {
      MeshTriangle sorted{mesh.tets[t][tet_faces[f][0]], mesh.tets[t][tet_faces[f][1]],
                          mesh.tets[t][tet_faces[f][2]]};
      std::ranges::sort(sorted);
      faces.push_back({sorted, t, f});
    }
  std::ranges::stable_sort(faces, {}, &Face::sorted);
  OuterFaces outer;
  for (auto first = faces.begin(); first != faces.end();) {
    const auto last =
        std::find_if(first, faces.end(), [&](const Face& f) { return f.sorted != first->sorted; });
    if (last - first == 1) add_triangles(mesh, *first, outer.triangles);
    if (last - first > 2) ++outer.of_more;
    first = last;
  }
  std::ranges::sort(outer.triangles);
  return outer;
}

std::vector<std::array<Index, 4>> filled_tets(const TetMesh& mesh) {
  std::vector<std::array<Index, 4>> tets;
  if (mesh.middles.empty()) tets = mesh.tets;
  for (std::size_t t = 0; t < mesh.middles.size(); ++t) {
    const auto& c = mesh.tets[t];
    const auto& [m01, m12, m02, m03, m13, m23] = mesh.middles[t];
    // Four at the corners, and round the diagonal 02-13 the octahedron between them.
    for (const std::array<Index, 4>& part : std::initializer_list<std::array<Index, 4>>{{c[0], m01, m02, m03},
                                                                                        {c[1], m01, m12, m13},
                                                                                        {c[2], m02, m12, m23},
                                                                                        {c[3], m03, m13, m23},
                                                                                        {m02, m13, m01, m12},
                                                                                        {m02, m13, m12, m23},
                                                                                        {m02, m13, m23, m03},
                                                                                        {m02, m13, m03, m01}})
      tets.push_back(part);
  }
  std::ranges::sort(tets);
  return tets;
}

NodeLists::NodeLists(std::size_t n_nodes, std::span<const std::pair<Index, Index>> pairs)
    : begin_(n_nodes + 1, 0) {
  entries_.reserve(pairs.size());
  for (const auto& [node, entry] : pairs) {
    ++begin_[static_cast<std::size_t>(node) + 1];
    entries_.push_back(entry);
  }
  for (std::size_t n = 0; n < n_nodes; ++n) begin_[n + 1] += begin_[n];
}

NodeLists neighbours_of(const TetMesh& mesh) {
  std::vector<std::pair<Index, Index>> pairs;
  const auto join = [&pairs](std::span<const Index> nodes) {
    for (const Index a : nodes)
      for (const Index b : nodes)
        if (a != b) pairs.emplace_back(a, b);
  };
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Index, 10> nodes{};
    const auto end = std::ranges::copy(mesh.tets[t], nodes.begin()).out;
    if (mesh.middles.empty()) {
      join({nodes.begin(), end});
      continue;
    }
    std::ranges::copy(mesh.middles[t], end);
    join(nodes);
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return NodeLists(mesh.nodes.size(), pairs);
}

}  // namespace palpate::physics
