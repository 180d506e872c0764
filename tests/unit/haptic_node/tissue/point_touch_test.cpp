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
ContactPatch patch(std::uint64_t sample, double x_depth, double angle = 0, const Array3& rest = {}) {
  ContactPatch patch;
  patch.n_tissues = 1;
  TouchedTissue& told = patch.tissues[0];
  told.sample = sample;
  told.normal = {std::sin(angle), 0, std::cos(angle)};
  told.residual = told.residual_across = 2e-3;
  const double force = 500 / (1 + 500 * told.residual) * std::max(0.0, x_depth);
  told.force = array(Vec3(-force * vec(told.normal)));
  told.rest = rest;
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
  PointTouch touch(settings(), 0);
  const Vec3 force = press(touch, 600);
  EXPECT_NEAR(force.z(), 0.5, 0.01) << "spring and tissue in series";
  EXPECT_EQ(force.head<2>().norm(), 0);
  EXPECT_NEAR(touch.model_error(), 0, 0.02) << "the copy is right";
  EXPECT_TRUE(touch.penetrated(way_in(600)));
  EXPECT_FALSE(touch.penetrated({0, 0, 1e-4}));
}

/// Where the normal of answers turns, so does the force, without a jump.
TEST(PointTouch, TurnsItsForceWithTheNormal) {
  PointTouch touch(settings(), 0);
  Vec3 before = press(touch, 400);
  const double angle = 0.2;
  for (int n = 401; n <= 1000; ++n) {
    touch.take(patch(static_cast<std::uint64_t>(n - 1), 2e-3 * std::cos(angle), angle));
    const Vec3 force = touch.tick(way_in(n), 1);
    EXPECT_LE((force - before).norm(), TissueTouch::slew * 1e-3 + 1e-9) << n;
    before = force;
  }
  EXPECT_NEAR(before.norm(), 0.5 * std::cos(angle), 0.01);
  EXPECT_NEAR(before.x() / before.norm(), std::sin(angle), 1e-3);
}

/// A tip that is led aside is held by what it sticks to, within Coulomb's cone; its answers say where it sticks.
TEST(PointTouch, RubsWhereThereIsFriction) {
  for (const double friction : {0.0, 0.3, 1.5}) {
    PointTouch touch(settings(), friction);
    const auto at = [](int n) { return Vec3(way_in(n) + Vec3(5e-6 * std::clamp(n - 200, 0, 200), 0, 0)); };
    Vec3 force = Vec3::Zero();
    Array3 rest{};
    for (int n = 1; n <= 600; ++n) {
      if (n > 1) {
        ContactPatch answer = patch(static_cast<std::uint64_t>(n - 1), -way_in(n - 1).z(), 0, rest);
        answer.tissues[0].force[0] = -force.x();
        touch.take(answer);
      }
      force = touch.tick(at(n), 1);
      // What physics does as well: the tip has slid by what the cone does not hold.
      const double held = std::min(friction * force.z(), 250 * (at(n).x() - rest[0]));
      rest[0] = at(n).x() - held / 250;
    }
    EXPECT_NEAR(force.z(), 0.5, 0.01);
    EXPECT_NEAR(force.x(), -std::min(friction * 0.5, 250e-3), 0.01) << friction;
  }
}

/// Whoever calls it: in simulated time no wire looks at what physics says.
TEST(PointTouch, LeavesOutWhatIsNoTissue) {
  PointTouch touch(settings(), 0);
  Vec3 force = Vec3::Zero();
  for (int n = 1; n <= 600; ++n) {
    ContactPatch answer = patch(static_cast<std::uint64_t>(n - 1), -way_in(n - 1).z());
    if (n % 2 == 0) answer.tissues[0].rest[2] = std::numeric_limits<double>::infinity();
    if (n > 1) touch.take(answer);
    force = touch.tick(way_in(n), 1);
  }
  EXPECT_NEAR(force.z(), 0.5, 0.01);
}

TEST(PointTouch, FeelsNothingWhereNoTissueIsNear) {
  PointTouch touch(settings(), 0);
  press(touch, 300);
  touch.take(ContactPatch{});
  for (int n = 301; n <= 400; ++n) EXPECT_TRUE(touch.tick(way_in(n), 1).isZero());
  EXPECT_FALSE(touch.penetrated(way_in(400)));
}

}  // namespace
}  // namespace palpate::haptic
