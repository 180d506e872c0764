// The bound of a step against closed forms: two masses on a spring, the endless face-centred lattice, and the eigenvalues of
// the step itself.

#include "physics_node/step/lattice/stable_step.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "physics_node/step/lattice/lattice_spectrum.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

/// Largest magnitude of an eigenvalue of one step of  v += dt (-omega^2 x - gamma v),  x += dt v.
double growth(const StiffestMode& mode, double dt) {
  Eigen::Matrix2d step;  // of (x, v)
  const double kept = 1 - dt * mode.gamma, pulled = -dt * mode.omega2;
  step << 1 + dt * pulled, dt * kept, pulled, kept;
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(StableStep, IsWhereTheStepItselfBeginsToGrow) {
  for (const StiffestMode mode :
       {StiffestMode{1e6, 0}, StiffestMode{1e6, 50}, StiffestMode{1e6, 3000}, StiffestMode{4, 100}}) {
    const double bound = stable_step(mode, Integrator::symplectic_euler);
    EXPECT_LE(growth(mode, bound * (1 - 1e-6)), 1 + 1e-12) << mode.gamma;
    EXPECT_GT(growth(mode, bound * (1 + 1e-6)), 1 + 1e-9) << mode.gamma;
  }
}

TEST(StableStep, IsTwoOverOmegaWithoutDampers) {
  const StiffestMode mode{2.5e5, 0};
  EXPECT_DOUBLE_EQ(stable_step(mode, Integrator::symplectic_euler), 2 / 500.0);
  EXPECT_DOUBLE_EQ(stable_step(mode, Integrator::velocity_verlet), 2 / 500.0);
}

/// A damper that sees a predicted velocity bounds the step as one of twice its rate would.
TEST(StableStep, IsThatOfTwiceTheDampingWithVerlet) {
  EXPECT_DOUBLE_EQ(stable_step({1e6, 400}, Integrator::velocity_verlet),
                   stable_step({1e6, 800}, Integrator::symplectic_euler));
}

TEST(StableStep, HasNoBoundWhereNothingCanMoveOrTheStepIsImplicit) {
  EXPECT_TRUE(std::isinf(stable_step({0, 0}, Integrator::symplectic_euler)));
  EXPECT_TRUE(std::isinf(stable_step({1e6, 10}, Integrator::backward_euler)));
}

/// Two masses m on a spring k swing against each other with omega^2 = 2 k / m.
TEST(StiffestMode, OfTwoMassesOnASpring) {
  const Body body = test::body_of(test::pair_of_masses("mass_g = 4\nk1_N_per_m = 100"));
  EXPECT_NEAR(stiffest_mode(body).omega2, 2 * 100 / 4e-3, 1e-6);
  EXPECT_NEAR(stiffest_mode_anyhow(body).omega2, 2 * 100 / 4e-3, 1e-6);
}

/// Nearest neighbours on the face-centred lattice: m omega^2 = 8 k, for the longitudinal wave at the point X of the zone.
/// Source: Ashcroft & Mermin 1976, chapter 22.
TEST(StiffestMode, OfTheFaceCentredLatticeIsEightTimesItsSpring) {
  const Body body = test::body_of({});
  std::array<double, max_half> k{};
  k.fill(200);
  EXPECT_NEAR(largest_eigenvalue(body.lattice, k), 8 * 200, 1e-9 * 1600);
  k.fill(50);
  EXPECT_NEAR(largest_eigenvalue(body.lattice, k), 8 * 50, 1e-9 * 400);
  EXPECT_NEAR(stiffest_mode(body).omega2, 8 * 200 / 1e-3, 1e-3);
}

/// However it is folded: twelve elements at a mass inside, 2 * 12 k / m.
TEST(StiffestMode, HoweverFoldedIsTwiceTheSumOfSprings) {
  const Body body = test::body_of({});
  EXPECT_NEAR(stiffest_mode_anyhow(body).omega2, 24 * 200 / 1e-3, 1e-3);
}

}  // namespace
}  // namespace palpate::physics
