#include "physics_node/contact/tool_contact.h"
#include "physics_node/step/body_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

/// A body at rest and a tip beside it.
struct Touch {
  explicit Touch(const Recipe& recipe, double radius = 0.003)
      : moving(make_body_model(body_of(recipe), Precision::double_)),
        surface(*moving, 0.02),
        contact(surface, *moving, radius) {}
  std::unique_ptr<BodyModel> moving;
  Boundary surface;
  ToolContact contact;
};

Recipe slab() {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(80, 80, 20);
  recipe.spacing_mm = 4;
  return recipe;
}

double sum_of(const std::vector<MassShare>& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0,
                         [](double sum, const MassShare& s) { return sum + s.share; });
}

TEST(ToolContact, SeesAFlatFaceAsItsPlane) {
  Touch touch(slab());
  for (const double above : {0.001, 0.0, -0.002}) {
    const Vec3 p(0.0013, -0.0021, 0.010 + above);
    touch.contact.look(p, 0);
    const LocalPlane plane = touch.contact.plane_under(p);
    ASSERT_TRUE(plane.found);
    EXPECT_LT((plane.normal - Vec3::UnitZ()).norm(), 1e-6);
    EXPECT_NEAR(plane.point.z(), 0.010, 1e-9);
  }
}

TEST(ToolContact, KeepsTheNearestOfManyFacets) {
  Recipe recipe =
      slab();  // one layer of fine cells: more facets round the tip than are kept, its own face the last
  recipe.shape = Recipe::box(40, 40, 0.25);
  recipe.spacing_mm = 0.25;
  Touch touch(recipe);
  const Vec3 p(0.0013, -0.0021, 0.0002);
  touch.contact.look(p, 0);
  const LocalPlane plane = touch.contact.plane_under(p);
  ASSERT_TRUE(plane.found);
  EXPECT_NEAR(plane.point.z(), 0.000125, 1e-9);
  EXPECT_LT(touch.contact.nearest_distance(p), 0.0003);
}

TEST(ToolContact, SharesAForceAmongMovingMassesWithoutLoss) {
  Touch touch(slab());
  const Vec3 p(0.0013, -0.0021, 0.0101);
  touch.contact.look(p, 0);
  touch.contact.find_shares(p);
  EXPECT_NEAR(sum_of(touch.contact.shares()), 1, 1e-12);
  std::set<Index> cells;
  Vec3 centre = Vec3::Zero();
  for (const MassShare& share : touch.contact.shares()) {
    EXPECT_GT(share.share, 0);
    EXPECT_TRUE(cells.insert(share.cell).second);
    centre += share.share * touch.moving->position(share.cell);
  }
  EXPECT_NEAR(centre.z(), 0.010, 1e-9);
  EXPECT_LT((centre - p).head<2>().norm(), 0.002);  // half a cell
}

TEST(ToolContact, SeesAStaircaseAsTheSphereThatItStandsFor) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::sphere(40);
  recipe.spacing_mm = 2;
  Touch touch(recipe, 0.005);
  Dice dice(11);
  for (int n = 0; n < 50; ++n) {
    const Vec3 radial = dice.within(1).normalized();
    const Vec3 p = 0.040 * radial;
    touch.contact.look(p, n);
    const LocalPlane plane = touch.contact.plane_under(p);
    ASSERT_TRUE(plane.found);
    EXPECT_LT(std::acos(std::min(1.0, plane.normal.dot(radial))) * 180 / M_PI, 6.0) << radial.transpose();
    EXPECT_LT(std::abs(plane.point.norm() - 0.040), 0.002);
  }
}

TEST(ToolContact, FindsNothingInFreeSpace) {
  Touch touch(slab());
  const Vec3 p(0, 0, 0.2);
  touch.contact.look(p, 0);
  EXPECT_TRUE(std::isinf(touch.contact.nearest_distance(p)));
  EXPECT_FALSE(touch.contact.plane_under(p).found);
  touch.contact.find_shares(p);
  EXPECT_TRUE(touch.contact.shares().empty());
  PatchFacet facets[max_patch_facets];
  EXPECT_EQ(touch.contact.write_facets(p, 0, facets, max_patch_facets, false), 0u);
  EXPECT_EQ(touch.contact.contact_set(), 0u);
}

TEST(ToolContact, OffersTheNearestFacetsFirstWithinTheRoomGiven) {
  Touch touch(slab());
  const Vec3 p(0.0013, -0.0021, 0.011);
  touch.contact.look(p, 0);
  PatchFacet facets[max_patch_facets];
  const auto n = touch.contact.write_facets(p, 3, facets, max_patch_facets, false);
  EXPECT_EQ(n, max_patch_facets);
  EXPECT_NE(touch.contact.contact_set(), 0u);
  for (std::uint32_t f = 0; f < n; ++f) {
    EXPECT_EQ(facets[f].body, 3u);
    EXPECT_NEAR(facets[f].normal[2], 1, 1e-6);
    for (const auto& corner : facets[f].corners) EXPECT_NEAR(corner[2], 0.010, 1e-12);
  }
  EXPECT_LT(std::abs(facets[0].corners[0][0] - p.x()), 0.004);
  EXPECT_EQ(touch.contact.write_facets(p, 3, facets, 5, false), 4u);
}

TEST(ToolContact, ChangesTheContactSetWhenItMovesOn) {
  Touch touch(slab());
  PatchFacet facets[max_patch_facets];
  const auto set_at = [&](const Vec3& p) {
    touch.contact.look(p, 0);
    touch.contact.write_facets(p, 0, facets, max_patch_facets, false);
    return touch.contact.contact_set();
  };
  const auto here = set_at({0.001, 0.001, 0.011});
  EXPECT_EQ(set_at({0.001, 0.001, 0.011}), here);
  EXPECT_NE(set_at({0.017, 0.001, 0.011}), here);
}

}  // namespace
}  // namespace palpate::physics
