#include "render_node/view/arrow_scale.h"

#include <gtest/gtest.h>

namespace palpate::render {
namespace {

TEST(ArrowScale, IsARoundNumberThatFits) {
  EXPECT_DOUBLE_EQ(arrow_metres_per_newton(3.0, 0.19), 0.05);
  EXPECT_DOUBLE_EQ(arrow_metres_per_newton(3.0, 0.12), 0.02);
  EXPECT_DOUBLE_EQ(arrow_metres_per_newton(1.0, 0.012), 0.01);
  EXPECT_DOUBLE_EQ(arrow_metres_per_newton(1.0, 0.002), 0.002);
  EXPECT_DOUBLE_EQ(arrow_metres_per_newton(1.0, 1.0), 1.0);
}

}  // namespace
}  // namespace palpate::render
