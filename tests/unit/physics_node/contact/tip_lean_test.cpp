// The direction in which a led tip is pressed follows the pressure, and turning gives no energy.

#include "physics_node/contact/tip_lean.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::physics {
namespace {

constexpr double K = 500, dt = 1e-4;
const Vec3 up = Vec3::UnitZ();

TEST(TipLean, StaysWhereThePressureIsAlongIt) {
  EXPECT_EQ(TipLean::turned(up, Vec3(0, 0, -1), 2e-3, 1e4, K, dt), up);
}

TEST(TipLean, GoesOverToThePressureWithinItsTime) {
  const Vec3 n = Vec3(0.3, 0, 1).normalized();
  Vec3 now = up;
  for (double t = 0; t < TipLean::tau; t += dt) now = TipLean::turned(now, -n, 5e-3, 0, K, dt);
  EXPECT_NEAR((now - n).norm() / (up - n).norm(), std::exp(-1.0), 0.03);
  for (double t = 0; t < 10 * TipLean::tau; t += dt) now = TipLean::turned(now, -n, 5e-3, 0, K, dt);
  EXPECT_NEAR((now - n).norm(), 0, 1e-4);
  EXPECT_NEAR(now.norm(), 1, 1e-15);
}

/// A frictionless wedge as steep as 45 degrees, as stiff as one likes: no step overshoots.
TEST(TipLean, IsStillOnAContactThatIsStiff) {
  for (const double stiffness : {1e2, 1e4, 1e6, 1e9}) {
    const double stretched = 2e-3;
    Vec3 now = up;
    double last = 1;
    for (int n = 0; n < 200'000; ++n) {
      // The contact centres the tip where n leans by 0.1.
      const double off = stretched * (now.x() / now.z() - 0.1);
      const double F = K * stretched;
      now = TipLean::turned(now, Vec3(stiffness * off, 0, -F), stretched, stiffness, K, dt);
      const double left = std::abs(now.x() / now.z() - 0.1);
      ASSERT_LE(left, last + 1e-9) << stiffness;
      last = left;
    }
  }
}

/// A ball on the edge of a table rolls back while the hand is above its middle, and off it where it is below.
TEST(TipLean, FallsOffAnEdgeWhereTheHandIsDeeperThanTheMiddleOfTheBall) {
  constexpr double radius = 5e-3;
  for (const double stretched : {0.6 * radius, 1.5 * radius}) {
    Vec3 n = Vec3(0.01, 0, 1).normalized();  // the edge under the hand; the middle of the ball at zeta n
    for (int step = 0; step < 500; ++step) {
      // The edge lies where a ball that leans by nothing touches it: its middle has moved by zeta n across.
      const Vec3 from_edge = Vec3(stretched * n.x(), 0, radius).normalized();
      n = TipLean::turned(n, -K * stretched * from_edge, stretched, 0, K, dt);
    }
    if (stretched < radius)
      EXPECT_LT(n.x(), 0.003);
    else
      EXPECT_GT(n.x(), 0.02);
  }
}

TEST(TipLean, GoesAsInAGuideOnAFlat) {
  EXPECT_EQ(TipLean::borne(up, Vec3(0.3, 0, -1), 1), Vec3(0, 0, -1));
  EXPECT_NEAR(TipLean::borne(up, Vec3(0.3, 0, -1), 0.98).x(), 0.15, 1e-12);
  EXPECT_EQ(TipLean::borne(up, Vec3(0, 0.3, -1), 0.9), Vec3(0, 0.3, -1)) << "an edge is near";
  EXPECT_EQ(TipLean::borne(up, Vec3::Zero(), 1), Vec3(Vec3::Zero()));
}

TEST(TipLean, KeepsWhatItHasWithoutForce) {
  EXPECT_EQ(TipLean::turned(up, Vec3::Zero(), 1e-3, 0, K, dt), up);
  EXPECT_EQ(TipLean::turned(up, Vec3(0, 0, 1), 1e-3, 0, K, dt), up);
  EXPECT_EQ(TipLean::turned(up, Vec3(1, 0, -1), 0, 0, K, dt), up);
}

}  // namespace
}  // namespace palpate::physics
