#pragma once
// The slab of pressed_world.h, of finite elements, that a hand's recorded motion presses.

#include <string>

#include "tests/support/physics/pressed_world.h"

namespace palpate::physics::test {

inline Recipe palpated_slab(double frame_Hz, const std::string& model = "fem") {
  Recipe recipe = pressed_slab_recipe();
  recipe.body += "\nmodel = \"" + model + "\"";
  recipe.physics = "frame_Hz = " + std::to_string(frame_Hz);
  const std::string planes = "\"norton\"";
  recipe.world.replace(recipe.world.find(planes), planes.size(), "\"tissue\"");
  return recipe;
}

/// By a tool of these keys, with force_model = "tissue".
inline Recipe palpated_by(const std::string& keys) {
  Recipe recipe = palpated_slab(1000);
  recipe.world = "[[tool]]\nname = \"tip\"\ndevice = \"hand\"\nforce_model = \"tissue\"\n" + keys +
                 "\n[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
  return recipe;
}

}  // namespace palpate::physics::test
