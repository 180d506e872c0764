// From cursor, wheel and keys to the tip of a tool in the world.

#include "render_node/view/tool_pointer.h"
#include "common/scene/render_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/message/vec3.h"

namespace palpate::render {
namespace {

Camera camera_at(double yaw, double pitch, int covered = 0) {
  CameraSpec spec;
  spec.yaw = yaw;
  spec.pitch = pitch;
  spec.target = Vec3(0.1, -0.2, 0.3);
  spec.distance = 0.5;
  Camera camera(spec);
  camera.set_picture(1280, 720, covered);
  return camera;
}

PointerInput cursor_at(double x, double y) {
  PointerInput input;
  input.cursor = {x, y};
  return input;
}

TEST(CameraRay, FindsThePointThatProjectsToThePixel) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = camera_at(4 * u(random), 1.4 * u(random), i % 2 == 0 ? 0 : 308);
    const Eigen::Vector2d pixel(640 + 600 * u(random), 360 + 350 * u(random));
    const double depth = 0.5 + 0.3 * u(random);
    const Vec3 p = camera.at(pixel, depth);
    ASSERT_NEAR(camera.depth(p), depth, 1e-12);
    ASSERT_LT((*camera.project(p) - pixel).norm(), 1e-8);
  }
}

TEST(ToolPointer, LiesWhereItIsUntilItIsTaken) {
  ToolPointer pointer(3, {0.1, -0.2, 0.4});
  auto input = cursor_at(100, 100);
  input.wheel = 5;
  input.turn = {1, 0, 0};
  input.buttons = 1;
  pointer.follow(input, camera_at(0, 0), 0.1);
  const Pointer said = pointer.message(77);
  EXPECT_EQ(said.tool, 3u);
  EXPECT_EQ(said.stamp_ns, 77);
  EXPECT_EQ(said.held, 0u);
  EXPECT_EQ(said.buttons, 0u);
  EXPECT_EQ(said.p_W, (Array3{0.1, -0.2, 0.4}));
  EXPECT_EQ(said.q_W, (Array4{1, 0, 0, 0}));
  EXPECT_EQ(pointer.message(78).tick, said.tick + 1);
}

TEST(ToolPointer, StaysUnderTheCursorInThePlaneThatFacesTheCamera) {
  const Camera camera = camera_at(0.7, 0.3, 308);
  ToolPointer pointer(0, {0.12, -0.25, 0.33});
  const double depth = camera.depth(pointer.position());
  auto input = cursor_at(700, 300);
  input.toggle = true;
  pointer.follow(input, camera, 0.03);
  EXPECT_TRUE(pointer.held());
  for (const double x : {700.0, 720.0, 1100.0}) {
    pointer.follow(cursor_at(x, 300), camera, 0.03);
    EXPECT_NEAR(camera.project(pointer.position())->x(), x, 1e-8);
    EXPECT_NEAR(camera.project(pointer.position())->y(), 300, 1e-8);
    EXPECT_NEAR(camera.depth(pointer.position()), depth, 1e-12);
  }
}

TEST(ToolPointer, GoesIntoTheSceneWithTheWheelAndStaysUnderTheCursor) {
  const Camera camera = camera_at(0, 0);
  ToolPointer pointer(0, camera.target());
  auto input = cursor_at(900, 200);
  input.toggle = true;
  pointer.follow(input, camera, 0.03);
  const double before = camera.depth(pointer.position());
  input.toggle = false;
  input.wheel = 2;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR(camera.depth(pointer.position()) - before, 2 * 0.005 * 0.5, 1e-12);
  EXPECT_LT((*camera.project(pointer.position()) - input.cursor).norm(), 1e-8);
  EXPECT_GT(pointer.position().y(), camera.target().y()) << "yaw 0 looks along +y";
  input.fine = true;
  input.wheel = -10;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR(camera.depth(pointer.position()) - before, 0.005 * 0.5, 1e-12);
  input.fine = false;
  input.wheel = -1e6;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR(camera.depth(pointer.position()), 0.02 * 0.5, 1e-12) << "it stays before the eye";
}

TEST(ToolPointer, HoldsStillWhileTheCameraIsMoved) {
  ToolPointer pointer(0, {0.12, -0.25, 0.33});
  Camera camera = camera_at(0.2, 0.1);
  auto input = cursor_at(600, 400);
  input.toggle = true;
  pointer.follow(input, camera, 0.03);
  const Vec3 held = pointer.position();
  input.toggle = false;
  input.follows = false;
  for (int i = 0; i < 20; ++i) {
    camera.rotate(15, 3);
    input.cursor.x() += 15;
    pointer.follow(input, camera, 0.03);
  }
  EXPECT_EQ(pointer.position(), held);
  input.wheel = 1;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR((pointer.position() - held).norm(), 0.005 * 0.5, 1e-12);
}

TEST(ToolPointer, TurnsAboutTheAxesOfTheCamera) {
  const Camera camera = camera_at(0, 0);  // right +x, up +z, towards the viewer -y
  ToolPointer pointer(0, camera.target());
  auto input = cursor_at(640, 360);
  input.toggle = true;
  pointer.follow(input, camera, 0.03);
  input.toggle = false;
  input.turn = {0, 1, 0};
  for (int i = 0; i < 100; ++i) pointer.follow(input, camera, M_PI / 200);
  EXPECT_LT((pointer.attitude() * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-9)
      << "a quarter about up, at 1 rad/s";
  input.turn = {0, 0, 1};
  for (int i = 0; i < 100; ++i) pointer.follow(input, camera, M_PI / 200);
  EXPECT_LT((pointer.attitude() * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-9);
  EXPECT_LT((pointer.attitude() * Vec3::UnitY() + Vec3::UnitZ()).norm(), 1e-9) << "-x, a quarter about -y";
  EXPECT_NEAR(pointer.attitude().norm(), 1, 1e-12);
}

TEST(ToolPointer, IsPlacedWhereOneClicksAndPressesFromThereOn) {
  const Camera camera = camera_at(0, 0);
  ToolPointer pointer(0, {0, 0, 0});
  auto input = cursor_at(640, 360);
  input.place = true;
  pointer.follow(input, camera, 0.03);
  EXPECT_FALSE(pointer.held()) << "there is no tissue under the cursor";
  const double surface = camera.distance();  // deep
  const auto at_depth = [&](double depth) {
    return [&camera, depth](const Eigen::Vector2d& pixel) { return std::optional(camera.at(pixel, depth)); };
  };
  input.surface = at_depth(surface);
  pointer.follow(input, camera, 0.03);
  ASSERT_TRUE(pointer.held());
  EXPECT_LT((pointer.position() - camera.at(input.cursor, surface)).norm(), 1e-12);
  // 1. three notches press by three steps
  const double step = ToolPointer::depth_per_notch * camera.distance();
  input.place = false;
  input.wheel = 3;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR(camera.depth(pointer.position()), surface + 3 * step, 1e-12);
  // 2. led over a slope it stays as deep in it, under the cursor
  input.wheel = 0;
  for (int i = 1; i < 20; ++i) {
    input.cursor.x() += 5;
    input.surface = at_depth(surface + 0.002 * i);
    pointer.follow(input, camera, 0.03);
    EXPECT_NEAR(camera.depth(pointer.position()), surface + 0.002 * i + 3 * step, 1e-12);
    EXPECT_LT((*camera.project(pointer.position()) - input.cursor).norm(), 1e-8);
  }
  // 3. beside the tissue it keeps to a plane
  const double last = camera.depth(pointer.position());
  input.surface = nullptr;
  input.cursor.x() += 50;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR(camera.depth(pointer.position()), last, 1e-12);
  // 4. another click places it on the surface again
  input.surface = at_depth(surface);
  input.place = true;
  pointer.follow(input, camera, 0.03);
  EXPECT_NEAR(camera.depth(pointer.position()), surface, 1e-12);
  input.place = false;
  input.let_go = true;
  pointer.follow(input, camera, 0.03);
  EXPECT_FALSE(pointer.held());
}

/// However seldom a picture comes, it comes down in steps, and waits until forces are on.
TEST(ToolPointer, ComesDownOnTheSurfaceFromWhereItIsLifted) {
  const Camera camera = camera_at(0, 0);
  for (const double seconds : {0.01, 0.1, 2.0}) {
    ToolPointer pointer(0, {0, 0, 0});
    auto input = cursor_at(640, 360);
    input.place = true;
    input.lift = 0.02;
    input.surface = [&](const Eigen::Vector2d& pixel) { return std::optional(camera.at(pixel, 0.4)); };
    pointer.follow(input, camera, seconds);
    input.place = false;
    double before = camera.depth(pointer.position()), passed = std::min(seconds, 0.1), most = 0;
    EXPECT_NEAR(before, 0.38, 1e-12);
    while (passed < 1.2) {
      pointer.follow(input, camera, seconds);
      passed += std::min(seconds, 0.1);
      const double now = camera.depth(pointer.position());
      EXPECT_GE(now, before - 1e-12);
      EXPECT_TRUE(passed > ToolPointer::wait_s - 1e-9 || std::abs(now - 0.38) < 1e-12);
      most = std::max(most, now - before);
      before = now;
    }
    EXPECT_NEAR(before, 0.4, 1e-12);
    EXPECT_LE(most, 0.02 / ToolPointer::landing_s * 0.1 + 1e-12);
    input.place = true;
    pointer.follow(input, camera, seconds);
    EXPECT_NEAR(camera.depth(pointer.position()), 0.38, 1e-12) << "placed again it comes from outside again";
  }
}

/// A view from another side shows other tissue under the cursor: to follow that would lead the tool through the body.
TEST(ToolPointer, StaysWhenTheViewJumpsAndGoesOnFromThere) {
  Camera camera = camera_at(0, 0, 308);
  const Vec3 middle = camera.target();
  // A wall across y, met from -y only.
  const auto wall = [&](const Eigen::Vector2d& pixel) -> std::optional<Vec3> {
    const Vec3 ray = camera.at(pixel, 1) - camera.eye();
    if (ray.y() <= 0) return std::nullopt;
    return Vec3(camera.eye() + (middle.y() - camera.eye().y()) / ray.y() * ray);
  };
  ToolPointer pointer(0, middle);
  auto input = cursor_at(700, 300);
  input.place = true;
  input.surface = wall;
  pointer.follow(input, camera, 0.03);
  input.place = false;
  input.wheel = 2;
  pointer.follow(input, camera, 0.03);
  input.wheel = 0;
  const Vec3 pressed = pointer.position();
  ASSERT_GT(pressed.y(), middle.y() + 0.004);
  for (const double yaw : {0.3, 1.2, 3.0, 0.1}) {
    camera.look_from(yaw, 0.2);
    pointer.follow(input, camera, 0.03);
    EXPECT_LT((pointer.position() - pressed).norm(), 1e-9) << yaw;
    pointer.follow(input, camera, 0.03);
    EXPECT_LT((pointer.position() - pressed).norm(), 1e-9) << "and in the next picture";
  }
  input.cursor.x() += 10;
  pointer.follow(input, camera, 0.03);
  EXPECT_GT(pointer.position().x(), pressed.x() + 1e-3) << "led on from there";
  EXPECT_LT((pointer.position() - pressed).norm(), 0.02);
  EXPECT_TRUE(pointer.held());
  camera.look_at(middle - 100 * camera.axes().row(2).transpose(), 0.1);
  pointer.follow(input, camera, 0.03);
  EXPECT_FALSE(pointer.held()) << "nobody leads what is behind the eye";
}

TEST(ToolPointer, LetsGoWhereItIs) {
  const Camera camera = camera_at(0, 0);
  ToolPointer pointer(0, camera.target());
  auto input = cursor_at(700, 300);
  input.toggle = true;
  input.buttons = 1;
  pointer.follow(input, camera, 0.03);
  EXPECT_EQ(pointer.message(1).buttons, 1u);
  const Vec3 there = pointer.position();
  input.cursor = {100, 100};
  pointer.follow(input, camera, 0.03);
  EXPECT_EQ(pointer.message(2).held, 0u);
  EXPECT_EQ(pointer.message(3).buttons, 0u);
  EXPECT_EQ(pointer.position(), there);
}

}  // namespace
}  // namespace palpate::render
