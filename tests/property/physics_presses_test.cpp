// Finite elements under tools that press deep: nothing folds for good.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/solids/sphere_press.h"
#include "common/message/vec3.h"
#include "physics_node/contact/stick_tool.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// A stick of 6 mm radius comes down on its end, to 60 % of the depth of a block, and up again.
TEST(Press, ToSixTenthsOfItsDepthSurvivesAndComesBack) {
  for (const double nu : {0.45, 0.49}) {
    constexpr double top = 0.010, radius = 0.006, depth = 0.6 * 2 * top;
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(40, 40, 2e3 * top);
    recipe.spacing_mm = 4;
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 1\npoisson_ratio = " +
                      std::to_string(nu);
    recipe.body = "model = \"fem\"\nfixed = [\"-z\"]";
    recipe.precision = "single";
    recipe.world =
        "[[tool]]\nname = \"stick\"\nshape = \"stick\"\nlength_mm = 60\nradius_mm = 6\ndevice = \"hand\"\n"
        "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
    World world(scene_of(recipe));
    ToolState state;
    state.engaged = 1;
    state.q_WT = {0, 1, 0, 0};  // the stick stands on its tip
    double deepest_force = 0;
    for (int n = 0; n < 700; ++n) {
      const double t = 1e-3 * n;  // down for 0.2 s, and up
      const double down = std::clamp(std::min(t / 0.2, (0.4 - t) / 0.2), 0.0, 1.0);
      const double z = top + radius + 0.002 - down * (depth + 0.002);
      state.p_WT = state.proxy = array(Vec3(0.0007, 0.0004, z));
      ++state.tick;
      const std::optional<ToolState> hand = state;
      world.frame(std::span(&hand, 1));
      deepest_force = std::max(deepest_force, world.tool(0).force().z());
    }
    const BodyCounts counts = world.body(0).counts();
    std::printf("nu %.2f: up to %.2f N, least J of a corner %.3f, comes back to %.2g mm\n", nu, deepest_force,
                *counts.least_corner_J, 1e3 * counts.shape_rms);
    EXPECT_EQ(world.report().restored, 0);
    EXPECT_FALSE(world.has_stopped());
    EXPECT_GT(deepest_force, 0.5);
    EXPECT_LT(counts.shape_rms, 2e-5);
  }
}

/// A smooth sphere, 5 mm into 100 x 100 x 60 mm of 10 kPa, on cells of 2.5 mm; the reference is the same on cells of half the edge
/// (docs/benchmarks.md).
TEST(Press, OfASphereIsThatOfFinerCells) {
  struct Case {
    double radius_mm, poisson_ratio, reference, within, least_J;
  };
  // The smallest, of 1.2 cells, folds corners: see docs/benchmarks.md.
  for (const Case& c : {Case{3, 0.45, 0.2491, 0.12, -0.25}, Case{5, 0.45, 0.3756, 0.06, 0.4},
                        Case{8, 0.45, 0.5173, 0.03, 0.6}, Case{5, 0.49, 0.3831, 0.06, 0.4}}) {
    const bench::Pressed pressed =
        bench::press({.radius = 1e-3 * c.radius_mm, .poisson_ratio = c.poisson_ratio});
    std::printf("R %.0f mm, nu %.2f: %.4f N, %.4f of finer cells, least J of a corner %.3f\n", c.radius_mm,
                c.poisson_ratio, pressed.force.back(), pressed.force.back() / c.reference,
                *pressed.least_corner_J);
    EXPECT_TRUE(pressed.at_rest);
    EXPECT_TRUE(pressed.is_monotone());
    EXPECT_NEAR(pressed.force.back() / c.reference, 1, c.within);
    EXPECT_GT(*pressed.least_corner_J, c.least_J);
  }
}

}  // namespace
}  // namespace palpate::physics::test
