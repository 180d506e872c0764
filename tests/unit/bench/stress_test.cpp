// Abuse from a seed is the same abuse every time, and its results survive the way through a file.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <set>

#include "bench/problems/settings.h"
#include "bench/stress/stress_run.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {
namespace {

TEST(Stress, RepeatsASeed) {
  const StressResult first = run_stress(3), again = run_stress(3);
  EXPECT_EQ(first.growth, again.growth);
  EXPECT_EQ(first.steps, again.steps);
  EXPECT_EQ(first.masses, again.masses);
}

TEST(Stress, ComesInAllKinds) {
  std::set<std::string> kinds;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const StressScene stress = random_scene(seed);
    kinds.insert(name_of(stress.scene.physics->integrator));
    kinds.insert(name_of(stress.scene.physics->precision));
    kinds.insert(start_names[static_cast<int>(stress.start)]);
    kinds.insert(stress.scene.bodies[0].lattice == LatticeKind::fcc ? "fcc" : "voxel");
    kinds.insert(stress.tool_force > 0 ? "tool" : "no tool");
    kinds.insert(stress.scene.materials[0].yield_ratio ? "yields" : "elastic");
    const physics::World world(stress.scene);
    EXPECT_GT(world.body(0).body().lattice.n_masses(), 20) << describe(stress);
    EXPECT_LT(world.body(0).body().lattice.n_masses(), 5000) << describe(stress);
  }
  EXPECT_EQ(kinds.size(), 3u + 2u + 5u + 2u + 2u + 2u) << fmt::format("{}", kinds);
}

TEST(Stress, OfElementsComesInAllKindsToo) {
  std::set<std::string> kinds;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const StressScene stress = random_scene(seed, ElementModel::fem);
    const MaterialSpec& material = stress.scene.materials[0];
    kinds.insert(name_of(stress.scene.physics->integrator));
    kinds.insert(material.law == TissueLaw::green ? "green" : "neo-Hookean");
    kinds.insert(material.relaxation.empty() ? "lasting" : "relaxing");
    kinds.insert(material.viscosity_bulk ? "damped" : "undamped");
    kinds.insert(material.break_ratio ? "breaks" : "holds");
    kinds.insert(material.yield_ratio ? "yields" : "elastic");
    kinds.insert(stress.scene.bodies[0].hourglass == HourglassKind::physical ? "physical" : "isotropic");
    const physics::World world(stress.scene);
    for (std::size_t b = 0; b < world.n_bodies(); ++b)
      EXPECT_TRUE(world.body(b).body().solid) << describe(stress);
  }
  EXPECT_EQ(kinds.size(), 2u + 2u + 2u + 2u + 2u + 2u + 2u) << fmt::format("{}", kinds);
}

/// A tool strikes a cell; what that stored shows in no step but the one after, which ends the frame with 30 times the
/// energy put in.
TEST(Stress, WhatABlowStoresInAStepIsSeenInItsFrame) {
  const StressResult result = run_stress(1993, ElementModel::fem);
  EXPECT_TRUE(result.finite);
  EXPECT_LT(result.growth, 2) << "before any frame ended";
  EXPECT_EQ(result.restored, 1);
}

/// Torn tissue whose elements hold little until the step in which they are drawn out by 60 times, 3600 times the energy put in.
TEST(Stress, WhatComesFarInAStepIsSeenInItsFrame) {
  const StressResult result = run_stress(9412, ElementModel::fem);
  EXPECT_TRUE(result.finite);
  EXPECT_LT(result.growth, 10);
}

TEST(Stress, ResultsSurviveTheirFile) {
  const StressResult result = run_stress(5);
  StressResult read;
  ASSERT_TRUE(parse(fmt::format("{}", fmt::join(words(result), ",")), read));
  EXPECT_EQ(words(read), words(result));
  EXPECT_FALSE(parse("5,symplectic_euler,fcc", read)) << "a line that a crash cut short";
}

}  // namespace
}  // namespace palpate::bench
