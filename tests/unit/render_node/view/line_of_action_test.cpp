// Forces at known points, as force and moment about another: the point is found again.

#include "render_node/view/line_of_action.h"

#include <gtest/gtest.h>

#include <random>

#include "common/scene/scene.h"
#include "render_node/model/view_model.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

const Surface cube = test::surface_of(test::cube_surface(5, 0.1, 0xffffffffU));  // from -0.05 to 0.05

TEST(LineOfAction, GoesThroughThePointWhereAForceActs) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto any = [&] { return Vec3(u(random), u(random), u(random)); };
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at = any(), force = 10 * any(), about = any();
    const auto line = line_of_action(force, (at - about).cross(force), about);
    ASSERT_TRUE(line);
    ASSERT_LT(line->along.cross(at - line->point).norm(), 1e-9);
    ASSERT_NEAR(line->along.dot(force), force.norm(), 1e-9);
  }
  EXPECT_FALSE(line_of_action(Vec3::Zero(), Vec3(0, 0, 1), Vec3::Zero()));
  EXPECT_FALSE(line_of_action(Vec3(0, 0, NAN), Vec3::Zero(), Vec3::Zero()));
}

TEST(LineOfAction, MeetsABodyWhereItIsPushedFromOutside) {
  const Vec3 about(0.3, -0.2, 0.1);
  struct Push {
    Vec3 at, force;
  };
  for (const auto& [at, force] :
       {Push{{0.013, -0.027, -0.05}, {0, 0, 2}}, Push{{0.05, 0.021, 0.033}, {-3, 0, 0}},
        Push{{-0.011, 0.05, 0.04}, {0.2, -1, 0.1}}}) {
    const auto line = line_of_action(force, (at - about).cross(force), about);
    const auto pushed = pushed_point(*line, cube);
    ASSERT_TRUE(pushed);
    EXPECT_LT((*pushed - at).norm(), 1e-6);
  }
}

TEST(LineOfAction, TakesTheNearestVertexWhereItPassesTheBody) {
  const Vec3 force(0, 0, 1), far(0.4, 0.03, 0);  // a couple moves the line beside the cube
  const auto pushed = pushed_point(*line_of_action(force, far.cross(force), Vec3::Zero()), cube);
  ASSERT_TRUE(pushed);
  EXPECT_NEAR(pushed->x(), 0.05, 1e-6);
  EXPECT_NEAR(pushed->y(), 0.03, 1e-6);
  EXPECT_FALSE(pushed_point({Vec3::Zero(), Vec3::UnitZ()}, Surface{}));
}

TEST(LineOfAction, MeetsAStickAtItsSide) {
  const Vec3 a(0.01, 0, 0), b(0.11, 0, 0), force(0, 0, 2);
  constexpr double radius = 0.004;
  const auto of = [&](const Vec3& at) { return *line_of_action(force, at.cross(force), Vec3::Zero()); };
  EXPECT_LT((pushed_point(of({0.08, 0, -radius}), a, b, radius) - Vec3(0.08, 0, -radius)).norm(), 1e-12);
  EXPECT_LT((pushed_point(of({0.5, 0.2, 0}), a, b, radius) - Vec3(0.11, 0, -radius)).norm(), 1e-12);
  EXPECT_LT((pushed_point(of({0, 0, 0}), a, b, radius) - Vec3(0.01, 0, -radius)).norm(), 1e-12);
  const LineOfAction lengthwise{Vec3(0, 0, 0), Vec3(-1, 0, 0)};
  EXPECT_LT((pushed_point(lengthwise, a, b, radius) - Vec3(0.11 + radius, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace palpate::render
