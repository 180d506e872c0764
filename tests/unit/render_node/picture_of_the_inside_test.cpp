// What a picture shows of the inside of tissue: cut open by a section, coloured by what physics tells.

#include <gtest/gtest.h>

#include <memory>

#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "render_node/picture.h"
#include "render_node/view/camera.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

constexpr double side = 0.1;
const auto cube = test::cube_surface(12, side, 0xff96b4e6U);

Camera camera_of(const Scene& scene) { return test::camera_of_cube(scene, side); }

Eigen::Vector3i pixel(const Picture& picture, const Eigen::Vector2d& p) {
  const auto* rgb = picture.image().at(static_cast<int>(p.x()), static_cast<int>(p.y()));
  return {rgb[0], rgb[1], rgb[2]};
}

int difference(const Eigen::Vector3i& a, const Eigen::Vector3i& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// One half strains as much as the scale has, the other not at all.
TEST(PictureOfInside, ColoursTissueByWhatPhysicsTells) {
  Scene scene = test::small_scene();
  scene.render->colour = ColourKind::strain;
  Picture picture(scene);
  test::show(picture, cube);
  picture.draw(0);
  const auto left = *camera_of(scene).project({-0.03, -side / 2, 0}),
             right = *camera_of(scene).project({0.03, -side / 2, 0});
  const Eigen::Vector3i own = pixel(picture, right), other = pixel(picture, left);
  auto block = test::block_of(cube, 0, 1, 0);
  block.field_most = 0.2F;
  for (std::uint32_t v = 0; v < block.n_vertices; ++v) block.field[v] = block.position[v][0] > 0 ? 255 : 0;
  picture.take(block);
  picture.draw(0.1);
  EXPECT_LT(difference(pixel(picture, left), other), 4);
  EXPECT_LT(pixel(picture, right).y(), own.y() - 40);
}

/// A plane takes the half nearer to the eye away; what lay behind shows.
TEST(PictureOfInside, ShowsWhatASectionOpens) {
  Scene scene = test::small_scene();
  scene.bodies[0].lattice = LatticeKind::voxel;
  const auto at = *camera_of(scene).project({0.02, -side / 2, 0.01});
  Picture whole(scene);
  test::show(whole, cube);
  whole.draw(0);
  scene.render->section = SectionSpec{1, 0.0};
  Picture opened(scene);
  test::show(opened, cube);
  opened.draw(0);
  EXPECT_NE(whole.image().rgb, opened.image().rgb) << "the inside of the far half";
  // A section of the body closes it.
  auto cut = test::chunks_of(cube, 1, 1);
  for (auto& chunk : cut)
    for (std::uint32_t v = 0; v < chunk.n_vertices; ++v)
      chunk.position[v][1] = 0, chunk.rgba.fill(0xFF20F020);
  for (const auto& chunk : cut) opened.take(chunk);
  opened.draw(0);
  const Eigen::Vector3i with = pixel(opened, at);
  opened.set_section(std::nullopt);
  opened.draw(0);
  EXPECT_LT(difference(pixel(opened, at), pixel(whole, at)), 4) << "whole again";
  EXPECT_GT(difference(with, pixel(whole, at)), 40);
}

/// A green cube in the middle of another is seen through it, the fainter the more opaque that is; and not at all if nobody asks.
TEST(PictureOfInside, ShowsWhatLiesInsideThroughTheSkin) {
  Scene scene = test::small_scene();
  scene.bodies[0].lattice = LatticeKind::voxel;
  scene.bodies[0].shape = VolumeShape{};
  const auto at = *camera_of(scene).project({0, -side / 2, 0});
  const auto beside = *camera_of(scene).project({0.035, -side / 2, 0});
  const auto inner = test::chunks_of(test::cube_surface(6, side / 2, 0xFF20F020), 2, 1);
  const auto drawn = [&](std::optional<double> inside, double opacity) {
    scene.render->inside = inside;
    scene.render->opacity = opacity;
    auto picture = std::make_unique<Picture>(scene);
    test::show(*picture, cube);
    for (const auto& chunk : inner) picture->take(chunk);  // behind the section, which has none
    picture->draw(0);
    return picture;
  };
  const auto whole = drawn(std::nullopt, 1);
  const auto opaque = drawn(300, 1), veiled = drawn(300, 0.3), thicker = drawn(300, 0.7);
  EXPECT_EQ(whole->image().rgb, opaque->image().rgb);
  const auto green = [](const Picture& picture, const Eigen::Vector2d& p) {
    const Eigen::Vector3i rgb = pixel(picture, p);
    return rgb.y() - rgb.x();
  };
  EXPECT_GT(green(*veiled, at), green(*thicker, at) + 20);
  EXPECT_GT(green(*thicker, at), green(*whole, at) + 20);
  EXPECT_LT(std::abs(green(*veiled, beside) - green(*whole, beside)), 40) << "the background shines through";
  const int with = green(*veiled, at);
  veiled->set_inside(std::nullopt);
  veiled->draw(0);
  EXPECT_LT(green(*veiled, at), with - 20);
  EXPECT_EQ(whole->facets_visible(), veiled->facets_visible()) << "those of the body alone";
}

TEST(PictureOfInside, StaysWholeWhereASectionMeetsNothing) {
  Scene scene = test::small_scene();
  scene.bodies[0].lattice = LatticeKind::voxel;
  const auto drawn = [&](std::optional<SectionSpec> section) {
    scene.render->section = section;
    Picture picture(scene);
    test::show(picture, cube);
    picture.draw(0);
    return picture.image().rgb;
  };
  const auto whole = drawn(std::nullopt);
  EXPECT_EQ(drawn(SectionSpec{1, 9.0}), whole);
  EXPECT_EQ(drawn(SectionSpec{0, -9.0}), whole);
  EXPECT_NE(drawn(SectionSpec{0, 0.0}), whole);
}

/// A picture in colours has to say what they mean, panels or not.
TEST(PictureOfInside, HasALegendWithoutPanels) {
  Scene scene = test::small_scene();
  scene.render->show_panels = false;
  const auto corner = [&](ColourKind colour) {
    scene.render->colour = colour;
    Picture picture(scene);
    test::show(picture, cube);
    picture.draw(0);
    const Image& image = picture.image();
    std::vector<std::uint8_t> seen;
    for (int y = image.height * 3 / 4; y < image.height; ++y)
      for (int x = image.width * 3 / 4; x < image.width; ++x)
        seen.push_back(image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                      static_cast<std::size_t>(x))]);
    return seen;
  };
  EXPECT_NE(corner(ColourKind::own), corner(ColourKind::strain));
}

}  // namespace
}  // namespace palpate::render
