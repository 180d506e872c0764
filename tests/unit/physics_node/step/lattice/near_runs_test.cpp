// How far a body is awake about a place: by how much tissue there is.
#include "physics_node/step/lattice/near_runs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

constexpr double least = 0.02;  // [m]

double reach(const std::string& box, const Vec3& place) {
  test::Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = box;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
  recipe.body = "model = \"fem\"";
  Body body = test::body_of(recipe);
  index_masses(body.lattice, Rows::in_segments);
  return reach_of(body, make_hex_grid(body), place, least);
}

TEST(NearRuns, ReachAsFarAsAskedForOnAFlatSkin) {
  EXPECT_EQ(reach(test::Recipe::box(200, 200, 100), Vec3(0, 0, 0.05)), least);
}

TEST(NearRuns, ReachNoLessFarInsideTissue) {
  EXPECT_EQ(reach(test::Recipe::box(200, 200, 200), Vec3(0, 0, 0)), least);
}

/// A quarter of a ball, or an eighth, that holds as much as a smaller one.
TEST(NearRuns, ReachFurtherAtEdgesAndCorners) {
  const std::string box = test::Recipe::box(200, 200, 100);
  EXPECT_NEAR(reach(box, Vec3(0.1, 0, 0.05)), std::cbrt(4) * least, 0.15 * least);
  EXPECT_NEAR(reach(box, Vec3(0.1, 0.1, 0.05)), std::cbrt(8) * least, 0.25 * least);
}

/// pi r^2 d = 4 / 3 pi R^3 for a sheet of the thickness d.
TEST(NearRuns, ReachFurtherInASheet) {
  EXPECT_NEAR(reach(test::Recipe::box(200, 200, 10), Vec3(0, 0, 0.005)),
              std::sqrt(4 * least * least * least / 3 / 0.01), 0.25 * least);
}

TEST(NearRuns, ReachThreeTimesAsFarAtMost) {
  EXPECT_NEAR(reach(test::Recipe::box(400, 10, 10), Vec3(0, 0, 0.005)), 3 * least, 0.3 * least);
  EXPECT_LE(reach(test::Recipe::box(400, 10, 10), Vec3(0, 0, 0.005)), 3 * least);
}

}  // namespace
}  // namespace palpate::physics
