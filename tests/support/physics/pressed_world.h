#pragma once
// A soft slab on a table, and a hand that presses its middle with a steady force.

#include <optional>
#include <span>

#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {

inline constexpr double slab_top = 0.010;  // [m]

inline Recipe pressed_slab_recipe() {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(48, 48, 20);
  recipe.spacing_mm = 4;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20\nviscosity_Pa_s = 10";
  recipe.body = "fixed = [\"-z\"]";
  recipe.world = point_tool(4);
  return recipe;
}
inline Scene pressed_slab() { return scene_of(pressed_slab_recipe()); }

/// A hand that feels `force` with its proxy on the middle of the slab.
inline std::optional<ToolState> steady_hand(const Array3& force) {
  ToolState state;
  state.tick = 9;
  state.p_WT = {0.0005, 0.0005, slab_top - 0.002};
  state.proxy = {0.0005, 0.0005, slab_top};
  state.force_on_hand = force;
  state.engaged = 1;
  return state;
}

inline void run(World& world, const std::optional<ToolState>& hand, int frames) {
  for (int n = 0; n < frames; ++n) world.frame(std::span(&hand, 1));
}

/// What the point presses with.
inline std::span<const NodalForce> forces_of_tool(const World& world, std::size_t n = 0) {
  return dynamic_cast<const PressingTool&>(world.tool(n)).forces();
}

inline Vec3 total(std::span<const NodalForce> forces) {
  Vec3 sum = Vec3::Zero();
  for (const NodalForce& nodal : forces) sum += nodal.force;
  return sum;
}

}  // namespace palpate::physics::test
