#include "physics_node/contact/residual_compliance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::physics {
namespace {

/// Closed form 400 N/m, tissue half as stiff: 0.5 mm to and fro at 5 Hz.
double force_at(int n) { return 0.3 + 0.1 * std::sin(2 * M_PI * 5 * 1e-3 * n); }

TEST(ResidualCompliance, LearnsTheTangentOfWhatIsPressed) {
  ResidualCompliance g;
  g.begin(0.5);
  EXPECT_NEAR(g.value(), 0.5, 1e-12);
  for (int n = 1; n <= 400; ++n) {
    const double by = force_at(n) - (n > 1 ? force_at(n - 1) : 0);
    g.follow(by / 400, by / 200, 1e-3);
  }
  EXPECT_NEAR(g.value(), 2, 0.1) << "a memory of how it began is left";
  const double learnt = g.value();
  for (int n = 0; n < 5000; ++n) g.follow(0, 0, 1e-3);
  EXPECT_NEAR(g.value(), learnt, 1e-3 * learnt) << "it does not forget while a hand stands";
  g.begin(0.7);
  EXPECT_NEAR(g.value(), 0.7, 1e-12) << "another contact";
}

TEST(ResidualCompliance, IsNeverFarFromTheClosedForm) {
  ResidualCompliance g;
  g.begin(1);
  for (int n = 0; n < 1000; ++n) g.follow(0.1, 1, 1e-3);
  EXPECT_LE(g.value(), 3);
  for (int n = 0; n < 1000; ++n) g.follow(0.1, -1, 1e-3);
  EXPECT_GE(g.value(), 0.1);
}

/// Tissue that gives less at first than further on, as a tip that comes to one more node does: the next touch needs the secant.
TEST(FirstTouch, LearnsTheSecant) {
  FirstTouch g;
  g.begin(0.5);
  EXPECT_NEAR(g.value(), 0.5, 1e-12);
  for (int n = 0; n < 100; ++n) {
    const double z = 1e-3 * std::sin(M_PI * n / 100);
    g.follow(z, z < 0.4e-3 ? 0.6 * z : 0.6 * 0.4e-3 + 1.2 * (z - 0.4e-3), 1e-3);
  }
  EXPECT_GT(g.value(), 0.8);
  EXPECT_LT(g.value(), 1.0);
  for (int n = 0; n < 1000; ++n) g.follow(1e-3, 2e-3, 1e-3);
  EXPECT_NEAR(g.value(), 2, 0.02) << "what is new counts for more";
}

}  // namespace
}  // namespace palpate::physics
