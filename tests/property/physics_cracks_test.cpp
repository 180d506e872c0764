// Cracks through finite elements that run: what they take by their area.
#include <gtest/gtest.h>

#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

/// A layer that is peeled off by the weight of all behind it, at the step that the body takes by itself: a front of cells that tear
/// within a few steps each.
TEST(Crack, TakesItsShareWhereItRunsFast) {
  Recipe recipe = solid_box(40, 10, 60, 2.5);
  recipe.body += R"(
fixed = ["-x"]
regions = [{ material = "weak", box_min_mm = [0, -9, -40], box_max_mm = [2.49, 9, 40] }]
[[body.cavity]]
box_min_mm = [0, -9, -40]
box_max_mm = [2.49, 9, -20])";
  recipe.material = "density_kg_per_m3 = 2000\nmodulus_kPa = 10\npoisson_ratio = 0.45\nviscosity_Pa_s = 1";
  recipe.world =
      "[material.weak]\n" + recipe.material + "\nbreak_ratio = 1.3\nfracture_energy_J_per_m2 = 2\n";
  recipe.gravity = "[30, 0, 0]";
  World world(scene_of(recipe));
  run(world, 0.3);
  EXPECT_EQ(world.body(0).breaks(), 80);
  EXPECT_NEAR(world.ledger().broken / 500e-6, 2.0, 0.1 * 2.0);
}

/// A crack through tissue that is nowhere weaker, from notch to notch of a strip that a weight pulls: cells beside it lose stiffness,
/// too, more of them where they are small, and all of them together take no more than the crack.
TEST(Crack, TakesTheSameByAreaWhereCellsBesideACrackSoften) {
  for (const double edge_mm : {2.5, 1.25}) {
    Recipe recipe = solid_box(20, 5, 60, edge_mm);
    recipe.precision = "single";
    recipe.gravity = "[0, 0, -9.81]";
    recipe.body += R"(
fixed = ["+z"]
regions = [{ material = "heavy", box_min_mm = [-30, -9, -60], box_max_mm = [30, 9, -15] }]
[[body.cavity]]
box_min_mm = [-30, -9, -1.5]
box_max_mm = [-4.9, 9, 1.5]
[[body.cavity]]
box_min_mm = [4.9, -9, -1.5]
box_max_mm = [30, 9, 1.5])";
    const std::string soft = "modulus_kPa = 10\npoisson_ratio = 0.45\nviscosity_Pa_s = 2\n";
    recipe.material = "density_kg_per_m3 = 1000\n" + soft + "break_ratio = 1.4\nfracture_energy_J_per_m2 = 6";
    recipe.world = "[material.heavy]\ndensity_kg_per_m3 = 15000\n" + soft;
    World world(scene_of(recipe));
    run(world, 0.2);
    ASSERT_NE(world.fragments(0), nullptr) << edge_mm;
    EXPECT_GE(world.fragments(0)->count(), 2) << edge_mm;
    const auto area = static_cast<double>(world.body(0).breaks()) * edge_mm * edge_mm;  // [mm^2]
    const double by_area = world.ledger().broken / 50e-6;
    std::printf("cells of %.2f mm: %.0f mm^2 of cells are gone, %.3f J/m^2\n", edge_mm, area, by_area);
    EXPECT_NEAR(by_area, 6.0, 0.15 * 6.0) << edge_mm;
    EXPECT_LT(area, 1.3 * 50) << edge_mm;
  }
}

}  // namespace
}  // namespace palpate::physics::test
