// Bars and tubes that are no whole number of cells sag as beams of their true section do: border_cells = "filled".

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "common/scene/scene.h"
#include "physics_node/step/multigrid/equilibrium.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

constexpr double length = 0.160, E = 10e3, nu = 0.45, density = 1000, gravity = 1e-3;

/// A round bar or tube along x, held at -x.
struct Pipe {
  double outer, inner;  // radii [m]

  Body body(double spacing, const std::string& border_cells) const {
    test::Recipe recipe;
    recipe.lattice = "voxel";
    recipe.spacing_mm = 1e3 * spacing;
    recipe.shape =
        "shape = \"tube\"\naxis = \"x\"\nlength_mm = 160\nouter_radius_mm = " + std::to_string(1e3 * outer) +
        "\ninner_radius_mm = " + std::to_string(1e3 * inner);
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
    recipe.body = "model = \"fem\"\nfixed = [\"-x\"]\nborder_cells = \"" + border_cells + "\"";
    return test::body_of(recipe);
  }

  /// How far it sags at x from the clamp (Timoshenko; shear of a thick tube after Cowper 1966) [m].
  double sag(double x) const {
    const double A = std::numbers::pi * (outer * outer - inner * inner),
                 I = std::numbers::pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4)),
                 m2 = std::pow(inner / outer, 2), G = E / (2 * (1 + nu)), load = density * gravity * A,
                 kappa = 6 * (1 + nu) * std::pow(1 + m2, 2) /
                         ((7 + 6 * nu) * std::pow(1 + m2, 2) + (20 + 12 * nu) * m2);
    return load / (24 * E * I) * x * x * (6 * length * length - 4 * length * x + x * x) +
           load / (kappa * G * A) * (length * x - x * x / 2);
  }

  /// Curvature of the cells in the middle third over that of the beam: free of what the clamp does to its surroundings.
  double over_curvature(double spacing, const std::string& border_cells) const {
    const Body made = body(spacing, border_cells);
    const Equilibrium found = equilibrium(made, {0, 0, -gravity});
    std::array<double, 3> sum{}, count{}, beam{};
    for (std::size_t s = 0; s < 3; ++s) {
      const double x = 0.04 * static_cast<double>(s + 1);
      beam[s] = sag(x);
      for (std::size_t n = 0; n < made.nodes().size(); ++n) {
        if (std::abs(made.rest_position(made.nodes()[n]).x() + 0.5 * length - x) > 1e-6) continue;
        sum[s] -= node_mass(made, made.nodes()[n]) * found.displacement[n].z();
        count[s] += node_mass(made, made.nodes()[n]);
      }
    }
    return (sum[0] / count[0] - 2 * sum[1] / count[1] + sum[2] / count[2]) /
           (beam[0] - 2 * beam[1] + beam[2]);
  }
};

TEST(FilledBorderCells, BendAsTheShapeDoes) {
  for (const Pipe& pipe : {Pipe{0.0093, 0}, Pipe{0.0107, 0}, Pipe{0.0107, 0.0061}}) {
    const double filled = pipe.over_curvature(0.0025, "filled"), whole = pipe.over_curvature(0.0025, "whole"),
                 finer = pipe.over_curvature(0.00125, "filled");
    std::printf(
        "radii %.1f and %.1f mm: filled %.4f, whole %.4f; of cells half as long filled %.4f, whole %.4f\n",
        1e3 * pipe.inner, 1e3 * pipe.outer, filled, whole, finer, pipe.over_curvature(0.00125, "whole"));
    EXPECT_NEAR(filled, 1, 0.06);
    EXPECT_NEAR(finer, 1, 0.02);
  }
}

/// What is not seen does not stand on the floor: the seen cells do.
TEST(FilledBorderCells, RestOnTheFloorWithWhatIsSeen) {
  test::Recipe recipe;
  recipe.lattice = "voxel";
  recipe.spacing_mm = 2.5;
  recipe.shape = test::Recipe::sphere(8.8);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20\nviscosity_Pa_s = 20";
  recipe.body = "model = \"fem\"\nborder_cells = \"filled\"";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world = test::floor_at(-7.7);
  World world(test::scene_of(recipe));
  for (int n = 0; n < 2000; ++n) world.frame({});
  const Body& body = world.body(0).body();
  double seen = 1, beyond = 1;
  for (const Index node : body.nodes())
    (body.lattice.is_beyond(node) ? beyond : seen) =
        std::min(body.lattice.is_beyond(node) ? beyond : seen, world.body(0).position(node).z());
  EXPECT_NEAR(seen, -0.0077, 2e-4);
  EXPECT_LT(beyond, -0.0095);
  EXPECT_LT(world.ledger().balance_error(), 0.02);
}

}  // namespace
}  // namespace palpate::physics
