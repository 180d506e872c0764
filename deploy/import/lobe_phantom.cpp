#include "deploy/import/lobe_phantom.h"

#include <cmath>

#include "physics_node/mesh/tet_box.h"

namespace palpate {
namespace {

using physics::TetMesh;

constexpr std::array<int, 3> cells{16, 11, 6};
constexpr double half_length = 0.060, half_width = 0.037, half_height = 0.021;  // [m]

/// The cube [-1, 1]^3 to the unit ball, smooth and one to one: x sqrt(1 - y^2/2 - z^2/2 + y^2 z^2 / 3) and so on.
Vec3 to_ball(const Vec3& a) {
  const Vec3 s = a.cwiseAbs2();
  const auto shrunk = [](double y2, double z2) { return std::sqrt(1 - y2 / 2 - z2 / 2 + y2 * z2 / 3); };
  return {a.x() * shrunk(s.y(), s.z()), a.y() * shrunk(s.z(), s.x()), a.z() * shrunk(s.x(), s.y())};
}

/// From the cube to the lobe. The more of the ball, the flatter are the tetrahedra at the edges of the cube.
Vec3 to_lobe(const Vec3& a) {
  const double roundness = 0.3 + 0.15 * a.z();  // more above than below
  const Vec3 p = (1 - roundness) * a + roundness * to_ball(a);
  const double thinner = 1 - 0.25 * p.x();  // toward +x
  const double bend = -0.15 * p.x() * p.x() + 0.1 * p.y() * p.y();
  return {half_length * p.x(), half_width * (thinner * p.y() + 0.2 * bend),
          half_height * (thinner * (p.z() + 1) - 1)};
}

}  // namespace

TetMesh lobe_phantom() {
  TetMesh mesh = physics::make_tet_box({.cells = cells, .edge = 1, .jitter = 0.1});
  const Vec3 half = 0.5 * Vec3(cells[0], cells[1], cells[2]);
  for (Vec3& x : mesh.nodes) x = to_lobe((x - half).cwiseQuotient(half));
  physics::tidy(mesh);
  return mesh;
}

}  // namespace palpate
