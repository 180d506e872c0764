#pragma once
// A box of finite elements, and time for it.

#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {

/// A box of cells, 10 kPa, nu 0.45.
inline Recipe solid_box(double x_mm, double y_mm, double z_mm, double spacing_mm) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(x_mm, y_mm, z_mm);
  recipe.spacing_mm = spacing_mm;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.body = "model = \"fem\"";
  return recipe;
}

inline void run(World& world, double seconds) {
  for (const double end = world.t() + seconds; world.t() < end - 1e-9;) world.frame({});
}

}  // namespace palpate::physics::test
