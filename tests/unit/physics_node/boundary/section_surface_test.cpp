// What a section shows: the cells of its layer in their greys, where they are, whatever moves or has gone.
#include "physics_node/boundary/section_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "physics_node/step/body_model.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/smooth_image.h"

namespace palpate::physics {
namespace {

using namespace test;

Surface section_of(const Body& body, const SectionSpec& section) {
  LiveElements all(body);
  all.copy(body, body.adjacency());
  return section_surface(body, all, section, grey_scale_of(*body.cells), 0xFF8080C0);
}

double area_of(const Surface& surface) {
  double area = 0;
  for (const auto& f : surface.facets)
    area +=
        0.5 * (surface.rest[f[2]] - surface.rest[f[0]]).cross(surface.rest[f[3]] - surface.rest[f[1]]).norm();
  return area;
}

TEST(SectionSurface, OfABallIsADisc) {
  const Body body = SmoothImage{}.body();
  const Vec3 centre = 1e-3 * Vec3(0.37, -0.21, 0.55);
  for (int axis = 0; axis < 3; ++axis)
    for (const double off : {0.0, 0.0071, -0.0127}) {
      const Surface surface = section_of(body, {axis, centre[axis] + off});
      const double radius = std::sqrt(0.0183 * 0.0183 - off * off);
      // The layer is that of the cell which holds the plane: off by what the ball narrows within half of one.
      const double within = 0.03 + 2 * std::abs(off) * 0.001 / (radius * radius);
      EXPECT_NEAR(area_of(surface) / (std::numbers::pi * radius * radius), 1, within) << axis << " " << off;
      EXPECT_EQ(surface.n_moving(), surface.n_vertices());
      for (const Vec3& p : surface.rest) EXPECT_DOUBLE_EQ(p[axis], centre[axis] + off);
    }
}

TEST(SectionSurface, IsEmptyBesideTheBody) {
  const Body body = SmoothImage{}.body();
  EXPECT_TRUE(section_of(body, {0, 0.1}).facets.empty());
  EXPECT_TRUE(section_of(body, {2, -0.1}).facets.empty());
  EXPECT_TRUE(section_of(body, {2, std::numeric_limits<double>::infinity()}).facets.empty());
}

TEST(SectionSurface, HasTheGreysOfTheImage) {
  const Body body = SmoothImage{}.body();
  const GreyScale grey = grey_scale_of(*body.cells);
  const Surface surface = section_of(body, {1, 0.0003});
  ASSERT_FALSE(surface.facets.empty());
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Vec3i cell = body.cells->cell_of(surface.site[f]);
    const auto intensity = static_cast<double>(body.cells->intensity[surface.site[f]]);
    const double share =
        std::sqrt(std::clamp((intensity - grey.black) / (grey.white - grey.black), 0.01, 1.0));
    EXPECT_NEAR(surface.rgba[f] & 0xFFU, 255 * share, 0.51);
    EXPECT_EQ(surface.rgba[f] & 0xFFU, surface.rgba[f] >> 8U & 0xFFU);
    EXPECT_TRUE(body.cells->is_filled(cell.x(), cell.y(), cell.z()));
  }
  // The ball is brightest in its middle.
  const auto brightest = std::max_element(surface.rgba.begin(), surface.rgba.end()) - surface.rgba.begin();
  EXPECT_LT(surface.rest[surface.facets[static_cast<std::size_t>(brightest)][0]].norm(), 0.006);
}

TEST(SectionSurface, MovesWithTheTissue) {
  const auto moving = make_body_model(SmoothImage{}.body(), Precision::double_);
  const Surface surface = section_of(moving->body(), {0, 0.0041});
  Eigen::Matrix3d A;
  A << 0.9, -0.6, 0.1, 0.5, 1.1, -0.2, 0.05, 0.3, 0.8;
  for (const Index node : moving->body().nodes()) {
    const Vec3 rest = moving->body().rest_position(node);
    moving->place(node, A * rest - rest, Vec3::Zero());
  }
  for (std::size_t v = 0; v < surface.n_vertices(); ++v)
    ASSERT_LT((surface.position(v, *moving) - A * surface.rest[v]).norm(), 1e-14);
}

TEST(SectionSurface, OfSceneryStays) {
  const palpate::test::ScratchFolder folder;
  BodySpec spec = SmoothImage{}.spec(folder);
  std::get<VolumeShape>(spec.shape).deformable = {false, {12, 12, 21}, 6};
  const auto moving = make_body_model(build_body(spec, soft_material()), Precision::double_);
  const Surface surface = section_of(moving->body(), {0, 0.0003});
  EXPECT_GT(surface.n_moving(), 20u);
  EXPECT_LT(surface.n_moving(), surface.n_vertices());
  EXPECT_NEAR(area_of(surface) / (std::numbers::pi * 0.0183 * 0.0183), 1, 0.05);
}

TEST(SectionSurface, LeavesOutWhatIsGone) {
  SmoothImage image;
  image.breaks = true;
  const Body body = image.body();
  LiveElements none(body);
  EXPECT_TRUE(section_surface(body, none, {0, 0.0003}, {}, 0).facets.empty());
}

TEST(SectionSurface, OfBricksWithoutAnImageIsDarker) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(40, 30, 20);
  recipe.spacing_mm = 5;
  const Surface surface = section_of(body_of(recipe), {2, 0.0});
  EXPECT_EQ(surface.facets.size(), 8u * 6);
  EXPECT_NEAR(area_of(surface), 0.04 * 0.03, 1e-12);
  EXPECT_EQ(surface.rgba[0], 0xFF66669AU);
}

}  // namespace
}  // namespace palpate::physics
