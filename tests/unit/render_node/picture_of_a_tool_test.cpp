// Where tools are drawn, and their arrows, before the picture of a cube.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/scene/device_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

using test::show;

constexpr double side = 0.1;
const auto cube = test::cube_surface(12, side, 0xff96b4e6U);

Camera camera_of(const Scene& scene) { return test::camera_of_cube(scene, side); }

TEST(PictureOfATool, DrawsTheForceArrowToScale) {
  Scene scene = test::small_scene();
  scene.render->show_tool = false;
  Picture picture(scene);
  show(picture, cube);
  picture.draw(0);
  picture.take(test::trace_at({0, -side / 2, 0}, 0, 0));
  ToolWrench wrench;
  wrench.force = {0, 0, 2.5};
  picture.take(wrench);
  picture.draw(0);
  // Limit 3 N, half the diagonal 0.087 m: 1 N is 20 mm, so 2.5 N reach from 0 to 50 mm.
  const Camera camera = camera_of(scene);
  const auto is_orange = [](const Eigen::Vector3i& c) {
    return c.x() > 120 && c.x() > 2 * c.z() && c.x() > c.y() + 40;
  };
  const auto pixel = [](const Picture& drawn, const Eigen::Vector2d& p) {
    const auto* rgb = drawn.image().at(static_cast<int>(p.x()), static_cast<int>(p.y()));
    return Eigen::Vector3i(rgb[0], rgb[1], rgb[2]);
  };
  const double before_it = -side / 2 - 0.001;
  EXPECT_TRUE(is_orange(pixel(picture, *camera.project({0, before_it, 0.010}))));
  EXPECT_TRUE(is_orange(pixel(picture, *camera.project({0, before_it, 0.040}))));
  EXPECT_FALSE(is_orange(pixel(picture, *camera.project({0, before_it, 0.0535}))));
  EXPECT_FALSE(is_orange(pixel(picture, *camera.project({0.02, before_it, 0.010}))));
}

/// A hand that comes from above; no arrow.
Scene small_scene_with_a_path() {
  Scene scene = test::small_scene();
  scene.render->show_force = false;
  scene.devices[0].waypoints = {{0, Vec3(0, 0, 0.2)}, {1, Vec3(0, 0, 0)}};
  return scene;
}

/// Steel or backdrop, not skin, however dark the skin is.
bool is_bluish(const std::uint8_t* c) { return c[2] + 6 > c[0]; }

/// Pixels of a tool before the picture of the cube: the box round them. Skin that it shades does not count.
Eigen::AlignedBox2i box_of_tool(const Scene& scene, const HapticTrace& trace, const ToolWrench& wrench) {
  Picture picture(scene);
  show(picture, cube);
  picture.draw(0);
  const Image before = picture.image();
  picture.take(trace);
  picture.take(wrench);
  picture.draw(0);
  Eigen::AlignedBox2i box;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      if (is_bluish(picture.image().at(x, y)) &&
          !std::equal(before.at(x, y), before.at(x, y) + 3, picture.image().at(x, y)))
        box.extend(Eigen::Vector2i(x, y));
  return box;
}

/// How bright the near side of the cube is beside its middle, with a tip at some distance before it.
double brightness(double aside, double off, bool presses) {
  Scene scene = small_scene_with_a_path();
  scene.tools[0].radius = 0.006;
  Picture picture(scene);
  show(picture, cube);
  picture.take(test::trace_at({0, -side / 2 - off, 0}, 0, 0));
  ToolWrench wrench;
  wrench.n_contacts = presses ? 5 : 0;
  wrench.force = {0, presses ? -1.0 : 0.0, 0};
  picture.take(wrench);
  picture.draw(0);
  const auto p = *camera_of(scene).project({-aside, -side / 2, -0.004});
  const auto* rgb = picture.image().at(static_cast<int>(p.x()), static_cast<int>(p.y()));
  return rgb[0] + rgb[1] + rgb[2];
}

/// The nearer a tool the darker the tissue, and a ring where it presses: so distance and dent are seen.
TEST(PictureOfATool, ShadesTheTissueThatItNears) {
  const double radius = 0.006, beside = 0.7 * radius;
  const double far = brightness(beside, 0.03, false), near = brightness(beside, 0.004, false),
               touching = brightness(beside, 0, false);
  EXPECT_LT(near, far - 10);
  EXPECT_LT(touching, near - 10);
  const double on_ring = std::sqrt(1.25 * 1.25 * radius * radius - 0.004 * 0.004);
  EXPECT_LT(brightness(on_ring, 0, true), brightness(on_ring, 0, false) - 20);
  EXPECT_NEAR(brightness(2.5 * radius, 0, true), brightness(2.5 * radius, 0.03, false), 8)
      << "beyond it nothing";
}

TEST(PictureOfATool, LaysAStickAtTheProxyAsTheHandIsTurned) {
  Scene scene = test::small_scene();
  scene.render->show_force = false;
  scene.tools[0].shape = ToolShape::stick;
  scene.tools[0].length = 0.03;
  scene.tools[0].radius = 0.002;
  scene.tools[0].attitude << 0, 0, -1, 0, 1, 0, 1, 0, 0;  // -z becomes +x
  HapticTrace trace = test::trace_at({-0.03, -0.07, -0.02}, 0, 1);
  trace.samples[0].proxy = {-0.03, -0.07, 0.01};
  ToolWrench wrench;
  const Camera camera = camera_of(scene);
  const auto expect_box = [&](const Vec3& low, const Vec3& high) {
    const auto box = box_of_tool(scene, trace, wrench);
    const auto left_bottom = *camera.project(low), right_top = *camera.project(high);
    EXPECT_NEAR(box.min().x(), left_bottom.x(), 2);
    EXPECT_NEAR(box.max().x(), right_top.x(), 2);
    EXPECT_NEAR(box.max().y(), left_bottom.y(), 2);
    EXPECT_NEAR(box.min().y(), right_top.y(), 2);
  };
  expect_box({-0.032, -0.07, 0.008}, {0.002, -0.07, 0.012});
  wrench.q_WT = {std::sqrt(0.5), 0, -std::sqrt(0.5), 0};  // +x becomes +z
  expect_box({-0.032, -0.07, 0.008}, {-0.028, -0.07, 0.042});
  wrench.q_WT = {1, 0, 0, 0};
  scene.tools[0].force_model = ForceModel::direct;  // there the tool is where the hand is
  expect_box({-0.032, -0.07, -0.022}, {0.002, -0.07, -0.018});
}

TEST(PictureOfATool, RestsAPointOnTheSurface) {
  const Scene scene = small_scene_with_a_path();
  HapticTrace trace = test::trace_at({0, -0.07, -0.03}, 0, 1);
  trace.samples[0].proxy = {0, -0.07, 0.02};
  const auto box = box_of_tool(scene, trace, {});
  EXPECT_NEAR(box.max().y(), camera_of(scene).project({0, -0.07, 0.02})->y(), 2);
}

TEST(PictureOfATool, EndsAtTheTip) {
  const Scene scene = small_scene_with_a_path();
  const auto box = box_of_tool(scene, test::trace_at({0, -0.07, 0}, 0, 0), {});
  // It leans: its round end goes a little below the tip.
  EXPECT_NEAR(box.max().y(), camera_of(scene).project({0, -0.07, 0})->y(), 2);
}

}  // namespace
}  // namespace palpate::render
