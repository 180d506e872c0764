// How large a step may be, and what the lattice is as a solid.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/scene/material_spec.h"
#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/lattice/measure.h"
#include "physics_node/step/lattice/stable_step.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// Of symplectic Euler [s].
double step_bound(const Body& body) { return stable_step(stiffest_mode(body), Integrator::symplectic_euler); }

/// Square root of a box's energy after many steps of `fraction` of the bound, over that at the start; infinite: it blew up.
double growth(const Recipe& recipe, double fraction, int steps) {
  const Body body = body_of(recipe);
  LatticeState<double> state(body);
  shake(body, state, 1e-4, 10);
  const auto energy = [&] {
    const Energies e = measure_energies(body, state, Vec3::Zero());
    return e.kinetic + e.elastic;
  };
  const double first = energy();
  const double dt = fraction * step_bound(body);
  for (int n = 0; n < steps; ++n) {
    element_step(body, state, {.dt = dt});
    if (n % 100 == 0 && !(energy() < 1e6 * first)) return std::numeric_limits<double>::infinity();
  }
  return std::sqrt(energy() / first);
}

class StableStep : public testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  static Recipe recipe() {
    Recipe recipe;
    recipe.lattice = GetParam().first;
    recipe.material += GetParam().second;
    return recipe;
  }
};

TEST_P(StableStep, StaysBoundedJustBelowTheBound) { EXPECT_LT(growth(recipe(), 0.99, 10000), 2.0); }

TEST_P(StableStep, BlowsUpWellAboveTheBound) {
  EXPECT_EQ(growth(recipe(), 2.6, 10000), std::numeric_limits<double>::infinity());
}

TEST_P(StableStep, IsWithinAFactorOfTheTruth) {
  double lo = 0.99;
  double hi = 2.8;
  while (hi - lo > 0.01) {
    const double mid = 0.5 * (lo + hi);
    (growth(recipe(), mid, 2000) < 100 ? lo : hi) = mid;
  }
  RecordProperty("true_over_bound", std::to_string(lo));
  EXPECT_LT(lo, 1.12);
}

INSTANTIATE_TEST_SUITE_P(BothLattices, StableStep,
                         testing::Values(std::pair{"fcc", ""},
                                         std::pair{"fcc", "\nviscosity_N_s_per_m = 0.05"},
                                         std::pair{"voxel", ""},
                                         std::pair{"voxel", "\nviscosity_N_s_per_m = 0.05"}));

TEST(StableStep, OfAPairOfMassesIsExact) {
  // omega^2 = 2 k / m: the bound is 2 / omega.
  const Body body = body_of(pair_of_masses("mass_g = 1000\nk1_N_per_m = 50"));
  EXPECT_NEAR(step_bound(body), 2 / std::sqrt(100.0), 1e-12);
  const Body damped = body_of(pair_of_masses("mass_g = 1000\nk1_N_per_m = 50\nviscosity_N_s_per_m = 30"));
  EXPECT_NEAR(step_bound(damped), (std::sqrt(3600.0 + 400.0) - 60) / 100, 1e-12);
}

TEST(StableStep, IsInfiniteWhereNothingMoves) {
  Recipe recipe;
  recipe.body = "fixed = [{ min_mm = [-100, -100, -100], max_mm = [100, 100, 100] }]";
  EXPECT_TRUE(std::isinf(step_bound(body_of(recipe))));
}

TEST(Modulus, OfTheFccLatticeIsThatOfTheTextbook) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 1";
  const Body body = body_of(recipe);
  const double L = 0.010;
  const auto C = homogenised_stiffness(body.lattice, body.law.k1);
  const double C11 = std::numbers::sqrt2 / L;
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(C(a, a) / C11, 1, 1e-12);
    EXPECT_NEAR(C(a, (a + 1) % 3) / C11, 0.5, 1e-12);
    EXPECT_NEAR(C(a + 3, a + 3) / C11, 0.5, 1e-12);
  }
  EXPECT_NEAR(axial_modulus(C) * L, 2 * std::numbers::sqrt2 / 3, 1e-12);
  EXPECT_NEAR(volume_per_mass(body.lattice), L * L * L / std::numbers::sqrt2, 1e-18);
}

TEST(Modulus, OfAMaterialIsThatOfItsElements) {
  const MaterialSpec tissue = [] {
    MaterialSpec spec;
    spec.density = 1060;
    spec.modulus = 23e3;
    spec.viscosity_bulk = 150;
    return spec;
  }();
  for (const auto kind : {LatticeKind::fcc, LatticeKind::voxel}) {
    for (const Vec3& step :
         {Vec3(0.001, 0.001, 0.001), Vec3(0.000957, 0.000957, 0.0015), Vec3(0.002, 0.003, 0.004)}) {
      if (kind == LatticeKind::fcc && step.x() != step.z()) continue;  // an fcc lattice is cubic
      const Lattice lattice = make_lattice(kind, {3, 3, 3}, Vec3::Zero(), step);
      const ElementLaw law = element_law(lattice, tissue);
      EXPECT_NEAR(axial_modulus(homogenised_stiffness(lattice, law.k1)) / 23e3, 1, 1e-12);
      for (int d = 0; d < lattice.n_half; ++d) {
        EXPECT_GT(law.k1[static_cast<std::size_t>(d)], 0);
        EXPECT_NEAR(law.c[static_cast<std::size_t>(d)] / law.k1[static_cast<std::size_t>(d)], 150 / 23e3,
                    1e-12);
      }
    }
  }
}

TEST(Modulus, OfCubicVoxelsIsNearlyIsotropic) {
  const Lattice lattice = make_lattice(LatticeKind::voxel, {3, 3, 3}, Vec3::Zero(), Vec3::Constant(0.001));
  MaterialSpec spec;
  spec.density = 1000;
  spec.modulus = 10e3;
  const auto C = homogenised_stiffness(lattice, element_law(lattice, spec).k1);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(C(a, a) / C(a + 3, a + 3), 3, 1e-12);
    EXPECT_NEAR(C(a, (a + 1) % 3) / C(a + 3, a + 3), 1, 1e-12);
  }
}

}  // namespace
}  // namespace palpate::physics::test
