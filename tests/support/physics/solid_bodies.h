#pragma once
// Bodies of finite elements of any shape: a box, from which cells are taken away.

#include <functional>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {

/// A block of n x n x n cells of 2.5 mm, 100 kPa, whose bottom is held.
struct SolidBlock {
  int cells = 16;
  double poisson_ratio = 0.45;
  std::string held = "fixed = [\"-z\"]";
  std::string hourglass = "physical";
};

/// @param stiffness  modulus of a cell over the body's, by its place; 0: no cell there. Empty: 1 everywhere
inline Body solid_block(const SolidBlock& block, const std::function<double(int, int, int)>& stiffness = {}) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.spacing_mm = 2.5;
  recipe.shape = Recipe::box(2.5 * block.cells, 2.5 * block.cells, 2.5 * block.cells);
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 100\npoisson_ratio = " + std::to_string(block.poisson_ratio);
  recipe.body = "model = \"fem\"\nhourglass = \"" + block.hourglass + "\"\n" + block.held;
  Body body = body_of(recipe);
  if (!stiffness) return body;
  Eigen::Vector3i lowest = Eigen::Vector3i::Constant(1 << 30);
  for (const Index node : body.nodes()) lowest = lowest.cwiseMin(body.lattice.grid_of(node));
  std::fill(body.solid->mass.begin(), body.solid->mass.end(), 0.0);
  for (const Index node : body.nodes()) {
    float& own = body.solid->stiffness[static_cast<std::size_t>(node)];
    if (own <= 0) continue;
    const Eigen::Vector3i at = body.lattice.grid_of(node), place = at - lowest;
    own = static_cast<float>(stiffness(place.x(), place.y(), place.z()));
    if (own <= 0) continue;
    for (int a = 0; a < 8; ++a)
      body.solid->mass[static_cast<std::size_t>(
          body.lattice.cell_of(at + Eigen::Vector3i(a & 1, a >> 1 & 1, a >> 2)))] +=
          body.solid->density * body.lattice.step.prod() / 8;
  }
  return body;
}

/// Three ellipsoids that run into each other, one of them thin: in the unit cube.
inline double in_blob(const Vec3& x) {
  const auto in = [&](const Vec3& centre, const Vec3& radii) {
    return (x - centre).cwiseQuotient(radii).norm() < 1;
  };
  return in({0.35, 0.5, 0.45}, {0.33, 0.4, 0.44}) || in({0.65, 0.45, 0.3}, {0.34, 0.3, 0.2}) ||
                 in({0.8, 0.6, 0.22}, {0.18, 0.15, 0.1})
             ? 1
             : 0;
}

}  // namespace palpate::physics::test
