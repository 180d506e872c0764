// The force arrow begins where the tissue pushes, whatever the tool is and wherever its tip.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/message/vec3.h"
#include "common/scene/device_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

constexpr double side = 0.1;
const auto cube = test::cube_surface(12, side, 0xff96b4e6U);

bool is_orange(const std::uint8_t* c) { return c[0] > 120 && c[0] > 2 * c[2] && c[0] > c[1] + 40; }

/// Box round what is orange [px].
Eigen::AlignedBox2d orange_box(const Image& image) {
  Eigen::AlignedBox2d box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (is_orange(image.at(x, y))) box.extend(Eigen::Vector2d(x, y));
  return box;
}

/// A force at a place, as physics sends it: about a set point elsewhere.
ToolWrench pushed(const Vec3& at, const Vec3& force, const Vec3& tip) {
  const Vec3 about(0.2, 0.1, -0.3);
  ToolWrench wrench;
  wrench.force = array(force);
  wrench.moment = array(Vec3((at - about).cross(force)));
  wrench.set_point = array(about);
  wrench.tip = array(tip);
  return wrench;
}

// Limit 3 N, half the diagonal 0.087 m: 1 N is 20 mm. Seen along +y, so that x is to the right and z up.
TEST(PictureOfAnArrow, BeginsWhereABodyIsPushedAndNotAtItsTip) {
  Scene scene = test::small_scene();
  scene.tools[0].shape = ToolShape::body;
  scene.tools[0].body = "cube";
  Picture picture(scene);
  test::show(picture, cube);
  // The tip is a corner; tissue pushes from the right, 20 mm above the middle of the near side.
  const Vec3 tip(-side / 2, -side / 2, -side / 2), at(side / 2, -side / 2, 0.02);
  picture.take(test::trace_at({tip.x(), tip.y(), tip.z()}, 0, 0));
  picture.take(pushed(at, {-2, 0, 0}, tip));
  picture.draw(0);
  const auto box = orange_box(picture.image());
  const Camera camera = test::camera_of_cube(scene, side);
  const auto root = *camera.project(at), head = *camera.project({at.x() - 0.04, at.y(), at.z()});
  EXPECT_NEAR(box.max().x(), root.x(), 2);
  EXPECT_NEAR(box.min().x(), head.x(), 2);
  EXPECT_NEAR(box.center().y(), root.y(), 2);
}

TEST(PictureOfAnArrow, BeginsWhereAStickIsPushed) {
  Scene scene = test::small_scene();
  scene.render->show_tool = false;
  scene.tools[0].shape = ToolShape::stick;
  scene.tools[0].length = 0.08;
  scene.tools[0].radius = 0.004;
  scene.tools[0].attitude << 0, 0, -1, 0, 1, 0, 1, 0, 0;  // from the tip along +x
  Picture picture(scene);
  test::show(picture, cube);
  const Vec3 tip(-0.04, -0.07, 0), at(0.03, -0.07, -0.004);
  picture.take(test::trace_at({tip.x(), tip.y(), tip.z()}, 0, 0));
  picture.take(pushed(at, {0, 0, 2}, tip));
  picture.draw(0);
  const auto box = orange_box(picture.image());
  const Camera camera = test::camera_of_cube(scene, side);
  EXPECT_NEAR(box.center().x(), camera.project(at)->x(), 2);
  EXPECT_NEAR(box.max().y(), camera.project(at)->y(), 2);
  EXPECT_NEAR(box.min().y(), camera.project({at.x(), at.y(), at.z() + 0.04})->y(), 2);
}

/// A finger as thick as the arrow is long hides none of it.
TEST(PictureOfAnArrow, ShinesThroughItsTool) {
  Scene scene = test::small_scene();
  scene.tools[0].radius = 0.012;
  scene.devices[0].waypoints = {{0, Vec3(0, 0, 0.2)}, {1, Vec3(0, 0, 0)}};
  Picture picture(scene);
  test::show(picture, cube);
  const Vec3 tip(0, -0.07, 0);
  picture.take(test::trace_at({tip.x(), tip.y(), tip.z()}, 0, 0));
  picture.take(pushed(tip, {0, 0, 1}, tip));
  picture.draw(0);
  const auto box = orange_box(picture.image());
  const Camera camera = test::camera_of_cube(scene, side);
  ASSERT_FALSE(box.isEmpty());
  EXPECT_NEAR(box.max().y(), camera.project(tip)->y(), 2);
  EXPECT_NEAR(box.min().y(), camera.project({0, -0.07, 0.02})->y(), 2);
}

}  // namespace
}  // namespace palpate::render
