#include "physics_node/contact/residual_compliance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::physics {
namespace {

TEST(ResidualCompliance, LearnsTheTangentOfWhatIsPressed) {
  ResidualCompliance s;
  s.begin(400);
  EXPECT_NEAR(s.value(), 0.5 / 400, 1e-12) << "stiffer than the closed form, at first";
  double before = 0;
  for (int n = 1; n <= 400; ++n) {  // half as stiff as that, 0.5 mm to and fro at 5 Hz
    const double force = 0.3 + 0.1 * std::sin(2 * M_PI * 5 * 1e-3 * n);
    s.follow(400, force - before, (force - before) / 200, 1e-3);
    before = force;
  }
  EXPECT_NEAR(s.value(), 1.0 / 200, 0.05 / 200) << "a memory of how it began is left";
  const double learnt = s.value();
  for (int n = 0; n < 5000; ++n) s.follow(400, 0, 0, 1e-3);
  EXPECT_NEAR(s.value(), learnt, 1e-3 * learnt) << "it does not forget while a hand stands";
  s.follow(800, 0, 0, 1e-3);
  EXPECT_NEAR(s.value(), 0.5 * learnt, 1e-3 * learnt) << "a patch that has grown";
}

TEST(ResidualCompliance, IsNeverFarFromTheClosedForm) {
  ResidualCompliance s;
  s.begin(400);
  for (int n = 0; n < 1000; ++n) s.follow(400, 0.1, 1, 1e-3);
  EXPECT_LE(s.value(), 3.0 / 400 + 1e-12);
  for (int n = 0; n < 1000; ++n) s.follow(400, 0.1, -1, 1e-3);
  EXPECT_GE(s.value(), 0.1 / 400 - 1e-12);
}

}  // namespace
}  // namespace palpate::physics
