#include "physics_node/contact/tangent_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palpate::physics {
namespace {

constexpr double T = 1e-3;

TEST(ContactSum, MovesItsPointAsMomentsDo) {
  ContactSum sum;
  sum.add({0, 0, 2}, {0.1, 0, 0});
  sum.add({0, 3, 0}, {0, 0, 0.2});
  const Vec3 new_point(0.03, -0.02, 0.05);
  ContactSum direct;
  direct.add({0, 0, 2}, Vec3(0.1, 0, 0) - new_point);
  direct.add({0, 3, 0}, Vec3(0, 0, 0.2) - new_point);
  const ContactSum moved = sum.about(-new_point);
  EXPECT_LT((moved.impulse - direct.impulse).norm(), 1e-15);
  EXPECT_LT((moved.spread - direct.spread).norm(), 1e-15);
}

/// Two springs under a tool: what a tool on them takes in a frame.
struct Bed {
  double k = 150;
  Vec3 arms[2] = {{0.02, 0, 0}, {-0.01, 0, 0}};
  ContactSum press(const Vec3& x, double burst) const {
    ContactSum sum;
    for (const Vec3& arm : arms) {
      const double force = k * std::max(0.0, -x.z());
      if (force > 0) sum.add({0, 0, force * T * burst}, arm);
    }
    return sum;
  }
};

TEST(TangentEstimate, TellsTheWrenchAtThePoseAlthoughItFilters) {
  const Bed bed;
  TangentEstimate estimate(20, 300);  // the guess is the truth
  Vec3 x(0, 0, 0.002);
  double worst = 0;
  for (int n = 0; n < 600; ++n) {
    const Vec3 before = x;
    x.z() = 0.002 - 0.006 * std::min(1.0, n / 300.0);  // 20 mm/s down, then still
    Vec6 motion = Vec6::Zero();
    motion.head<3>() = x - before;
    estimate.frame(bed.press(x, 1), motion, T);
    if (n > 150 && n < 300) worst = std::max(worst, std::abs(estimate.wrench()(2) - 2 * 150 * -x.z()));
  }
  EXPECT_LT(worst, 0.05) << "a filter that lags 16 ms would be 0.1 N behind";
  EXPECT_NEAR(estimate.wrench()(2), 1.2, 1e-3);
  EXPECT_NEAR(estimate.wrench()(4), 1.2 / 2 * (-0.02 + 0.01), 1e-4);
  EXPECT_NEAR(estimate.stiffness()(2, 2), 300, 15);
  // k sum r^2 about the tip, and the coupling of both
  EXPECT_NEAR(estimate.stiffness()(4, 4), 150 * (0.02 * 0.02 + 0.01 * 0.01), 0.004);
  EXPECT_NEAR(estimate.stiffness()(2, 4), 150 * (-0.02 + 0.01), 0.08);
}

TEST(TangentEstimate, LearnsTheStiffness) {
  const Bed bed;
  for (const double guess : {100.0, 1000.0}) {
    TangentEstimate estimate(20, guess);
    Vec3 x(0, 0, -0.002);
    for (int n = 0; n < 1000; ++n) {
      const Vec3 before = x;
      x.z() = -0.003 + 0.001 * std::cos(2 * M_PI * 3 * n * T);
      Vec6 motion = Vec6::Zero();
      motion.head<3>() = x - before;
      // Collisions of masses with a tool come in bursts.
      estimate.frame(bed.press(x, n % 3 == 0 ? 3 : 0), motion, T);
    }
    EXPECT_NEAR(estimate.scale(), 300, 30) << "guess " << guess;
  }
}

TEST(TangentEstimate, ForgetsWhatItLeft) {
  const Bed bed;
  TangentEstimate estimate(20, 300);
  for (int n = 0; n < 200; ++n) estimate.frame(bed.press({0, 0, -0.003}, 1), Vec6::Zero(), T);
  EXPECT_GT(estimate.wrench()(2), 0.8);
  for (int n = 0; n < 300; ++n) estimate.frame({}, Vec6::Zero(), T);
  EXPECT_LT(estimate.wrench().norm(), 1e-6);
  EXPECT_LT(estimate.stiffness().norm(), 1e-3);
}

}  // namespace
}  // namespace palpate::physics
