#include "physics_node/mesh/tet_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace palpate::physics {
namespace {

const Vec3& place(const TetMesh& mesh, Index node) noexcept {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

}  // namespace

double signed_volume(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept {
  const Vec3& x0 = place(mesh, corners[0]);
  const Vec3 a = place(mesh, corners[1]) - x0, b = place(mesh, corners[2]) - x0;
  const Vec3 c = place(mesh, corners[3]) - x0;
  return a.dot(b.cross(c)) / 6;
}

double volume_of(const TetMesh& mesh) noexcept {
  double sum = 0;
  for (const auto& tet : mesh.tets) sum += signed_volume(mesh, tet);
  return sum;
}

Eigen::AlignedBox3d box_of(const TetMesh& mesh) noexcept {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.nodes) box.extend(x);
  return box;
}

bool is_flat(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept {
  double longest2 = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b)
      longest2 = std::max(longest2, (place(mesh, corners[a]) - place(mesh, corners[b])).squaredNorm());
  return std::abs(signed_volume(mesh, corners)) <= 1e-9 * longest2 * std::sqrt(longest2);
}

Tidied tidy(TetMesh& mesh) {
  Tidied done;
  std::vector<Index> number(mesh.nodes.size(), -1);
  for (auto& corners : mesh.tets) {
    if (signed_volume(mesh, corners) < 0) std::swap(corners[2], corners[3]), ++done.turned;
    for (const Index node : corners) number[static_cast<std::size_t>(node)] = 0;
  }
  std::size_t used = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = static_cast<Index>(used);
    mesh.nodes[used++] = mesh.nodes[n];
  }
  done.unused = mesh.nodes.size() - used;
  mesh.nodes.resize(used);
  for (auto& corners : mesh.tets)
    for (Index& node : corners) node = number[static_cast<std::size_t>(node)];
  return done;
}

void add_middles(TetMesh& mesh) {
  std::map<std::pair<Index, Index>, Index> middle_of;
  mesh.middles.clear();
  for (const auto& corners : mesh.tets) {
    auto& middles = mesh.middles.emplace_back();
    for (std::size_t e = 0; e < tet_edges.size(); ++e) {
      const Index a = corners[tet_edges[e][0]], b = corners[tet_edges[e][1]];
      const auto [at, fresh] =
          middle_of.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.nodes.size()));
      if (fresh) mesh.nodes.push_back(0.5 * (place(mesh, a) + place(mesh, b)));
      middles[e] = at->second;
    }
  }
}

}  // namespace palpate::physics
