#include "physics_node/mesh/mesh_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpate::physics {

DihedralAngles dihedral_angles(const TetMesh& mesh) {
  DihedralAngles angles{std::numbers::pi, 0};
  for (const auto& corners : mesh.tets) {
    const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(corners[a])]; };
    for (std::size_t e = 0; e < tet_edges.size(); ++e) {
      // The two faces at an edge hold one of the other corners each, which the opposite edge joins.
      const std::size_t a = tet_edges[e][0], b = tet_edges[e][1];
      std::array<std::size_t, 2> other{};
      for (std::size_t c = 0, n = 0; c < 4; ++c)
        if (c != a && c != b) other[n++] = c;
      const Vec3 along = (at(b) - at(a)).normalized();
      const auto across = [&](std::size_t c) -> Vec3 {
        const Vec3 d = at(c) - at(a);
        return d - d.dot(along) * along;
      };
      const Vec3 p = across(other[0]), q = across(other[1]);
      const double angle = std::atan2(p.cross(q).norm(), p.dot(q));
      angles.least = std::min(angles.least, angle);
      angles.largest = std::max(angles.largest, angle);
    }
  }
  return angles;
}

double smallest_altitude(const TetMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& corners : mesh.tets) {
    const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(corners[a])]; };
    double area = 0;  // of the largest face, twice
    for (std::size_t a = 0; a < 4; ++a)
      area =
          std::max(area, (at((a + 2) % 4) - at((a + 1) % 4)).cross(at((a + 3) % 4) - at((a + 1) % 4)).norm());
    least = std::min(least, 6 * signed_volume(mesh, corners) / area);
  }
  return least;
}

}  // namespace palpate::physics
