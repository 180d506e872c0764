#include "physics_node/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "common/error/error.h"
#include "common/scene/scene.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

void run_alone(World& world, int frames) {
  for (int n = 0; n < frames; ++n) world.frame({});
}

TEST(World, SkipsTheStagesThatASceneLacks) {
  Recipe recipe;
  recipe.body = "velocity_m_per_s = [1, 0, 0]";
  World world(scene_of(recipe));
  run_alone(world, 20);
  StepReport& report = world.report();
  const std::int64_t steps = report.steps;
  EXPECT_EQ(report.frames, 20);
  EXPECT_GE(steps, 20);
  for (const Stage stage : {Stage::contact_forces, Stage::yield_and_break, Stage::integrate}) {
    EXPECT_EQ(report[stage].calls, 0) << stage_names[static_cast<std::size_t>(stage)];
    EXPECT_EQ(report[stage].skipped, steps) << stage_names[static_cast<std::size_t>(stage)];
  }
  EXPECT_EQ(report[Stage::take_tools].skipped, 20);
  EXPECT_EQ(report[Stage::find_contacts].skipped, 20);
  EXPECT_EQ(report[Stage::element_forces].calls, steps);
  EXPECT_EQ(report[Stage::guard_finite].calls, 20);
}

TEST(World, DoesTheStagesThatASceneHas) {
  Recipe recipe = pressed_slab_recipe();
  recipe.material += "\nyield_ratio = 1.5\nbreak_ratio = 2";
  recipe.world += floor_at(-50);
  World world(scene_of(recipe));
  run(world, steady_hand({0, 0, 1}), 20);
  StepReport& report = world.report();
  for (const Stage stage : {Stage::take_tools, Stage::find_contacts}) EXPECT_EQ(report[stage].calls, 20);
  for (const Stage stage : {Stage::contact_forces, Stage::yield_and_break})
    EXPECT_EQ(report[stage].calls, report.steps);
}

TEST(World, FallsAsGalileiSays) {
  Recipe recipe;
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  run_alone(world, 100);
  const Index cell = world.body(0).body().lattice.masses.front();
  EXPECT_NEAR(world.t(), 0.1, 1e-12);
  EXPECT_NEAR(world.body(0).velocity(cell).z(), -0.981, 1e-9);
  EXPECT_NEAR(world.body(0).displacement(cell).z(), -0.5 * 9.81 * 0.01, 0.0006);  // first order in the step
}

TEST(World, BouncesOffTheFloorWithoutLoss) {
  Recipe recipe;
  recipe.world = floor_at(-21);
  recipe.body = "velocity_m_per_s = [0, 0, -1]";
  recipe.physics = "safety = 0.02";  // symplectic Euler is of first order
  World world(scene_of(recipe));
  const auto energy = [&] {
    const Energies e = world.body(0).energies(Vec3::Zero());
    return e.kinetic + e.elastic;
  };
  const double first = energy();
  run_alone(world, 300);
  EXPECT_GT(world.body(0).momenta().linear.z(), 0);
  EXPECT_NEAR(energy() / first, 1, 0.05);
}

TEST(World, TakesAStepBelowTheStableOne) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 20000";
  recipe.physics = "safety = 0.5";
  const World world(scene_of(recipe));
  EXPECT_LE(world.step_seconds(), 0.5 * world.stable_step_seconds() * (1 + 1e-9));
  EXPECT_GT(world.step_seconds(), 0.4 * world.stable_step_seconds());
  EXPECT_TRUE(world.remarks().empty());
}

/// Of elements too, whose numbers are nothing anywhere by then: also where storage holds no cell.
TEST(World, RecoversElementsThatWereNotNumbers) {
  for (const char* precision : {"single", "double"}) {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(10, 10, 40);
    recipe.spacing_mm = 2.5;
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45\nviscosity_Pa_s = 1";
    recipe.body = "model = \"fem\"\nfixed = [\"+z\"]";
    recipe.physics = "frame_Hz = 100\nstep_ms = 1";
    recipe.precision = precision;
    recipe.gravity = "[0, 0, -9.81]";
    World world(scene_of(recipe));
    run_alone(world, 50);
    EXPECT_GT(world.report().nonfinite, 0) << precision;
    EXPECT_LE(world.report().halved, 3) << precision;
    EXPECT_GT(world.t(), 0.4) << precision;
    EXPECT_TRUE(world.body(0).is_finite());
  }
}

TEST(World, BringsTheLastGoodStateBackWhenNumbersBlowUp) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 20000";
  recipe.physics = "step_ms = 1";
  recipe.body = "fixed = [\"-z\"]";
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  ASSERT_GT(world.step_seconds(), 5 * world.stable_step_seconds());
  EXPECT_EQ(world.remarks().size(), 1u);
  run_alone(world, 2000);
  EXPECT_GT(world.report().restored, 0);
  EXPECT_EQ(world.report().restored, world.report().nonfinite + world.report().grown);
  EXPECT_EQ(world.report().halved, world.report().restored);
  EXPECT_LT(world.step_seconds(), world.stable_step_seconds());
  EXPECT_FALSE(world.stopped()) << *world.stopped();
  EXPECT_TRUE(world.body(0).is_finite());
  const EnergyLedger ledger = world.ledger();
  EXPECT_LT(ledger.kinetic + ledger.elastic, 3 * std::abs(ledger.gravitational));
}

/// On a floor what has blown up makes contact take what is no number: that goes back with the state.
TEST(World, KeepsItsBooksWhereNumbersBlowUpOnAFloor) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 2e9";
  recipe.physics = "step_ms = 1";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world = floor_at(-20);
  World world(scene_of(recipe));
  run_alone(world, 500);
  ASSERT_TRUE(world.stopped());
  EXPECT_TRUE(std::isfinite(world.report().contact_lost));
  EXPECT_LT(std::abs(world.ledger().missing()), 1e-9);
}

/// Cells that are shaken by many times their size in the first step grow beyond what was put in at once: no frame shows that.
TEST(World, GoesBackInTheFrameThatGrowsFromTheStart) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.material = "density_kg_per_m3 = 140\nmodulus_kPa = 0.04\npoisson_ratio = 0.37";
  recipe.body = "model = \"fem\"";
  World world(scene_of(recipe));
  Dice dice(1);
  for (const Index cell : world.body(0).body().nodes())
    world.body(0).place(cell, Vec3::Zero(), dice.within(100));
  world.restart_ledger();
  const double put_in = world.ledger().exchanged;
  ASSERT_GT(put_in, 0);
  for (int frame = 0; frame < 20; ++frame) {
    world.frame({});
    const EnergyLedger ledger = world.ledger();
    EXPECT_LT(ledger.elastic, 4.1 * put_in) << frame;
  }
  EXPECT_GT(world.report().grown, 0);
  EXPECT_FALSE(world.stopped());
}

TEST(World, GivesUpWithADiagnosisWhereNoStepIsShortEnough) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 2e9";
  recipe.physics = "step_ms = 1";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.body = "fixed = [\"-z\"]";
  World world(scene_of(recipe));
  ASSERT_GT(world.step_seconds(), 128 * world.stable_step_seconds());
  run_alone(world, 500);
  ASSERT_TRUE(world.stopped());
  EXPECT_NE(world.stopped()->find("\"body\""), std::string::npos) << *world.stopped();
  EXPECT_TRUE(world.body(0).is_finite());
  const auto hash = world.state_hash();
  world.frame({});
  EXPECT_EQ(world.state_hash(), hash) << "a world that has stopped moves";
  world.reset();
  EXPECT_FALSE(world.stopped());
}

TEST(World, StartsAfreshAfterReset) {
  Recipe recipe;
  recipe.body = "velocity_m_per_s = [0, 0, -2]";
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.05";
  recipe.world = floor_at(-21);
  World world(scene_of(recipe));
  const auto start = world.state_hash();
  run_alone(world, 100);
  const auto end = world.state_hash();
  ASSERT_GT(world.report().broken, 0);
  EXPECT_NE(end, start);
  world.reset();
  EXPECT_EQ(world.state_hash(), start);
  run_alone(world, 100);
  EXPECT_EQ(world.state_hash(), end);
}

TEST(World, TakesWholeFramesOfStiffTissueByBackwardEuler) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 2e6";
  recipe.physics = "integrator = \"backward_euler\"\nframe_Hz = 200";
  recipe.body = "fixed = [\"-z\"]";
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  EXPECT_EQ(world.step_seconds(), 0.005);
  run_alone(world, 100);
  const StepReport& report = world.report();
  EXPECT_EQ(report.steps, 100);
  EXPECT_EQ(report.restored + report.unsolved, 0);
  EXPECT_GT(report.cg_iterations, 0);
  const EnergyLedger ledger = world.ledger();
  EXPECT_LT(ledger.balance_error(), 1e-9);  // what the integrator damps is booked
  EXPECT_GT(ledger.numerical, 0);
  // At rest where an explicit integrator comes to rest: half of the weight's work is stored.
  EXPECT_NEAR(ledger.elastic / -ledger.gravitational, 0.5, 1e-3);
}

TEST(World, LeavesCoresToOthersUnlessAPersonChoseTheThreads) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(270, 270, 270);
  recipe.precision = "single";
  const Scene scene = scene_of(recipe);  // 28^3 masses: five chunks
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  const World all(scene), but_one(scene, 1), none(scene, 1000);
  ASSERT_GT(all.body(0).body().lattice.n_masses(), 15000);
  const auto chunks = static_cast<int>(all.body(0).body().lattice.chunks.size());
  ASSERT_GE(chunks, 2);
  EXPECT_EQ(all.threads(), std::clamp(cores, 1, chunks));
  EXPECT_EQ(but_one.threads(), std::clamp(cores - 1, 1, chunks));
  EXPECT_EQ(none.threads(), 1);
  EXPECT_EQ(all.team_choice().threads(), 1) << "it begins with one, and measures";
  recipe.physics = "threads = 3";
  const World chosen(scene_of(recipe), 1000);
  EXPECT_EQ(chosen.threads(), 3);
  EXPECT_EQ(chosen.team_choice().threads(), 3);
}

TEST(World, LeavesContactOutWhereNothingCouldTouch) {
  Recipe recipe;
  EXPECT_EQ(World(scene_of(recipe)).collisions(), nullptr) << "one body that cannot break";
  recipe.world = "[[body]]\nname = \"other\"\nspacing_mm = 10\nmaterial = \"m\"\nat_mm = [200, 0, 0]\n" +
                 Recipe::sphere(30);
  const World world(scene_of(recipe));
  EXPECT_EQ(world.n_bodies(), 2u);
  EXPECT_NE(world.collisions(), nullptr);
  EXPECT_TRUE(world.remarks().empty());
  recipe.world += "\n[contact]\nenabled = false\n";
  EXPECT_EQ(World(scene_of(recipe)).collisions(), nullptr) << "asked to";
}

}  // namespace
}  // namespace palpate::physics
