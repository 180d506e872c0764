#include "physics_node/body/mesh_body.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace palpate::physics {
namespace {

double mean_edge(const TetMesh& mesh, const std::vector<MeshTriangle>& faces) {
  double sum = 0;
  for (const MeshTriangle& face : faces)
    for (std::size_t k = 0; k < 3; ++k)
      sum += (mesh.nodes[static_cast<std::size_t>(face[k])] -
              mesh.nodes[static_cast<std::size_t>(face[(k + 1) % 3])])
                 .norm();
  return sum / (3.0 * static_cast<double>(faces.size()));
}

double longest_edge(const TetMesh& mesh) {
  double longest2 = 0;
  for (const auto& corners : mesh.tets)
    for (const auto& [a, b] : tet_edges)
      longest2 = std::max(longest2, (mesh.nodes[static_cast<std::size_t>(corners[a])] -
                                     mesh.nodes[static_cast<std::size_t>(corners[b])])
                                        .squaredNorm());
  return std::sqrt(longest2);
}

}  // namespace

MeshBody mesh_body(TetModel model) {
  MeshBody body;
  body.model = std::move(model);
  const TetMesh& mesh = body.model.mesh;
  const std::size_t n = mesh.nodes.size();
  body.nodes.resize(n);
  std::iota(body.nodes.begin(), body.nodes.end(), 0);
  body.mass = masses_of(body.model);
  body.neighbours = neighbours_of(mesh);
  body.faces = outer_faces(mesh).triangles;
  body.faces_of_first = parts_of_first(n, body.faces);
  body.filled = filled_tets(mesh);
  body.filled_of_first = parts_of_first(n, body.filled);
  body.is_outer.assign(n, 0);
  for (const MeshTriangle& face : body.faces)
    for (const Index node : face) body.is_outer[static_cast<std::size_t>(node)] = 1;
  body.spacing = mean_edge(mesh, body.faces);
  body.longest_edge = longest_edge(mesh);
  return body;
}

}  // namespace palpate::physics
