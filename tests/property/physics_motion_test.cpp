// Laws of free motion: momentum, rigid motion, energy.
#include <gtest/gtest.h>

#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/lattice/measure.h"
#include "physics_node/step/lattice/stable_step.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// Of symplectic Euler [s].
double step_bound(const Body& body) { return stable_step(stiffest_mode(body), Integrator::symplectic_euler); }

const Vec3 weightless = Vec3::Zero();

struct Case {
  const char* lattice;
  const char* damper;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.lattice << " " << c.damper; }

class FreeBody : public testing::TestWithParam<Case> {
 protected:
  Recipe recipe() const {
    Recipe recipe;
    recipe.lattice = GetParam().lattice;
    recipe.material += GetParam().damper;
    return recipe;
  }
};

TEST_P(FreeBody, KeepsItsMomenta) {
  const Body body = body_of(recipe());
  LatticeState<double> state(body);
  shake(body, state, 0.5, 1);
  double size = 0;
  double moment_size = 0;
  for (const Index cell : body.lattice.masses) {
    size += body.law.mass * read(state.v, cell).norm();
    moment_size += body.law.mass * read(state.v, cell).norm() * body.lattice.rest_position(cell).norm();
  }
  const Momenta before = measure_momenta(body, state.u, state.v).momenta;
  const double dt = 0.5 * step_bound(body);
  for (int n = 0; n < 1000; ++n) element_step(body, state, {.dt = dt});
  const Momenta after = measure_momenta(body, state.u, state.v).momenta;
  const double linear = (after.linear - before.linear).norm() / size;
  const double angular = (after.angular - before.angular).norm() / moment_size;
  EXPECT_LT(linear, 1e-12);
  EXPECT_LT(angular, 1e-11);
  RecordProperty("linear", std::to_string(1e15 * linear));
  RecordProperty("angular", std::to_string(1e15 * angular));
}

TEST_P(FreeBody, FeelsNoForceFromRigidMotion) {
  const Body body = body_of(recipe());
  LatticeState<double> state(body);
  const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, -0.5).normalized());
  const Vec3 shift(0.3, -0.2, 0.7);
  place_masses<double>(body, state, [&](const Vec3& p) { return Vec3(turn * p + shift); });
  const Vec3 spin = 3.0 * Vec3(0.2, -1, 0.4).normalized();
  for (const Index cell : body.lattice.masses)
    write(state.v, cell, spin.cross(body.lattice.rest_position(cell) + read(state.u, cell)) + shift);
  LatticeState<double> before(body);
  for (const Index cell : body.lattice.masses) write(before.v, cell, read(state.v, cell));
  const double dt = 1e-3;
  element_step(body, state, {.dt = dt});
  const double scale = body.law.k1[0] * body.lattice.rest_length[0] / body.law.mass;
  for (const Index cell : body.lattice.masses)
    ASSERT_LT((read(state.v, cell) - read(before.v, cell)).norm() / dt, 1e-9 * scale);
}

double total_energy(const Body& body, const LatticeState<double>& state) {
  const Energies e = measure_energies(body, state, weightless);
  return e.kinetic + e.elastic;
}

INSTANTIATE_TEST_SUITE_P(BothLattices, FreeBody,
                         testing::Values(Case{"fcc", ""}, Case{"fcc", "\nviscosity_N_s_per_m = 0.05"},
                                         Case{"voxel", ""}, Case{"voxel", "\nviscosity_N_s_per_m = 0.05"}));

class Vibration : public testing::TestWithParam<const char*> {};

TEST_P(Vibration, OnlyLosesEnergyToADamper) {
  Recipe recipe;
  recipe.lattice = GetParam();
  recipe.material += "\nviscosity_N_s_per_m = 0.05";
  const Body body = body_of(recipe);
  LatticeState<double> state(body);
  shake(body, state, 0.5, 2);
  const double first = total_energy(body, state);
  const double dt = 0.02 * step_bound(body);
  double last = first;
  for (int window = 0; window < 20; ++window) {
    for (int n = 0; n < 100; ++n) element_step(body, state, {.dt = dt});
    const double now = total_energy(body, state);
    EXPECT_LT(now, last) << "after " << (window + 1) * 100 << " steps";
    last = now;
  }
  EXPECT_LT(last, 0.2 * first);
}

TEST_P(Vibration, KeepsItsEnergyInABandWithoutADamper) {
  Recipe recipe;
  recipe.lattice = GetParam();
  const Body body = body_of(recipe);
  LatticeState<double> state(body);
  shake(body, state, 0.5, 3);
  const double first = total_energy(body, state);
  const double dt = 0.15 * step_bound(body);
  double lowest = first;
  double highest = first;
  for (int n = 0; n < 10000; ++n) {
    element_step(body, state, {.dt = dt});
    if (n % 10 != 0) continue;
    lowest = std::min(lowest, total_energy(body, state));
    highest = std::max(highest, total_energy(body, state));
  }
  EXPECT_GT(lowest, 0.95 * first);
  EXPECT_LT(highest, 1.05 * first);
  RecordProperty("band_percent", std::to_string(100 * (highest - lowest) / first));
}

INSTANTIATE_TEST_SUITE_P(BothLattices, Vibration, testing::Values("fcc", "voxel"));

}  // namespace
}  // namespace palpate::physics::test
