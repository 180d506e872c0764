// What an undamped body of finite elements keeps: the energy that leapfrog itself keeps, to a higher order than the books do.
//
// The ledger's H = sum m v(-) . v(+) / 2 + V is kept exactly where forces are linear. Where they are not, energy goes from slow vibrations
// to fast ones, and what leapfrog keeps (its modified Hamiltonian, to the next order in the step) is
//
//   H' = H + dt^2 / 12 (a . M a + v . K v),   v . K v dt = - v(+) . M (a' - a)
//
// so H moves by dt^2 / 12 times what the second sum does. If forces were not the exact gradient of V, H' would drift.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, IX.3; differences in place of K: Skeel & Hardy 2001.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

struct Drifts {
  double ledger = 0, shadow = 0;  // last tenth less first, over the energy at the start
  double steps = 0;
};

/// A block of 20 mm, held below, its top dented by 0.3 mm and let go; a frame is a step.
/// @param dt  [s]
Drifts ring(double dt, double seconds) {
  Recipe recipe = solid_box(20, 20, 20, 2.5);
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.physics =
      "sleep = false\nstep_ms = " + std::to_string(1e3 * dt) + "\nframe_Hz = " + std::to_string(1 / dt);
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  const std::span<const Index> nodes = body.body().nodes();
  double bottom = HUGE_VAL;
  for (const Index node : nodes) bottom = std::min(bottom, body.body().rest_position(node).z());
  for (const Index node : nodes) {
    const Vec3 x = body.body().rest_position(node);
    const double height = (x.z() - bottom) / 0.02, r2 = x.head<2>().squaredNorm() / 25e-6;
    body.place(node, Vec3(0, 0, -0.3e-3 * height * height * std::exp(-r2)), Vec3::Zero());
  }
  world.restart_ledger();
  std::vector<double> mass;
  for (const Index node : nodes)
    mass.push_back(body.body().inverse_mass[static_cast<std::size_t>(node)] > 0 ? node_mass(body.body(), node)
                                                                                : 0);
  const auto n_steps = static_cast<int>(seconds / dt);
  std::vector<Vec3> v_before(nodes.size(), Vec3::Zero()), a_before(nodes.size(), Vec3::Zero());
  std::vector<double> ledger, shadow;
  double H = 0, aMa = 0, vKv = 0;  // of the step before
  for (int n = 0; n < n_steps; ++n) {
    world.frame({});
    double twice_kinetic = 0, next_aMa = 0, next_vKv = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec3 v = body.velocity(nodes[k]), a = (v - v_before[k]) / dt;
      twice_kinetic += mass[k] * v_before[k].dot(v);
      next_aMa += mass[k] * a.squaredNorm();
      next_vKv -= mass[k] * v_before[k].dot(a - a_before[k]) / dt;
      v_before[k] = v, a_before[k] = a;
    }
    if (n > 1) {
      ledger.push_back(H);
      shadow.push_back(H + dt * dt / 12 * (aMa + 0.5 * (vKv + next_vKv)));
    }
    H = 0.5 * twice_kinetic + body.watch().elastic;
    aMa = next_aMa, vKv = next_vKv;
  }
  const auto drift = [](const std::vector<double>& of) {
    const auto tenth = static_cast<std::ptrdiff_t>(of.size() / 10);
    double first = 0, last = 0;
    for (std::ptrdiff_t n = 0; n < tenth; ++n) {
      first += of[static_cast<std::size_t>(n)];
      last += of[of.size() - 1 - static_cast<std::size_t>(n)];
    }
    return (last - first) / (static_cast<double>(tenth) * of[0]);
  };
  return {drift(ledger), drift(shadow), static_cast<double>(world.report().steps)};
}

TEST(ShadowEnergy, DriftsByAFewTenThousandthsInTenSecondsAtTheStepThatABodyTakesByItself) {
  const Drifts drifts = ring(0.25e-3, 10);
  EXPECT_EQ(drifts.steps, 40000);
  EXPECT_LT(std::abs(drifts.shadow), 5e-4);
  EXPECT_LT(std::abs(drifts.ledger), 5e-3);
}

// What is left of it is of the fourth power of the step: of the step's own order nothing, so forces are the gradient of what is booked.
TEST(ShadowEnergy, FallsByTheFourthPowerOfTheStepAndLeavesTheLedgerBehind) {
  const Drifts coarse = ring(0.125e-3, 3), fine = ring(0.0625e-3, 3);
  EXPECT_LT(std::abs(coarse.shadow), 1e-4);
  EXPECT_LT(std::abs(fine.shadow), 1e-5);
  EXPECT_GT(std::abs(coarse.ledger), 10 * std::abs(coarse.shadow));
  RecordProperty("coarse", std::to_string(coarse.shadow * 1e6) + " " + std::to_string(coarse.ledger * 1e6));
  RecordProperty("fine", std::to_string(fine.shadow * 1e6) + " " + std::to_string(fine.ledger * 1e6));
}

}  // namespace
}  // namespace palpate::physics::test
