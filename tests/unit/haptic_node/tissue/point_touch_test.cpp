// Answers in space: along the normal that each has, without a jump where it turns.

#include "haptic_node/tissue/point_touch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/message/vec3.h"

namespace palpate::haptic {
namespace {

TouchSettings settings() { return {.spring = {500, 1}, .period = 1e-3, .force_limit = 3, .resolution = 0}; }

/// Tissue without modes that gives 2 mm/N, with its surface at z = 0 and tilted by an angle about y.
ContactPatch patch(std::uint64_t sample, double x_depth, double angle = 0) {
  ContactPatch patch;
  patch.n_tissues = 1;
  TouchedTissue& told = patch.tissues[0];
  told.sample = sample;
  told.normal = {std::sin(angle), 0, std::cos(angle)};
  told.residual = 2e-3;
  told.force = 500 / (1 + 500 * told.residual) * std::max(0.0, x_depth);
  return patch;
}

/// 2 mm deep, from 1 mm above, within 0.1 s.
Vec3 way_in(int n) { return {0, 0, 1e-3 - 3e-5 * std::min(n, 100)}; }

/// That many ticks, answered a tick late. @return force of the last
Vec3 press(PointTouch& touch, int ticks) {
  Vec3 force = Vec3::Zero();
  for (int n = 1; n <= ticks; ++n) {
    if (n > 1) touch.take(patch(static_cast<std::uint64_t>(n - 1), -way_in(n - 1).z()));
    force = touch.tick(way_in(n), 1);
  }
  return force;
}

TEST(PointTouch, PressesAlongTheNormalOfTheAnswer) {
  PointTouch touch(settings());
  const Vec3 force = press(touch, 600);
  EXPECT_NEAR(force.z(), 0.5, 0.01) << "spring and tissue in series";
  EXPECT_EQ(force.head<2>().norm(), 0);
  EXPECT_NEAR(touch.model_error(), 0, 0.02) << "the copy is right";
  EXPECT_TRUE(touch.penetrated(way_in(600)));
  EXPECT_FALSE(touch.penetrated({0, 0, 1e-4}));
}

TEST(PointTouch, KeepsItsForceWhereTheNormalTurns) {
  PointTouch touch(settings());
  const Vec3 before = press(touch, 400);
  const double angle = 0.2;
  for (int n = 401; n <= 410; ++n) {
    touch.take(patch(static_cast<std::uint64_t>(n - 1), 2e-3 * std::cos(angle), angle));
    const Vec3 force = touch.tick(way_in(n), 1);
    EXPECT_NEAR(force.norm(), before.norm(), 0.01) << n;
    EXPECT_NEAR(force.x() / force.norm(), std::sin(angle), 1e-9);
  }
}

/// Whoever calls it: in simulated time no wire looks at what physics says.
TEST(PointTouch, LeavesOutWhatIsNoTissue) {
  PointTouch touch(settings());
  Vec3 force = Vec3::Zero();
  for (int n = 1; n <= 600; ++n) {
    ContactPatch answer = patch(static_cast<std::uint64_t>(n - 1), -way_in(n - 1).z());
    if (n % 2 == 0) answer.tissues[0].rest = std::numeric_limits<double>::infinity();
    if (n > 1) touch.take(answer);
    force = touch.tick(way_in(n), 1);
  }
  EXPECT_NEAR(force.z(), 0.5, 0.01);
}

TEST(PointTouch, FeelsNothingWhereNoTissueIsNear) {
  PointTouch touch(settings());
  press(touch, 300);
  touch.take(ContactPatch{});
  for (int n = 301; n <= 400; ++n) EXPECT_TRUE(touch.tick(way_in(n), 1).isZero());
  EXPECT_FALSE(touch.penetrated(way_in(400)));
}

}  // namespace
}  // namespace palpate::haptic
