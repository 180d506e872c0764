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

/// What follows from nodes and faces.
void give_faces(MeshBody& body) {
  const std::size_t n = body.model.mesh.nodes.size();
  body.nodes.resize(n);
  std::iota(body.nodes.begin(), body.nodes.end(), 0);
  body.faces_of_first = parts_of_first(n, body.faces);
  body.filled_of_first = parts_of_first(n, body.filled);
  body.is_outer.assign(n, 0);
  for (const MeshTriangle& face : body.faces)
    for (const Index node : face) body.is_outer[static_cast<std::size_t>(node)] = 1;
  body.spacing = mean_edge(body.model.mesh, body.faces);
}

}  // namespace

MeshBody mesh_body(TetModel model) {
  MeshBody body;
  body.model = std::move(model);
  const TetMesh& mesh = body.model.mesh;
  body.mass = masses_of(body.model);
  body.neighbours = neighbours_of(mesh);
  body.faces = outer_faces(mesh).triangles;
  body.filled = filled_tets(mesh);
  body.longest_edge = longest_edge(mesh);
  give_faces(body);
  return body;
}

MeshBody mesh_body(SpringSurface surface) {
  MeshBody body;
  body.model.mesh.nodes = surface.mesh.nodes;
  body.model.beta = surface.membrane.beta;
  body.mass = surface.mass;
  body.faces = surface.mesh.triangles;
  std::vector<std::pair<Index, Index>> joined;
  for (const SurfaceSpring& spring : surface.springs) {
    const auto [a, b] = spring.node;
    joined.emplace_back(a, b), joined.emplace_back(b, a);
    body.longest_edge = std::max(body.longest_edge, spring.length);
  }
  std::ranges::sort(joined);
  body.neighbours = NodeLists(body.model.mesh.nodes.size(), joined);
  body.springs = std::move(surface);
  give_faces(body);
  return body;
}

}  // namespace palpate::physics
