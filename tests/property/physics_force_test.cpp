// The force of the elements is that of their energy, in both precisions.
#include <gtest/gtest.h>

#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/lattice/measure.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// Force on a mass at rest: its velocity after a step of one second, times its mass.
template <class Real>
std::vector<Vec3> forces_at_rest(const Body& body, LatticeState<Real>& state) {
  for (const Index cell : body.lattice.masses) write(state.v, cell, Vec3::Zero());
  const auto u = std::vector<Vec3>([&] {
    std::vector<Vec3> all;
    for (const Index cell : body.lattice.masses) all.push_back(read(state.u, cell));
    return all;
  }());
  element_step(body, state, {.dt = 1.0});
  std::vector<Vec3> forces;
  std::size_t n = 0;
  for (const Index cell : body.lattice.masses) {
    forces.push_back(body.law.mass * read(state.v, cell));
    write(state.u, cell, u[n++]);
  }
  return forces;
}

/// Compares forces with - dE/dx by central differences at every seventh mass.
void expect_force_is_gradient(const Body& body, LatticeState<double>& state) {
  const auto forces = forces_at_rest(body, state);
  for (const Index cell : body.lattice.masses) write(state.v, cell, Vec3::Zero());
  const double h = 1e-5 * body.lattice.rest_length[0];
  double largest = 0;
  for (std::size_t n = 0; n < forces.size(); n += 7) {
    const Index cell = body.lattice.masses[n];
    const Vec3 u = read(state.u, cell);
    for (int a = 0; a < 3; ++a) {
      const auto energy = [&](double by) {
        write(state.u, cell, u + by * Vec3::Unit(a));
        return measure_energies(body, state, Vec3::Zero()).elastic;
      };
      const double gradient = (energy(h) - energy(-h)) / (2 * h);
      write(state.u, cell, u);
      largest = std::max(largest, std::abs(forces[n][a]));
      EXPECT_NEAR(forces[n][a], -gradient, 1e-6 * body.law.k1[0] * body.lattice.rest_length[0]);
    }
  }
  EXPECT_GT(largest, 1e-3 * body.law.k1[0] * body.lattice.rest_length[0]);
}

class Force : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(BothLattices, Force, testing::Values("fcc", "voxel"));

TEST_P(Force, IsTheGradientOfTheElasticEnergy) {
  Recipe recipe;
  recipe.lattice = GetParam();
  const Body body = body_of(recipe);
  LatticeState<double> state(body);
  Dice dice(4);
  place_masses<double>(body, state, [&](const Vec3& p) { return Vec3(p + dice.within(0.0005)); });
  expect_force_is_gradient(body, state);
}

TEST_P(Force, IsTheGradientOfTheElasticEnergyAfterYield) {
  Recipe recipe;
  recipe.lattice = GetParam();
  recipe.material += "\nk2_ratio = 0.2\nyield_ratio = 1.02\nbreak_ratio = 2";
  const Body body = body_of(recipe);
  LatticeState<double> state(body);
  place_masses<double>(body, state, [](const Vec3& p) { return Vec3(1.1 * p); });
  EXPECT_EQ(element_step(body, state, {.dt = 0}), 0);  // commits the yield
  Dice dice(5);
  place_masses<double>(body, state, [&](const Vec3& p) { return Vec3(1.05 * p + dice.within(0.0001)); });
  expect_force_is_gradient(body, state);
}

TEST(Force, OfAStretchOfOnePartInAMillionIsExactInSinglePrecision) {
  const Body body = body_of(pair_of_masses("mass_g = 1000\nk1_N_per_m = 1000"));
  ASSERT_EQ(body.lattice.n_masses(), 2);
  for (const double strain : {1e-6, -1e-6, 1e-4}) {
    LatticeState<float> state(body);
    const Vec3 D = body.lattice.rest_position(body.lattice.masses[1]) -
                   body.lattice.rest_position(body.lattice.masses[0]);
    write(state.u, body.lattice.masses[1], strain * D);
    const auto forces = forces_at_rest(body, state);
    const Vec3 expected = 1000 * strain * D;  // L = 1 m, so D is its direction too
    EXPECT_LT((forces[0] - expected).norm(), 1e-4 * expected.norm()) << strain;
    EXPECT_LT((forces[1] + expected).norm(), 1e-4 * expected.norm()) << strain;
  }
}

TEST(Force, OfADamperActsAlongTheElementOnly) {
  const Body body = body_of(pair_of_masses("mass_g = 1000\nk1_N_per_m = 1000\nviscosity_N_s_per_m = 7"));
  LatticeState<double> state(body);
  const Vec3 along = Vec3(1, 1, 0).normalized();
  const Vec3 across(0, 0, 1);
  const double dt = 1e-3;
  write(state.v, body.lattice.masses[1], 2 * along + 5 * across);
  element_step(body, state, {.dt = dt});
  // f = c l' on the first mass toward the second, l' = 2 m/s.
  EXPECT_LT((read(state.v, body.lattice.masses[0]) / dt - 14 * along).norm(), 1e-9);
  EXPECT_LT((read(state.v, body.lattice.masses[1]) - (2 - 14 * dt) * along - 5 * across).norm(), 1e-12);
}

}  // namespace
}  // namespace palpate::physics::test
