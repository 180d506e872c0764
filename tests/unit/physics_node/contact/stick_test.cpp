#include "physics_node/contact/stick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palpate::physics {
namespace {

constexpr double r = 0.002;
const Stick lying{{0, 0, 0}, {0.1, 0, 0}, r};

Stick moved(const Stick& stick, const Vec3& by) { return {stick.A + by, stick.D, stick.radius}; }

TEST(Stick, HasRoundEnds) {
  EXPECT_EQ(lying.nearest({-1, 0, 0}), 0);
  EXPECT_EQ(lying.nearest({1, 0.3, 0}), 1);
  EXPECT_DOUBLE_EQ(lying.nearest({0.025, 0.3, -0.1}), 0.25);
}

TEST(StickSweep, MeetsAPointThatStandsStill) {
  const StickHit hit = sweep(lying, moved(lying, {0, 0, 0.003}), {0.05, 0, 0.004}, {0.05, 0, 0.004});
  ASSERT_TRUE(hit.hit);
  EXPECT_LT((hit.normal - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(hit.depth, 0.001, 1e-12);
  EXPECT_LT((hit.axis_motion - Vec3(0, 0, 0.003)).norm(), 1e-12);
}

TEST(StickSweep, KeepsTheSideOfAPointThatItJumpedOver) {
  const StickHit hit = sweep(lying, moved(lying, {0, 0, 0.05}), {0.05, 0.0001, 0.004}, {0.05, 0.0001, 0.004});
  ASSERT_TRUE(hit.hit);
  EXPECT_GT(hit.normal.z(), 0.99);
  EXPECT_NEAR(hit.depth, 0.046 + r, 1e-4);
}

TEST(StickSweep, LetsAPointPassByTheTip) {
  EXPECT_FALSE(sweep(lying, moved(lying, {0, 0, 0.05}), {-0.0021, 0, 0.004}, {-0.0021, 0, 0.004}).hit);
  EXPECT_TRUE(sweep(lying, moved(lying, {0, 0, 0.0035}), {-0.001, 0, 0.004}, {-0.001, 0, 0.004}).hit);
  EXPECT_FALSE(sweep(lying, moved(lying, {0, 0, -0.05}), {0.05, 0, 0.004}, {0.05, 0, 0.004}).hit);
}

/// Against fine samples of the way: what comes near enough is met, and after the push nothing is inside.
TEST(StickSweep, FindsWhatFineSamplesFind) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  int met = 0;
  for (int n = 0; n < 20000; ++n) {
    const Stick before{{0.01 * u(random), 0.01 * u(random), 0.01 * u(random)},
                       0.03 * Vec3(u(random), u(random), u(random)),
                       r};
    const Stick now = moved(before, 0.01 * Vec3(u(random), u(random), u(random)));
    const Vec3 p_0 = 0.02 * Vec3(u(random), u(random), u(random));
    const Vec3 p_1 = p_0 + 0.005 * Vec3(u(random), u(random), u(random));
    if ((p_0 - before.axis_point(before.nearest(p_0))).norm() < r) continue;
    double least = 1;
    constexpr int fine = 400;
    for (int i = 0; i <= fine; ++i) {
      const double s = static_cast<double>(i) / fine;
      const Stick at = moved(before, s * (now.A - before.A));
      const Vec3 p = p_0 + s * (p_1 - p_0);
      least = std::min(least, (p - at.axis_point(at.nearest(p))).norm());
    }
    const StickHit hit = sweep(before, now, p_0, p_1);
    const Vec3 end = p_1 + hit.depth * hit.normal;
    const bool ends_inside = (p_1 - now.axis_point(now.nearest(p_1))).norm() < r;
    if (ends_inside) {
      EXPECT_TRUE(hit.hit) << n;
    }
    if (least > r) {
      EXPECT_FALSE(hit.hit) << n;
    }
    if (!hit.hit) continue;
    ++met;
    EXPECT_GE((end - now.axis_point(now.nearest(end))).norm(), r - 1e-9) << n;
    EXPECT_GE(hit.depth, 0) << n;
  }
  EXPECT_GT(met, 150);
}

}  // namespace
}  // namespace palpate::physics
