// The stable step of tetrahedra: just below it holds, above it does not, and the bound of single elements is one.

#include "physics_node/step/fem/tet_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/kinds.h"
#include "physics_node/material/lame.h"
#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

using test::model_of;
using test::TetCube;

/// How many times as much energy there is after some steps of a body that moves a little at random.
double growth(const TetModel& model, double dt) {
  Tetrahedra<double> body(model);
  test::stir(body, 0, 1e-6);
  double start = 0, most = 0;
  for (int n = 0; n < 1500; ++n) {
    body.step({.dt = dt, .watch = true});
    const double energy = body.watch().kinetic + body.watch().elastic;
    if (n == 0) start = energy;
    most = std::max(most, energy);
  }
  return most / start;
}

class Steps : public testing::TestWithParam<std::tuple<int, bool, double>> {
 protected:
  TetModel model = model_of({.nodal = std::get<0>(GetParam()) == 1,
                             .jitter = 0.12,
                             .beta = std::get<2>(GetParam()),
                             .held = true,
                             .two_materials = std::get<1>(GetParam()),
                             .second_order = std::get<0>(GetParam()) == 2});
};

TEST_P(Steps, HoldJustBelowTheBoundAndNotWellAbove) {
  const double dt = stable_step(stiffest_mode_of_tetrahedra(model), Integrator::symplectic_euler);
  EXPECT_LT(growth(model, 0.98 * dt), 60) << "near its bound a vibration swings wide and stays";
  EXPECT_GT(growth(model, 1.05 * dt), 1e6);
}

TEST_P(Steps, AreBoundByTheFastestElement) {
  const double found = stiffest_mode_of_tetrahedra(model).omega2, bound = fastest_element(model);
  EXPECT_LE(found, bound);
  EXPECT_GT(found, 0.05 * bound) << "it is of use";
}

// 0: plain, 1: with nodal pressure, 2: of second order
INSTANTIATE_TEST_SUITE_P(Bodies, Steps,
                         testing::Combine(testing::Values(0, 1, 2), testing::Bool(),
                                          testing::Values(0, 1e-4)));

/// An average of volumes is softer than each of them, and so the step is longer.
TEST(StableStep, IsLongerWithNodalPressure) {
  const double nodal = stiffest_mode_of_tetrahedra(model_of({.cells = {8, 8, 8}, .jitter = 0})).omega2;
  const double plain =
      stiffest_mode_of_tetrahedra(model_of({.cells = {8, 8, 8}, .nodal = false, .jitter = 0})).omega2;
  EXPECT_LT(nodal, 0.8 * plain);
  EXPECT_GT(plain, 0.4 * fastest_element(model_of({.cells = {8, 8, 8}, .nodal = false, .jitter = 0})));
}

TEST(StableStep, OfABodyThatIsHeldEverywhereIsInfinite) {
  TetModel model = model_of({.cells = {2, 2, 2}});
  model.held.assign(model.mesh.nodes.size(), true);
  EXPECT_TRUE(std::isinf(stable_step(stiffest_mode_of_tetrahedra(model), Integrator::symplectic_euler)));
}

}  // namespace
}  // namespace palpate::physics
