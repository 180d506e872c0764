#include "render_node/picture.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "render_node/view/camera.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

using test::block_of;
using test::cube_surface;
using test::pixels_that_differ;
using test::show;
using test::small_scene;

constexpr std::uint32_t skin = 0xff96b4e6U;
constexpr double side = 0.1;
const auto cube = cube_surface(12, side, skin);

Camera camera_of(const Scene& scene) { return test::camera_of_cube(scene, side); }

Eigen::Vector3i pixel(const Picture& picture, const Eigen::Vector2d& p) {
  const auto* rgb = picture.image().at(static_cast<int>(p.x()), static_cast<int>(p.y()));
  return {rgb[0], rgb[1], rgb[2]};
}

int difference(const Eigen::Vector3i& a, const Eigen::Vector3i& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(Picture, ShowsALitCubeWhereItIsAndTheBackgroundElsewhere) {
  const Scene scene = small_scene();
  Picture picture(scene), empty(scene);
  show(picture, cube);
  picture.draw(0);
  empty.draw(0);
  const Camera camera = camera_of(scene);
  const double near = -side / 2;  // the side that faces the viewer
  for (const double x : {-0.9, -0.4, 0.0, 0.4, 0.9}) {
    for (const double z : {-0.9, -0.4, 0.0, 0.4, 0.9}) {
      const auto at = *camera.project({x * side / 2, near, z * side / 2});
      const auto rgb = pixel(picture, at);
      EXPECT_GT(rgb.x(), rgb.z() + 15) << "skin is redder than blue at " << at.transpose();
      EXPECT_GT(rgb.x(), 60) << "lit at " << at.transpose();
    }
  }
  for (const double x : {-1.15, 1.15}) {
    const auto at = *camera.project({x * side / 2, near, 0});
    EXPECT_EQ(difference(pixel(picture, at), pixel(empty, at)), 0) << "background at " << at.transpose();
  }
}

TEST(Picture, IsDarkerWhereTissueHasYielded) {
  Scene scene = small_scene();
  Picture picture(scene);
  show(picture, cube);
  picture.draw(0);
  const auto at = *camera_of(scene).project({0.02, -side / 2, 0.01});
  const auto other = *camera_of(scene).project({-0.03, -side / 2, -0.03});
  const auto elastic = pixel(picture, at), far = pixel(picture, other);
  auto block = block_of(cube, 0, 1, 0);
  for (std::uint32_t v = 0; v < block.n_vertices; ++v) {
    if (block.position[v][0] > 0) block.flags[v] = vertex_yielded | 63 * vertex_share_one;
  }
  picture.take(block);
  picture.draw(0);
  EXPECT_LT(pixel(picture, at).sum() * 2, elastic.sum());
  EXPECT_LE(difference(pixel(picture, other), far), 2);
}

TEST(Picture, IsHalfDarkWhereHalfOfTheElementsHaveYielded) {
  const Scene scene = small_scene();
  const auto brightness = [&](std::uint8_t flags) {
    Picture picture(scene);
    show(picture, cube);
    auto block = block_of(cube, 0, 1, 0);
    block.flags.fill(flags);
    picture.take(block);
    picture.draw(0);
    return pixel(picture, *camera_of(scene).project({0.02, -side / 2, 0.01})).sum();
  };
  const int light = brightness(vertex_broken), dark = brightness(vertex_yielded | 63 * vertex_share_one);
  const int half = brightness(vertex_yielded | 32 * vertex_share_one);
  EXPECT_LT(dark + 100, half);
  EXPECT_LT(half + 100, light);
  EXPECT_EQ(light, brightness(0)) << "a mass that lost an element is not darker for that";
}

// A mass and an element that no facet shows, before the cube.
test::VoxelSurface cube_and_loose_parts() {
  auto surface = cube;
  const auto n = static_cast<std::uint32_t>(surface.position.size());
  surface.position.insert(surface.position.end(),
                          {{-0.02F, -0.08F, 0}, {0.01F, -0.08F, -0.01F}, {0.03F, -0.08F, 0.02F}});
  surface.corners.push_back({n, n, n, n});
  surface.corners.push_back({n + 1, n + 2, n + 2, n + 2});
  surface.rgba.insert(surface.rgba.end(), {0xff20c020U, 0xff20c020U});
  return surface;
}

TEST(Picture, ShowsMassesAndElementsThatNoFacetShows) {
  const Scene scene = small_scene();
  Picture without(scene), with(scene);
  show(without, cube);
  show(with, cube);
  show(with, cube_and_loose_parts(), 2);
  without.draw(0);
  with.draw(0);
  const Camera camera = camera_of(scene);
  const auto is_green = [](const Eigen::Vector3i& c) { return c.y() > c.x() + 10 && c.y() > c.z() + 10; };
  EXPECT_TRUE(is_green(pixel(with, *camera.project({-0.02, -0.08, 0})))) << "the mass";
  EXPECT_GT(pixels_that_differ(without.image(), with.image()), 20);
  int on_line = 0;
  for (int i = 1; i < 20; ++i) {
    const Vec3 p = Vec3(0.01, -0.08, -0.01) + i / 20.0 * Vec3(0.02, 0, 0.03);
    const auto at = *camera.project(p);
    bool any = false;
    for (const double dx : {-1.0, 0.0, 1.0}) any = any || is_green(pixel(with, at + Eigen::Vector2d(dx, 0)));
    on_line += any ? 1 : 0;
  }
  EXPECT_GT(on_line, 15) << "the element";
  EXPECT_EQ(with.facets_visible(), without.facets_visible());
}

TEST(Picture, ShowsYieldedElementsAsDarkWires) {
  Scene scene = small_scene();
  scene.render->show_wire = true;
  const auto dark_pixels = [&](std::uint8_t flags) {
    Picture picture(scene);
    show(picture, cube);
    auto block = block_of(cube, 0, 1, 0);
    block.flags.fill(flags);
    picture.take(block);
    picture.draw(0);
    int dark = 0;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) dark += pixel(picture, Eigen::Vector2d(x, y)).maxCoeff() < 110 ? 1 : 0;
    return dark;
  };
  EXPECT_GT(dark_pixels(vertex_yielded | 63 * vertex_share_one), 10 * dark_pixels(0) + 500);
}

TEST(Picture, ShowsFloorAndWalls) {
  Scene scene = small_scene();
  Picture open(scene);
  scene.walls.push_back({Vec3(0.1, 0, 0), -Vec3::UnitX()});
  scene.render->camera.yaw = 0.5;
  Picture walled(scene);
  scene.walls.clear();
  Picture turned(scene);
  scene.floor = FloorSpec{-0.06};
  Picture floored(scene);
  for (Picture* picture : {&open, &walled, &turned, &floored}) {
    show(*picture, cube);
    picture->draw(0);
  }
  EXPECT_GT(pixels_that_differ(turned.image(), walled.image()), 3000);
  EXPECT_GT(pixels_that_differ(turned.image(), floored.image()), 3000);
}

TEST(Picture, KeepsTheFloorUnderAFallInSight) {
  Scene scene = small_scene();
  scene.floor = FloorSpec{-0.5};
  Picture picture(scene);
  show(picture, cube);
  picture.draw(0);
  Camera camera(scene.render->camera);
  camera.set_picture(320, 240, 0);
  camera.fit({Vec3(-side / 2, -side / 2, -0.5), Vec3::Constant(side / 2)});
  const auto top = *camera.project({0, -side / 2, 0.03}), bottom = *camera.project({0, -side / 2, -0.5});
  EXPECT_GT(pixel(picture, top).x(), pixel(picture, top).z() + 15) << "the cube, near the upper edge";
  EXPECT_LT(bottom.y(), 240);
}

TEST(Picture, FollowsVerticesThatMove) {
  const Scene scene = small_scene();
  Picture picture(scene);
  show(picture, cube);
  picture.draw(0);
  const Image before = picture.image();
  picture.draw(0.1);
  EXPECT_EQ(pixels_that_differ(before, picture.image()), 0);
  auto block = block_of(cube, 0, 1, 0);
  for (std::uint32_t v = 0; v < block.n_vertices; ++v) block.position[v][0] += 0.02F;
  picture.take(block);
  picture.draw(0.2);
  const Camera camera = camera_of(scene);
  const auto left = *camera.project({-0.042, -side / 2, 0}), right = *camera.project({0.058, -side / 2, 0});
  EXPECT_GT(pixel(picture, right).x(), pixel(picture, right).z() + 15);  // came
  EXPECT_LT(pixel(picture, left).x(), pixel(picture, left).z());         // went: bluish background
}

/// The whole cube moves by as much as the scale has: what was skin is violet, and a legend says so.
TEST(Picture, ColoursTissueByHowFarItIsFromRest) {
  Scene scene = small_scene();
  const auto middle = *camera_of(scene).project({0, -side / 2, 0});
  for (const bool shown : {false, true}) {
    scene.render->colour = shown ? ColourKind::displacement : ColourKind::own;
    Picture picture(scene);
    show(picture, cube);
    picture.draw(0);
    const Eigen::Vector3i own = pixel(picture, middle);
    auto block = block_of(cube, 0, 1, 0);
    for (std::uint32_t v = 0; v < block.n_vertices; ++v) block.position[v][0] += 0.0199F;
    picture.take(block);
    picture.draw(0.1);
    const Eigen::Vector3i now = pixel(picture, middle);
    if (!shown) {
      EXPECT_LT(difference(own, now), 12);
      continue;
    }
    EXPECT_LT(now.y(), own.y() - 40);
    EXPECT_GT(now.z(), now.y() + 20);
  }
}

TEST(Picture, UploadsOnlyWhatMoved) {
  const auto large = cube_surface(80, side, skin);
  Picture picture(small_scene());
  show(picture, large);
  picture.draw(0);
  const auto all = picture.bytes_uploaded();
  picture.draw(0);
  EXPECT_EQ(picture.bytes_uploaded(), 0U);
  auto block = block_of(large, 0, 1, 3);
  for (std::uint32_t v = 0; v < 50; ++v) block.position[v][2] += 0.0005F;
  picture.take(block);
  picture.draw(0);
  EXPECT_GT(picture.bytes_uploaded(), 0U);
  EXPECT_LT(picture.bytes_uploaded(), all / 5);
}

TEST(Picture, CountsFacets) {
  Picture picture(small_scene());
  EXPECT_EQ(picture.facets_total(), 0U);
  show(picture, cube);
  EXPECT_EQ(picture.facets_visible(), 6U * 12 * 12);
  EXPECT_EQ(picture.facets_total(), 3U * 12 * 12 * 13);  // all faces of all cells
}

TEST(Picture, GivesTheSameBytesForTheSameMessages) {
  Scene scene = small_scene();
  scene.render->show_panels = true;
  scene.floor = FloorSpec{-0.06};
  const auto drawn = [&] {
    Picture picture(scene);
    show(picture, cube);
    for (int i = 0; i < 200; ++i) picture.take(test::trace_at({0, -0.05, 0.02}, i * 0.01, 0.01 * i));
    NodeStatus status;
    status.rate_Hz = 1000;
    picture.take(status);
    picture.draw(2.0);
    return picture.image();
  };
  const Image one = drawn(), two = drawn();
  EXPECT_EQ(pixels_that_differ(one, two), 0);
}

TEST(Picture, WritesAPngOfTheSceneSize) {
  Scene scene = small_scene();
  Picture picture(scene);
  show(picture, cube);
  picture.draw(0);
  const auto path = (std::filesystem::path(testing::TempDir()) / "palpate_picture_test.png").string();
  picture.save_png(path);
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&read, path.c_str()), 0);
  EXPECT_EQ(read.width, 320U);
  EXPECT_EQ(read.height, 240U);
  png_image_free(&read);
  std::filesystem::remove(path);
}

TEST(Picture, ShowsPanelsOnTheLeftAndTheBodyBeside) {
  Scene scene = small_scene();
  scene.render->size_px = {1280, 720};
  Picture without(scene);
  scene.render->show_panels = true;
  Picture with(scene);
  for (Picture* picture : {&without, &with}) {
    show(*picture, cube);
    picture->draw(1.25);
  }
  int dark = 0;  // letters
  for (int y = 0; y < 720; ++y) {
    for (int x = 0; x < 300; ++x) dark += with.image().at(x, y)[0] < 90 ? 1 : 0;
  }
  EXPECT_GT(dark, 400);
  const auto is_skin = [](const Picture& picture, int x) {
    const auto* rgb = picture.image().at(x, 360);
    return rgb[0] > rgb[2] + 15;
  };
  EXPECT_TRUE(is_skin(without, 640));
  EXPECT_TRUE(is_skin(with, (1280 + 308) / 2));
}

TEST(Picture, DrawsWiresOverTheSurface) {
  Scene scene = small_scene();
  Picture plain(scene);
  scene.render->show_wire = true;
  Picture wired(scene);
  for (Picture* picture : {&plain, &wired}) {
    show(*picture, cube);
    picture->draw(0);
  }
  EXPECT_GT(pixels_that_differ(plain.image(), wired.image()), 1000);
}

}  // namespace
}  // namespace palpate::render
