#include "haptic_node/tissue/spline_weights.h"

#include <gtest/gtest.h>

namespace palpate::haptic {
namespace {

double weight_of(int node, double x) {
  const SplineWeights s(x, 8);
  return node >= s.first && node < s.first + 4 ? s.w[static_cast<std::size_t>(node - s.first)] : 0.0;
}

TEST(SplineWeights, SumToOneAndGiveBackWhatIsLinear) {
  for (double x = 1; x <= 6; x += 0.01) {
    const SplineWeights s(x, 8);
    double sum = 0, place = 0, slope = 0, rise = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double node = s.first + static_cast<double>(i);
      EXPECT_GE(s.w[i], 0);
      sum += s.w[i], place += s.w[i] * node, slope += s.dw[i], rise += s.dw[i] * node;
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(place, x, 1e-13);
    EXPECT_NEAR(slope, 0, 1e-14);
    EXPECT_NEAR(rise, 1, 1e-13);
  }
}

/// Second differences change by no more than the third derivative, at most 3 everywhere, allows: also across nodes.
TEST(SplineWeights, AreTwiceContinuouslyDifferentiable) {
  constexpr double d = 1e-3;
  for (int node = 0; node < 8; ++node) {
    double before = 0;
    for (double x = 1 + d; x < 6 - d; x += d) {
      const double first = (weight_of(node, x + d) - weight_of(node, x - d)) / (2 * d);
      const double second =
          (weight_of(node, x + d) - 2 * weight_of(node, x) + weight_of(node, x - d)) / (d * d);
      const SplineWeights s(x, 8);
      const double told =
          node >= s.first && node < s.first + 4 ? s.dw[static_cast<std::size_t>(node - s.first)] : 0.0;
      EXPECT_NEAR(told, first, 2 * d * d);
      if (x > 1 + 1.5 * d) {
        EXPECT_NEAR(second, before, 3.5 * d) << "at " << x;
      }
      before = second;
    }
  }
}

TEST(SplineWeights, StayInTheRow) {
  for (const double x : {-1e9, 0.0, 7.0, 1e9}) {
    const SplineWeights s(x, 8);
    EXPECT_EQ(s.first, x < 1 ? 0 : 4);
  }
}

}  // namespace
}  // namespace palpate::haptic
