#include "physics_node/boundary/surface.h"
#include "physics_node/step/body_model.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "common/scene/body_spec.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/surface_volume.h"

namespace palpate::physics {
namespace {

using namespace test;

struct Made {
  std::unique_ptr<BodyModel> moving;
  Surface surface;
};

Made surface_of(const std::string& lattice, const std::string& shape) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = shape;
  Made made{make_body_model(body_of(recipe), Precision::double_), {}};
  made.surface = make_surface(*made.moving, std::nullopt, 0xFF112233);
  return made;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::map<Edge, int> directed_edges(const Surface& surface) {
  std::map<Edge, int> edges;
  for (const auto& facet : surface.facets)
    for (std::size_t n = 0; n < 4; ++n)
      if (facet[n] != facet[(n + 1) % 4]) ++edges[{facet[n], facet[(n + 1) % 4]}];
  return edges;
}

void expect_closed(const Surface& surface) {
  ASSERT_FALSE(surface.facets.empty());
  const auto edges = directed_edges(surface);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_NE(back, edges.end()) << "an open edge";
    ASSERT_EQ(count, 1);
    ASSERT_EQ(back->second, 1);
  }
}

TEST(VoxelSurface, OfABoxIsClosedAndHoldsItsVolume) {
  const auto [moving, surface] = surface_of("voxel", Recipe::box(40, 30, 20));
  EXPECT_EQ(surface.facets.size(), 2u * (12 + 8 + 6));
  EXPECT_EQ(surface.hidden, 3u * 3 * 2 + 4 * 2 * 2 + 4 * 3 * 1);
  EXPECT_EQ(surface.n_moving(), surface.n_vertices());
  expect_closed(surface);
  EXPECT_NEAR(volume_inside(surface), 24e-6, 1e-15);
}

TEST(VoxelSurface, OfATubeHoldsTheVolumeOfItsCells) {
  const auto [moving, surface] =
      surface_of("voxel", "shape = \"tube\"\nouter_radius_mm = 40\ninner_radius_mm = 20\nlength_mm = 60");
  EXPECT_NEAR(volume_inside(surface), 1e-6 * static_cast<double>(moving->body().cells->n_filled()), 1e-15);
}

TEST(VoxelSurface, ShowsOnlyWhatReachesTheThreshold) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({3, 1, 1}, [](int i, int, int) { return 100.F * static_cast<float>(i + 1); }),
               path);
  const auto moving =
      make_body_model(build_body(volume_body(path, 50, 400), soft_material()), Precision::double_);
  const auto from = [&](std::optional<double> threshold) { return make_surface(*moving, threshold, 0); };
  EXPECT_EQ(from(std::nullopt).facets.size(), 14u);
  EXPECT_EQ(from(std::nullopt).hidden, 2u);
  EXPECT_EQ(from(200).facets.size(), 10u);
  const Surface last = from(250);
  EXPECT_EQ(last.facets.size(), 6u);
  EXPECT_EQ(last.hidden, 0u);
  EXPECT_EQ(last.rgba[0], rgba_of(grey_transfer(0, 400), 300));
  EXPECT_TRUE(from(301).facets.empty());
}

TEST(VoxelSurface, PutsSceneryBehindMovingVertices) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({6, 3, 3}, [](int, int, int) { return 100.F; }), path);
  BodySpec spec = volume_body(path, 50, 200);
  std::get<VolumeShape>(spec.shape).deformable = {false, {0, 1, 1}, 1};
  const auto moving = make_body_model(build_body(spec, soft_material()), Precision::double_);
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  expect_closed(surface);
  EXPECT_EQ(surface.facets.size(), 2u * (18 + 18 + 9));
  EXPECT_EQ(surface.n_vertices(), 7u * 16 - 5 * 4);
  EXPECT_EQ(surface.n_moving(), 3u * 16 - 2 * 4);
  EXPECT_NEAR(volume_inside(surface), 54 * 8e-9, 1e-15);
}

class FccSurface : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shapes, FccSurface,
                         testing::Values(Recipe::box(40, 40, 40), Recipe::box(72, 43, 29), Recipe::sphere(30),
                                         Recipe::sphere(60)));

TEST_P(FccSurface, IsClosedAndFacesOutwards) {
  const auto [moving, surface] = surface_of("fcc", GetParam());
  const auto edges = directed_edges(surface);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_NE(back, edges.end()) << "an open edge";
    ASSERT_EQ(back->second, count);
  }
  // A mass stands for L^3 / sqrt(2), but those on the surface for less of the inside.
  const double whole = 1e-6 / std::numbers::sqrt2 * moving->body().lattice.n_masses();
  EXPECT_GT(volume_inside(surface), 0.4 * whole);
  EXPECT_LT(volume_inside(surface), whole);
}

TEST(FccSurface, OfACubeHoldsItsVolumeButForItsEdges) {
  // 60 mm are 6 steps a of L / sqrt(2) = 10 mm. Of an octahedron on an edge only four masses are there, so its quarter
  // a^3 / 3 stays open: three on each of twelve edges.
  Recipe recipe;
  recipe.shape = Recipe::box(60, 60, 60);
  recipe.spacing_mm = 10 * std::numbers::sqrt2;
  const auto moving = make_body_model(body_of(recipe), Precision::double_);
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  EXPECT_NEAR(volume_inside(surface), 204e-6, 1e-12);
}

}  // namespace
}  // namespace palpate::physics
