#include "haptic_node/tissue/surface_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/haptic_node/tissue/some_surfaces.h"

namespace palpate::haptic {
namespace {

constexpr double h = 1e-3;

SurfaceState at_place(double a, double b) {
  SurfaceState state;
  state.xi = SurfacePlace(a, b);
  return state;
}

/// A block on a floor: K s while it sticks, mu K d while it slides, and back by 2 mu d before it slides the other way.
TEST(SurfaceStep, SticksAndSlidesOnAWall) {
  constexpr double K = 500, depth = 2e-3, mu = 0.3;
  const SurfaceModel wall = flat_wall(mu);
  const SurfaceStep step(wall, {K, 0}, h);
  SurfaceState state = at_place(3, 3);
  const Vec3 start = node_distance * Vec3(3, 3, 0);
  const auto hold = [&](double aside) {
    for (int n = 0; n < 40; ++n) step.advance(wall, state, {start + Vec3(aside, 0, -depth), Vec3::Zero()});
    return state.force;
  };
  EXPECT_LT((hold(0.5e-3) - Vec3(K * 0.5e-3, 0, -K * depth)).norm(), 1e-12);
  EXPECT_LT((hold(5e-3) - Vec3(mu * K * depth, 0, -K * depth)).norm(), 1e-9);
  EXPECT_NEAR((state.xi.x() - 3) * node_distance, 5e-3 - mu * depth, 1e-9);
  EXPECT_LT((hold(5e-3 - mu * depth) - Vec3(0, 0, -K * depth)).norm(), 1e-9);
  EXPECT_LT((hold(3e-3) - Vec3(-mu * K * depth, 0, -K * depth)).norm(), 1e-9);
}

/// Without friction xi follows the tip, in contact and in the air.
TEST(SurfaceStep, FollowsATipThatDoesNotRub) {
  const SurfaceModel wall = flat_wall(0);
  const SurfaceStep step(wall, {500, 0}, h);
  for (const double z : {-2e-3, 20e-3}) {
    SurfaceState state = at_place(2, 2);
    for (int n = 0; n < 40; ++n)
      step.advance(wall, state, {Vec3(4.5 * node_distance, 3.2 * node_distance, z), Vec3::Zero()});
    EXPECT_LT((state.xi - SurfacePlace(4.5, 3.2)).norm(), 1e-9);
    EXPECT_LT((state.force - Vec3(0, 0, z < 0 ? -1 : 0)).norm(), 1e-9);
  }
}

/// F = C^-1 e with C of spring, residual and all modes, once all is at rest.
TEST(SurfaceStep, EndsAtTheStaticForce) {
  const SurfaceModel m = soft_surface(5);
  const SurfaceStep step(m, {500, 1}, h);
  SurfaceState state = at_place(3.3, 2.8);
  const Vec3 e(0.5e-3, -0.3e-3, -3e-3);
  const SurfacePoint p = surface_point(m, {}, Vec3::Zero(), state.xi, Vec3::Zero());
  for (int n = 0; n < 3000; ++n) step.advance(m, state, {p.modal + e, Vec3::Zero()});
  Mat3 C = Mat3::Identity() / 500 + p.residual;
  for (std::uint32_t i = 0; i < m.n_modes; ++i) C += p.psi[i] * p.psi[i].transpose() / m.modes[i].stiffness;
  EXPECT_EQ(state.xi, SurfacePlace(3.3, 2.8));
  EXPECT_LT((state.force - C.inverse() * e).norm(), 1e-9);
}

/// Straight down on one mode and a residual it is the tissue of one dimension.
TEST(SurfaceStep, IsThatOfOneDimensionAlongTheNormal) {
  SurfaceModel m = flat_wall(0.3);
  m.n_modes = 1;
  m.modes[0] = {26'000, 60};
  for (SurfaceModel::Node& node : m.nodes) node.shapes[0] = Vec3(0, 0, -2);
  for (auto& r : m.residual) r = {1e-3, 1e-3, 1e-3, 0, 0, 0};
  TissueModel line;
  line.n_modes = 1;
  line.modes[0] = {Vec3(0, 0, -2), 26'000, 60};
  line.residual = line.residual_across = 1e-3;
  line.friction = 0.3;
  const SurfaceStep step(m, {500, 1}, h);
  const TissueStep straight(line, {500, 1}, h);
  SurfaceState state = at_place(3, 3);
  TissueState one;
  for (int n = 0; n < 1000; ++n) {
    const double depth = 1.5e-3 * std::sin(0.1 * n), speed = 0.15 * std::cos(0.1 * n);
    step.advance(m, state, {Vec3(3 * node_distance, 3 * node_distance, -depth), Vec3(0, 0, -speed)});
    straight.advance(one, {Vec3(0, 0, -depth), Vec3(0, 0, -speed)});
    ASSERT_NEAR((state.force - one.force).norm(), 0, 1e-9) << n;
    ASSERT_NEAR(state.force.head<2>().norm(), 0, 1e-12);
  }
}

/// Unpressed modes swing as the formula says.
TEST(SurfaceStep, SwingsFreelyAsTheFormulaSays) {
  const SurfaceModel m = soft_surface(0.3);
  const SurfaceStep step(m, {500, 1}, h);
  SurfaceState state = at_place(3, 3);
  state.q = {1e-3, -2e-3};
  for (int n = 0; n < 100; ++n) step.advance(m, state, {Vec3(0.01, 0.01, 1), Vec3::Zero()});
  const std::array<double, 2> q0{1e-3, -2e-3};
  for (std::size_t i = 0; i < 2; ++i) {
    const double c = m.modes[i].damping, swing = std::sqrt(m.modes[i].stiffness - 0.25 * c * c), t = 0.1;
    const double q =
        q0[i] * std::exp(-0.5 * c * t) * (std::cos(swing * t) + 0.5 * c / swing * std::sin(swing * t));
    EXPECT_NEAR(state.q[i], q, 1e-12);
  }
}

/// A tip that slides in circles, pressed and rubbing, gets back no more than it gave.
TEST(SurfaceStep, DissipatesInAClosedCycle) {
  for (const double mu : {0.0, 0.3}) {
    const SurfaceModel m = soft_surface(mu);
    const SurfaceStep step(m, {500, 1}, h);
    for (const double frequency : {0.5, 2.0}) {
      SurfaceState state = at_place(3.5, 3.5);
      const int cycle = static_cast<int>(std::lround(1 / (frequency * h)));
      const auto at = [&](int n) {
        const double a = 2 * std::numbers::pi * n / cycle;
        return Vec3(14e-3 + 6e-3 * std::cos(a), 14e-3 + 6e-3 * std::sin(a), -3e-3);
      };
      double given = 0;
      for (int n = 1; n <= 8 * cycle; ++n) {
        const StepWork work = step.advance(m, state, at(n - 1), {at(n), (at(n) - at(n - 1)) / h});
        if (n > 7 * cycle) given += work.given;
      }
      EXPECT_GT(given, mu > 0 ? 5e-3 : 0.0) << "mu " << mu << " at " << frequency << " Hz";
    }
  }
}

}  // namespace
}  // namespace palpate::haptic
