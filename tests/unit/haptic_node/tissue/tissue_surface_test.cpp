#include "haptic_node/tissue/tissue_surface.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "tests/unit/haptic_node/tissue/some_surfaces.h"

namespace palpate::haptic {
namespace {

TEST(TissueSurface, LiesWhereItsNodesLie) {
  const SurfaceModel wall = flat_wall(0);
  const SurfacePoint p = surface_point(wall, {}, Vec3(0, 0, 1e-3), SurfacePlace(2.3, 4.6), Vec3::Zero());
  EXPECT_LT((p.modal - Vec3(2.3 * node_distance, 4.6 * node_distance, 1e-3)).norm(), 1e-15);
  EXPECT_LT((p.normal - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((p.places_along(Vec3(node_distance, -2 * node_distance, 0)) - SurfacePlace(1, -2)).norm(), 1e-12);
}

/// A patch that begins at another node is the same surface.
TEST(TissueSurface, CountsNodesOfTheWholeSurface) {
  SurfaceModel wall = flat_wall(0);
  wall.origin = {5, -3};
  const SurfacePoint p = surface_point(wall, {}, Vec3::Zero(), SurfacePlace(7.5, 0.25), Vec3::Zero());
  EXPECT_LT((p.modal - node_distance * Vec3(2.5, 3.25, 0)).norm(), 1e-15);
  EXPECT_EQ(on_patch(wall, SurfacePlace(-90, 90)), SurfacePlace(6, 3));
}

/// Rigid motion of all nodes by a mode moves points with it, and turns the normal.
TEST(TissueSurface, TurnsWithItsNodes) {
  SurfaceModel m = flat_wall(0);
  m.n_modes = 1;
  for (SurfaceModel::Node& node : m.nodes) node.shapes[0] = Vec3::UnitY().cross(node.rest);
  const double angle = 0.05;
  const SurfacePoint p = surface_point(m, {angle}, Vec3::Zero(), SurfacePlace(3.7, 2.2), Vec3::Zero());
  const Vec3 rest(3.7 * node_distance, 2.2 * node_distance, 0);
  EXPECT_LT((p.modal - rest - angle * Vec3::UnitY().cross(rest)).norm(), 1e-15);
  EXPECT_LT((p.normal - Vec3(angle, 0, 1).normalized()).norm(), 1e-12);
}

/// t_a . F is less the derivative by xi_a of the energy that a force F holds in the modes' stretch and the residual.
TEST(TissueSurface, HasTangentsOfThePressedSurface) {
  const SurfaceModel m = soft_surface(0);
  const std::array<double, SurfaceModel::most_modes> q{1e-3, -2e-3};
  const Vec3 x(12e-3, 13e-3, -3e-3), rest(1e-4, 0, -2e-4);
  const auto energy = [&](const SurfacePlace& xi) {
    const SurfacePoint p = surface_point(m, q, rest, xi, Vec3::Zero());
    const Mat3 C = Mat3::Identity() / 500 + p.residual;
    const Vec3 e = x - p.modal;
    return 0.5 * e.dot(C.inverse() * e);
  };
  constexpr double d = 1e-4;
  for (const SurfacePlace& xi : {SurfacePlace(2.3, 4.6), SurfacePlace(3, 3), SurfacePlace(5.9, 1.1)}) {
    const SurfacePoint unpressed = surface_point(m, q, rest, xi, Vec3::Zero());
    const Vec3 F = (Mat3::Identity() / 500 + unpressed.residual).inverse() * (x - unpressed.modal);
    const SurfacePoint p = surface_point(m, q, rest, xi, F);
    for (Eigen::Index a = 0; a < 2; ++a) {
      const SurfacePlace by = d * SurfacePlace::Unit(a);
      const double slope = (energy(xi + by) - energy(xi - by)) / (2 * d);
      EXPECT_NEAR(-p.tangents[static_cast<std::size_t>(a)].dot(F), slope, 1e-5 * F.norm() * node_distance);
    }
  }
}

TEST(TissueSurface, RejectsWhatIsNoTissue) {
  const auto good = std::make_unique<SurfaceAnswer>();
  good->model = soft_surface(0.3);
  EXPECT_TRUE(is_sound(*good, 0));
  EXPECT_FALSE(is_sound(*good, 1));
  const auto rejected = [&](auto&& spoil) {
    const auto bad = std::make_unique<SurfaceAnswer>(*good);
    spoil(*bad);
    return !is_sound(*bad, 0);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.n_modes = 10; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.sides = {9, 8}; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.sides = {8, 3}; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.origin[1] = std::numeric_limits<int>::min(); }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.friction = -0.1; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.model.modes[1].stiffness = nan; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.modes[1].damping = -1; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.model.nodes[63].rest.y() = nan; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.model.nodes[63].shapes[1].z() = nan; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.model.residual[224][4] = nan; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.residual[224][2] = -1e-6; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.model.residual[0] = {1e-3, 1e-3, 1e-3, 0, 1.1e-3, 0}; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.state.q[1] = nan; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.state.w[0] = INFINITY; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.state.xi.x() = nan; }));
  EXPECT_TRUE(rejected([&](SurfaceAnswer& a) { a.state.rest.z() = nan; }));
  EXPECT_TRUE(rejected([](SurfaceAnswer& a) { a.state.force.x() = 1e9; }));
  // What is not used is not looked at.
  EXPECT_FALSE(rejected([&](SurfaceAnswer& a) { a.model.nodes[0].shapes[2].x() = nan; }));
}

}  // namespace
}  // namespace palpate::haptic
