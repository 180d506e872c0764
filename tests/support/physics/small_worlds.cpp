#include "tests/support/physics/small_worlds.h"

#include <fmt/format.h>

#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"

namespace palpate::physics::test {

std::string Recipe::box(double x_mm, double y_mm, double z_mm) {
  return fmt::format("shape = \"box\"\nsize_mm = [{}, {}, {}]", x_mm, y_mm, z_mm);
}

std::string Recipe::sphere(double radius_mm) {
  return fmt::format("shape = \"sphere\"\nradius_mm = {}", radius_mm);
}

Scene scene_of(const Recipe& recipe) {
  const std::string lattice = recipe.lattice.empty() ? ""
                                                     : fmt::format("lattice = \"{}\"\nspacing_mm = {}\n",
                                                                   recipe.lattice, recipe.spacing_mm);
  const std::string text = fmt::format(
      "title = \"test\"\ngravity_m_per_s2 = {}\n[physics]\nprecision = \"{}\"\n{}\n[material.m]\n{}\n"
      "[[body]]\nname = \"body\"\n{}material = \"m\"\n{}\n{}\n{}\n",
      recipe.gravity, recipe.precision, recipe.physics, recipe.material, lattice, recipe.shape, recipe.body,
      recipe.world);
  return parse_scene(text, "test.toml");
}

Body body_of(const Recipe& recipe) {
  const Scene scene = scene_of(recipe);
  return build_body(scene.bodies.front(), scene.materials);
}

Recipe pair_of_masses(const std::string& material) {
  Recipe recipe;
  recipe.shape = Recipe::box(720, 720, 100);  // a face diagonal of the cubic lattice, one layer thick
  recipe.spacing_mm = 1000;
  recipe.material = material;
  return recipe;
}

std::string floor_at(double height_mm) { return fmt::format("[floor]\nheight_mm = {}\n", height_mm); }

std::string point_tool(double radius_mm) {
  return fmt::format(
      "[[tool]]\nname = \"tip\"\nshape = \"point\"\nforce_model = \"norton\"\ndevice = \"hand\"\nradius_mm = "
      "{}\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n",
      radius_mm);
}

}  // namespace palpate::physics::test
