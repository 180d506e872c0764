// The engine against what is known exactly: closed forms of one element, and the lattice's own answers.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/problems/problems.h"

namespace palpate::bench {
namespace {

Settings settings(Integrator integrator, double step) { return {integrator, Precision::double_, step, 1}; }

TEST(ClosedForms, BilinearLoopIsExactAtAnySpeedAndStepCount) {
  for (const double speed : {1e-3, 1.0, 100.0})
    for (const int steps : {1, 10, 1000})
      EXPECT_LT(bilinear_loop_error(speed, steps), 1e-12) << speed << " m/s, " << steps << " steps";
}

TEST(ClosedForms, ChainVibratesAtItsOwnFrequency) {
  // Symplectic Euler and Verlet share sin(w' dt / 2) = w dt / 2: the error is (w dt)^2 / 24.
  for (const int mode : {1, 5, 11}) {
    const double w = 2 * std::sqrt(1000.0) * std::sin(mode * M_PI / 24);
    EXPECT_LT(chain_wave(settings(Integrator::symplectic_euler, 3e-3 / w), 12, mode).error, 1e-6) << mode;
    EXPECT_LT(chain_wave(settings(Integrator::velocity_verlet, 3e-3 / w), 12, mode).error, 1e-6) << mode;
  }
}

TEST(ClosedForms, BarHangsWhereItsLatticeIsInEquilibrium) {
  for (const LatticeKind lattice : {LatticeKind::fcc, LatticeKind::voxel})
    EXPECT_LT(bar_stretch(settings(Integrator::symplectic_euler, 4e-6), lattice).error, 1e-8);
}

TEST(ClosedForms, TwentyCellsHaveTheModulusAskedFor) {
  for (const LatticeKind lattice : {LatticeKind::fcc, LatticeKind::voxel}) {
    const Modulus coarse = bar_modulus(lattice, 10), fine = bar_modulus(lattice, 20);
    EXPECT_NEAR(fine.inside, 1, 0.01);
    // As a whole the bar comes to it with the first power of the spacing.
    EXPECT_NEAR(std::log2((coarse.outside - 1) / (fine.outside - 1)), 1, 0.25);
    RecordProperty(lattice == LatticeKind::fcc ? "fcc" : "voxel", std::to_string(fine.inside));
  }
}

TEST(ClosedForms, FreeFlightKeepsMomentumAndAngularMomentum) {
  for (const LatticeKind lattice : {LatticeKind::fcc, LatticeKind::voxel}) {
    const Drift drift = free_flight(settings(Integrator::symplectic_euler, 2e-4), lattice, 100000);
    EXPECT_EQ(drift.outcome.steps, 100000);
    EXPECT_LT(drift.linear, 1e-12);
    EXPECT_LT(drift.angular, 1e-12);
  }
}

/// What about twice as many small steps bring.
double order(Outcome (*problem)(const Settings&), Integrator integrator, double step) {
  const Outcome few = problem(settings(integrator, step)), many = problem(settings(integrator, step / 2));
  return std::log(few.error / many.error) /
         std::log(static_cast<double>(many.steps) / static_cast<double>(few.steps));
}

TEST(ClosedForms, IntegratorsHaveTheirOrders) {
  EXPECT_NEAR(order(oscillation, Integrator::symplectic_euler, 1e-3), 1, 0.1);
  EXPECT_NEAR(order(oscillation, Integrator::velocity_verlet, 1e-3), 2, 0.1);
  EXPECT_NEAR(order(oscillation, Integrator::backward_euler, 1e-5), 1, 0.1);
  EXPECT_NEAR(order(creep, Integrator::symplectic_euler, 1e-4), 1, 0.1);
  EXPECT_NEAR(order(creep, Integrator::velocity_verlet, 1e-4), 2, 0.1);
  EXPECT_NEAR(order(creep, Integrator::backward_euler, 1e-4), 1, 0.1);
}

}  // namespace
}  // namespace palpate::bench
