// Friction of a tip that a spring leads: it sticks, is carried along, and slides where Coulomb's cone ends.

#include "physics_node/contact/tip_friction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::physics {
namespace {

constexpr double K = 500, dt = 1e-4;
const Vec3 up = Vec3::UnitZ(), still = Vec3::Zero();

TEST(TipFriction, SticksByItsSpringAndSlidesAtTheCone) {
  TipFriction friction(0.3);
  for (int n = 1; n <= 100; ++n) {
    friction.lead(Vec3(1e-5, 0, 4e-5), up);
    friction.pull(still, up, K, 1.0, 0, dt);
    const double spring = K * 1e-5 * n;
    EXPECT_NEAR(friction.force().x(), std::min(spring, 0.3), 1e-12) << n;
    EXPECT_EQ(friction.force().z(), 0);
  }
  EXPECT_NEAR(friction.lag().x(), -0.3 / K, 1e-12);
  EXPECT_NEAR(friction.take_slid().x(), 1e-3 - 0.3 / K, 1e-12);
  EXPECT_EQ(friction.take_slid().norm(), 0);
}

TEST(TipFriction, IsCarriedByTheTissue) {
  TipFriction friction(0.3);
  friction.lead(Vec3(0, 1e-4, 0), up);
  friction.pull(Vec3(0, 1e-4, 3e-4), up, K, 1.0, 0, dt);
  EXPECT_EQ(friction.force().norm(), 0);
  friction.lead(still, up);
  friction.pull(Vec3(0, 1e-4, 0), up, K, 1.0, 0, dt);
  EXPECT_NEAR(friction.force().y(), -K * 1e-4, 1e-12) << "the spring holds it back";
}

/// A mass so light that explicit steps of its spring would throw it away comes to rest where both springs balance.
TEST(TipFriction, IsStillOnLightTissueAndRightAtRest) {
  for (const double mass : {1e-7, 1e-6, 1e-5, 1e-4}) {
    TipFriction friction(2.0);
    const double k = 100, c = 0.1 * std::sqrt(k * mass);
    double u = 0, v = 0, most = 0;
    const double step = std::min(dt, 0.5 * std::sqrt(mass / k));  // as elements take it
    for (int n = 0; n < 200'000; ++n) {
      v += step / mass * (-k * u - c * v);
      friction.lead(Vec3(n == 0 ? 1e-3 : 0, 0, 0), up);
      friction.pull(Vec3(step * v, 0, 0), up, K, 5.0, 1 / mass, step);
      v += step / mass * friction.force().x();
      u += step * v;
      most = std::max(most, std::abs(u));
    }
    EXPECT_NEAR(friction.force().x(), 1e-3 / (1 / K + 1 / k), 1e-6) << mass;
    EXPECT_LT(most, 2e-3) << mass;
  }
}

TEST(TipFriction, DoesNothingWithoutFriction) {
  TipFriction friction(0);
  friction.lead(Vec3(1, 0, 0), up);
  friction.pull(still, up, K, 1.0, 0, dt);
  EXPECT_EQ(friction.lag().norm(), 0);
  EXPECT_EQ(friction.force().norm(), 0);
}

}  // namespace
}  // namespace palpate::physics
