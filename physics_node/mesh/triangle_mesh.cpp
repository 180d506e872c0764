#include "physics_node/mesh/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

namespace palpate::physics {
namespace {

Vec3 place(const TriangleMesh& mesh, Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

/// An edge as one triangle has it: along or against the order of its nodes.
struct Side {
  Index low = 0, high = 0, triangle = 0;
  bool along = false;
  bool is_of(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), a < b});
    }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Calls take(first, last) for the sides of each edge.
template <class Take>
void each_edge(const std::vector<Side>& sides, const Take& take) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].is_of(sides[first])) ++last;
    take(first, last);
  }
}

}  // namespace

double enclosed_volume(const TriangleMesh& mesh) noexcept {
  if (mesh.nodes.empty()) return 0;
  const Vec3 from = mesh.nodes.front();  // near, so that no digits are lost
  const auto at = [&](Index node) { return Vec3(mesh.nodes[static_cast<std::size_t>(node)] - from); };
  double sum = 0;
  for (const MeshTriangle& corner : mesh.triangles)
    sum += at(corner[0]).dot(at(corner[1]).cross(at(corner[2]))) / 6;
  return sum;
}

double area_of(const TriangleMesh& mesh, const MeshTriangle& corners) noexcept {
  const Vec3 a = place(mesh, corners[0]);
  return 0.5 * (place(mesh, corners[1]) - a).cross(place(mesh, corners[2]) - a).norm();
}

bool is_flat(const TriangleMesh& mesh, const MeshTriangle& corners) noexcept {
  constexpr double least = 1e-6;
  double longest2 = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest2 =
        std::max(longest2, (place(mesh, corners[k]) - place(mesh, corners[(k + 1) % 3])).squaredNorm());
  return !(area_of(mesh, corners) > least * longest2);
}

TriangleMesh outer_surface(const TetMesh& mesh) {
  TriangleMesh surface;
  surface.triangles = outer_faces(mesh).triangles;
  constexpr Index unused = -1;
  std::vector<Index> number(mesh.nodes.size(), unused);
  for (const MeshTriangle& corner : surface.triangles)
    for (const Index node : corner) number[static_cast<std::size_t>(node)] = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] == unused) continue;
    number[n] = static_cast<Index>(surface.nodes.size());
    surface.nodes.push_back(mesh.nodes[n]);
  }
  for (MeshTriangle& corner : surface.triangles)
    for (Index& node : corner) node = number[static_cast<std::size_t>(node)];
  return surface;
}

std::vector<MeshEdge> edges_of(const TriangleMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<MeshEdge> edges;
  edges.reserve(sides.size() / 2);
  each_edge(sides, [&](std::size_t first, std::size_t last) {
    edges.push_back(
        {{sides[first].low, sides[first].high}, {sides[first].triangle, sides[last - 1].triangle}});
  });
  return edges;
}

std::size_t open_edges(const TriangleMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::size_t open = 0;
  each_edge(sides, [&](std::size_t first, std::size_t last) {
    const bool closed = last - first == 2 && sides[first].along != sides[first + 1].along;
    open += closed ? 0 : 1;
  });
  return open;
}

}  // namespace palpate::physics
