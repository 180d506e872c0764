// Several materials in one body: which mass is of which, what it weighs, and the elements between two.
#include "physics_node/body/materials.h"

#include <gmock/gmock.h>

#include <limits>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/element_constants.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;
using testing::HasSubstr;

const char* const hard =
    "[material.hard]\nmass_g = 3\nk1_N_per_m = 600\nk2_ratio = 0.5\nviscosity_N_s_per_m = 0.4\nyield_ratio = "
    "1.2\n"
    "break_ratio = 1.5\n";

/// 4 x 4 x 4 cells of 10 mm or an fcc block of 40 mm, centred on the origin.
Recipe block(const std::string& lattice, const std::string& regions) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.body = "regions = [" + regions + "]";
  recipe.world = hard;
  return recipe;
}

std::string upper_half(double from_mm) {
  return "{ material = \"hard\", box_min_mm = [-99, -99, " + std::to_string(from_mm) +
         "], box_max_mm = [99, 99, 99] }";
}

TEST(Laws, OfABodyOfOneMaterialNeedNoList) {
  const Body body = body_of(block("voxel", ""));
  EXPECT_TRUE(body.law_of.empty());
  ASSERT_EQ(body.laws.size(), 1u);
  EXPECT_EQ(body.laws[0].k1, body.law.k1);
  const Body same = body_of(block("voxel", "{ material = \"m\", center_mm = [0, 0, 0], radius_mm = 15 }"));
  EXPECT_TRUE(same.law_of.empty()) << "a region of the body's own material";
  EXPECT_EQ(same.laws.size(), 1u);
}

TEST(Laws, OfFccMassesFollowTheirPlace) {
  const Body body = body_of(block("fcc", upper_half(0)));
  ASSERT_EQ(body.law_of.size(), static_cast<std::size_t>(body.lattice.n_cells()));
  ASSERT_EQ(body.laws.size(), 2u);
  EXPECT_EQ(body.laws[0].mass, body.law.mass);
  for (const Index cell : body.lattice.masses) {
    const auto n = static_cast<std::size_t>(cell);
    const bool is_hard = body.lattice.rest_position(cell).z() >= -1e-9;
    EXPECT_EQ(body.law_of[n], is_hard ? 1 : 0);
    EXPECT_DOUBLE_EQ(body.inverse_mass[n], is_hard ? 1 / 3e-3 : 1 / 1e-3);
  }
}

TEST(Laws, OfVoxelMassesAreThoseOfMostCellsRoundThemAndOfTheLaterRegionInATie) {
  // The boundary runs through z = 0: masses there have as many soft as hard cells round them.
  const Body body = body_of(block("voxel", upper_half(0)));
  for (const Index cell : body.lattice.masses)
    EXPECT_EQ(body.law_of[static_cast<std::size_t>(cell)],
              body.lattice.rest_position(cell).z() > -1e-9 ? 1 : 0);
  // A column of cells at an edge: its inner corners have one hard cell of four (or two of eight) round them.
  const Body edge = body_of(
      block("voxel", "{ material = \"hard\", box_min_mm = [10, 10, -99], box_max_mm = [99, 99, 99] }"));
  for (const Index cell : edge.lattice.masses) {
    const Vec3 p = edge.lattice.rest_position(cell);
    const bool inner = p.x() < 0.011 && p.y() < 0.011;
    const bool reached = p.x() > 0.009 && p.y() > 0.009;
    EXPECT_EQ(edge.law_of[static_cast<std::size_t>(cell)], reached && !inner ? 1 : 0) << p.transpose();
  }
}

TEST(Laws, OfLaterRegionsWin) {
  const Body body = body_of(
      block("fcc", upper_half(-99) + ", { material = \"m\", center_mm = [0, 0, 0], radius_mm = 12 }"));
  for (const Index cell : body.lattice.masses)
    EXPECT_EQ(body.law_of[static_cast<std::size_t>(cell)],
              body.lattice.rest_position(cell).norm() <= 0.012 + 1e-9 ? 0 : 1);
}

TEST(Laws, FollowTheIntensityOfTheImage) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({6, 3, 3}, [](int i, int, int) { return i < 3 ? 100.F : 200.F; }), path);
  BodySpec spec = volume_body(path, 50, 300);
  spec.regions.push_back({"hard", IntensityRegion{150, 250}, {}});
  MaterialSpec hard_tissue = soft_material();
  hard_tissue.name = "hard";
  hard_tissue.density = 3000;
  const Body body = build_body(spec, std::vector<MaterialSpec>{soft_material(), hard_tissue});
  double total = 0;
  for (const Index cell : body.lattice.masses) {
    const auto n = static_cast<std::size_t>(cell);
    EXPECT_EQ(body.law_of[n], body.lattice.rest_position(cell).x() > -1e-9 ? 1 : 0);
    total += 1 / body.inverse_mass[n];
  }
  // Cells of 8 mm^3: 27 of each; the boundary layer, half of each, goes to the later region.
  EXPECT_NEAR(total, 8e-9 * (1000 * (27 - 4.5) + 3000 * (27 + 4.5)), 1e-15);
}

TEST(Laws, RefuseARegionThatHoldsNothing) {
  try {
    body_of(block("fcc", "{ material = \"hard\", center_mm = [0, 0, 99], radius_mm = 1 }"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("test.toml:"));
    EXPECT_THAT(error.what(),
                HasSubstr("region 1 of body \"body\" holds nothing of it; its place must reach"));
  }
}

TEST(ElementConstants, AreTheMeanOfTheEndsAndTheWeakerOfThem) {
  Recipe recipe = block("fcc", upper_half(0));
  recipe.material =
      "mass_g = 1\nk1_N_per_m = 200\nk2_ratio = 0.25\nviscosity_N_s_per_m = 0.1\nyield_ratio = "
      "1.3\nbreak_ratio = 1.4";
  const Body body = body_of(recipe);
  Index soft = -1;
  Index stiff = -1;
  for (const Index cell : body.lattice.masses)
    (body.law_of[static_cast<std::size_t>(cell)] == 0 ? soft : stiff) = cell;
  const auto both = element_constants(body, soft, stiff, 2);
  EXPECT_DOUBLE_EQ(both.k1, 400);
  EXPECT_DOUBLE_EQ(both.k2, (200 * 0.25 + 600 * 0.5) / 2);
  EXPECT_DOUBLE_EQ(both.c, 0.25);
  EXPECT_DOUBLE_EQ(both.y_p, 1.2);
  EXPECT_DOUBLE_EQ(both.b_p, 1.4);
  const auto back = element_constants(body, stiff, soft, 2);
  EXPECT_EQ(both.k1, back.k1);
  EXPECT_EQ(both.k2, back.k2);
  EXPECT_EQ(both.c, back.c);
  const auto inside = element_constants(body, stiff, stiff, 0);
  EXPECT_DOUBLE_EQ(inside.k1, 600);
  EXPECT_DOUBLE_EQ(inside.b_p, 1.5);
}

TEST(ElementConstants, OfElasticTissueNeverYield) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const Body body = body_of(block("fcc", upper_half(0)));
  const auto soft = element_constants(body.laws[0], body.laws[0], 0);
  EXPECT_EQ(soft.y_p, never);
  EXPECT_EQ(soft.b_p, never);
  EXPECT_DOUBLE_EQ(soft.k1, soft.k2);
  EXPECT_DOUBLE_EQ(element_constants(body.laws[0], body.laws[1], 0).y_p, 1.2);
  EXPECT_FALSE(body.law.yields);
  EXPECT_TRUE(any_yields(body));
  EXPECT_TRUE(any_damped(body));
}

TEST(Law, TakesTheForcePerStretchByLength) {
  Recipe recipe = block("voxel", "");
  recipe.material = "mass_g = 1\nlambda_N = 2\ndrag_N_s_per_m = 0.3";
  const Body body = body_of(recipe);
  for (std::size_t d = 0; d < static_cast<std::size_t>(body.lattice.n_half); ++d)
    EXPECT_DOUBLE_EQ(body.law.k1[d] * body.lattice.rest_length[d], 2);
  EXPECT_GT(body.law.k1[0], 1.4 * body.law.k1[3]) << "a face diagonal is longer";
  EXPECT_GT(body.law.modulus, 0);
  EXPECT_EQ(body.law.drag, 0.3);
  EXPECT_FALSE(body.law.damped);
}

TEST(Law, OfARegionTakesTheDamperOfTheBody) {
  Recipe recipe = block("fcc", upper_half(0));
  recipe.world = std::string(hard) + "damper = \"relative\"\n";
  const Body body = body_of(recipe);
  EXPECT_EQ(body.law.damper, Damper::relative) << "the body's own material has no damper";
  EXPECT_EQ(body.laws[1].damper, Damper::relative);
}

}  // namespace
}  // namespace palpate::physics
