// A tip that is held in tissue under backward_euler: it rests, as in explicit steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// Tip of a hand that dives 2 mm into a slab within 0.1 s and stays: force that it gives, and work that it does then. [N], [J]
struct Held {
  double force = 0, work = 0, wobble = 0;
};
Held held_tip(const std::string& physics, double modulus_kPa) {
  Recipe recipe = pressed_slab_recipe();
  recipe.body += "\nmodel = \"fem\"";
  recipe.material =
      fmt::format("density_kg_per_m3 = 1000\nmodulus_kPa = {}\npoisson_ratio = 0.45\nviscosity_Pa_s = {}",
                  modulus_kPa, modulus_kPa);
  recipe.physics = physics;
  recipe.world =
      "[[tool]]\nname = \"tip\"\nshape = \"point\"\ndevice = \"hand\"\nradius_mm = 6\nforce_model = "
      "\"direct\"\ncontact = \"nodes\"\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
  World world(scene_of(recipe));
  Held held;
  double work = 0, least = 1e9, most = 0;
  while (world.t() < 3) {
    std::optional<ToolState> hand = steady_hand({0, 0, 0});
    const double depth = 0.002 * std::min(1.0, world.t() / 0.1);
    hand->tick = static_cast<std::uint64_t>(1000 * world.t()) + 1;
    hand->p_WT = {0.0005, 0.0005, slab_top - depth};
    world.frame(std::span(&hand, 1));
    held.force = total(forces_of_tool(world)).norm();
    if (world.t() < 2) work = world.report().tool_work;
    if (world.t() > 2) least = std::min(least, held.force), most = std::max(most, held.force);
  }
  held.work = world.report().tool_work - work;
  held.wobble = most - least;
  return held;
}

// A tip that dives and stays presses as in explicit steps, and does no work any more.
TEST(ImplicitContact, AHeldTipRestsAndDoesNoWork) {
  for (const double modulus_kPa : {20.0, 3.0}) {
    const Held exact = held_tip("", modulus_kPa);
    for (const double frame_Hz : {1000.0, 200.0, 50.0}) {
      const Held held =
          held_tip(fmt::format("integrator = \"backward_euler\"\nframe_Hz = {}", frame_Hz), modulus_kPa);
      EXPECT_NEAR(held.force, exact.force, 0.01 * exact.force) << frame_Hz;
      EXPECT_LT(std::abs(held.work), 2e-3 * exact.force * 0.002) << frame_Hz;
      EXPECT_LT(held.wobble, 5e-3 * exact.force) << frame_Hz;
    }
  }
}

}  // namespace
}  // namespace palpate::physics::test
