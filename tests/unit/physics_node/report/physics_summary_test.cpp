#include "physics_node/report/physics_summary.h"
#include "physics_node/step/body_model.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;
using nlohmann::json;

void expect_keys(const json& part, const std::vector<const char*>& keys, const std::string& where) {
  for (const char* key : keys) EXPECT_TRUE(part.contains(key)) << where << " lacks " << key;
}

void expect_no_null(const json& part, const std::string& where) {
  EXPECT_FALSE(part.is_null()) << where;
  if (part.is_object())
    for (const auto& [key, value] : part.items()) expect_no_null(value, where + "." + key);
}

TEST(PhysicsSummary, HasTheKeysPromised) {
  const palpate::test::ScratchFolder folder;
  World world(pressed_slab());
  Recorder recorder(world, SceneSource{}, folder.path(), Recorder::WhenBehind::wait);
  const auto hand = steady_hand({0, 0, 1.5});
  for (int n = 0; n < 1000; ++n) {
    run(world, hand, 1);
    recorder.frame(world, std::span(&hand, 1));
  }
  const json summary = physics_summary(world, &recorder, 2.0);
  expect_no_null(summary, "summary");
  expect_keys(summary,
              {"scene", "commit", "seed", "threads", "precision", "integrator", "simulated_s", "wall_s",
               "real_time_factor", "steps", "dt_s", "state_hash", "stages", "bodies", "energy", "momentum",
               "tools", "guard", "warnings"},
              "summary");
  for (const char* stage : stage_names) {
    ASSERT_TRUE(summary.at("stages").contains(stage)) << stage;
    expect_keys(summary.at("stages").at(stage), {"total_s", "calls", "skipped"}, stage);
  }
  expect_keys(summary.at("bodies").at("body"),
              {"masses", "elements", "live_elements", "broken_fraction", "shape_rms_m", "max_stretch",
               "sleeping_fraction", "steps"},
              "body");
  EXPECT_FALSE(summary.at("bodies").at("body").contains("yielded_fraction")) << "it cannot yield";
  EXPECT_FALSE(summary.at("bodies").at("body").contains("fragments")) << "it cannot break";
  EXPECT_EQ(summary.at("bodies").at("body").at("outcome"), "restitution");
  EXPECT_FALSE(summary.at("momentum").contains("linear_error")) << "it is held";
  expect_keys(summary.at("team"), {"mean_threads", "trials", "changes"}, "team");
  EXPECT_EQ(summary.at("team").at("mean_threads"), 1) << "a small body";
  expect_keys(summary.at("energy"),
              {"kinetic", "elastic", "gravitational", "dissipated", "plastic", "numerical", "broken", "guard",
               "contact", "cut", "tool_work", "exchanged", "balance_error"},
              "energy");
  expect_keys(summary.at("momentum"), {"linear", "angular"}, "momentum");
  expect_keys(summary.at("guard"), {"nonfinite", "grown", "restored", "halved", "unsolved", "warnings"},
              "guard");
  EXPECT_EQ(summary.at("guard").at("warnings"), 0);
  EXPECT_FALSE(summary.at("guard").contains("stopped"));
  EXPECT_EQ(summary.at("warnings"), json::array()) << "nothing is wrong with it";
  expect_keys(summary.at("tools").at("tip"),
              {"contacts_max", "force_peak", "force_rms", "moment_peak", "trace", "hand_work", "tissue_work",
               "felt_over_true_rms", "felt_off_rms"},
              "tool");

  EXPECT_NEAR(summary.at("simulated_s").get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(summary.at("real_time_factor").get<double>(), 0.5, 1e-9);
  EXPECT_EQ(summary.at("precision"), "double");
  EXPECT_EQ(summary.at("bodies").at("body").at("masses"), 13 * 13 * 6);
  EXPECT_EQ(summary.at("bodies").at("body").at("broken_fraction"), 0.0);
  EXPECT_NEAR(summary.at("tools").at("tip").at("force_peak").get<double>(), 1.5, 1e-3);
  EXPECT_LT(summary.at("tools").at("tip").at("force_rms").get<double>(), 1.5);
  EXPECT_GT(summary.at("energy").at("tool_work").get<double>(),
            summary.at("energy").at("elastic").get<double>());
  EXPECT_GT(summary.at("energy").at("elastic").get<double>(), 1e-5);
  EXPECT_EQ(summary.at("state_hash").get<std::string>().size(), 16u);
}

TEST(PhysicsSummary, TellsOfYieldAndBreak) {
  Recipe recipe;
  recipe.body = "velocity_m_per_s = [0, 0, -3]";
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.05";
  recipe.world = floor_at(-21);
  World world(scene_of(recipe));
  for (int n = 0; n < 100; ++n) world.frame({});
  const json summary = physics_summary(world, nullptr, 1.0);
  const json& body = summary.at("bodies").at("body");
  EXPECT_GT(body.at("yielded_fraction").get<double>(), 0);
  const double broken = 1 - body.at("live_elements").get<double>() / body.at("elements").get<double>();
  EXPECT_GT(broken, 0);
  EXPECT_NEAR(body.at("broken_fraction").get<double>(), broken, 1e-12);
  EXPECT_FALSE(summary.contains("tools"));
  EXPECT_EQ(body.at("fragments").get<int>(), world.fragments(0)->count());
  EXPECT_GT(body.at("fragments").get<int>(), 1);
  EXPECT_GT(body.at("second_fragment").get<double>(), 0);
  EXPECT_GE(body.at("largest_fragment").get<double>(), body.at("second_fragment").get<double>());
  EXPECT_LT(summary.at("momentum").at("linear_error").get<double>(), 1e-11);
  EXPECT_LT(summary.at("momentum").at("angular_error").get<double>(), 1e-11);
}

TEST(PhysicsSummary, DoesNotMakeAnErrorOfTheDigitsOfWhatDoesNotTurn) {
  Recipe recipe{.shape = Recipe::sphere(20)};
  recipe.gravity = "[0, 0, -9.81]";
  recipe.precision = "single";
  World world(scene_of(recipe));
  for (int n = 0; n < 100; ++n) world.frame({});
  const json summary = physics_summary(world, nullptr, 1.0);
  EXPECT_LT(summary.at("momentum").at("angular_error").get<double>(), 1e-4);
}

TEST(PhysicsSummary, SaysInWordsWhatIsWrong) {
  Recipe recipe;
  recipe.material = "mass_g = 1\nk1_N_per_m = 20000";
  recipe.physics = "step_ms = 1";  // above the stable step: a remark, then work for the guard
  recipe.body = "fixed = [\"-z\"]";
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  for (int n = 0; n < 2000; ++n) world.frame({});
  ASSERT_GT(world.report().restored, 0);
  const json warnings = physics_summary(world, nullptr, 1.0).at("warnings");
  ASSERT_EQ(warnings.size(), 2u) << warnings;
  EXPECT_EQ(physics_summary(world, nullptr, 1.0).at("guard").at("warnings"), 2);
  EXPECT_EQ(warnings[0], world.remarks().at(0));
  EXPECT_NE(warnings[1].get<std::string>().find("the guard brought"), std::string::npos) << warnings[1];
}

TEST(PhysicsSummary, CallsABodyThatNothingHasTouchedOriginal) {
  Recipe recipe;
  recipe.material += "\nyield_ratio = 1.01\nbreak_ratio = 1.05";
  recipe.body = "velocity_m_per_s = [0, 0, -1]";
  recipe.world = floor_at(-41);
  World world(scene_of(recipe));
  const auto body = [&] { return physics_summary(world, nullptr, 1.0).at("bodies").at("body"); };
  for (int n = 0; n < 10; ++n) world.frame({});
  EXPECT_EQ(body().at("outcome"), "original");
  EXPECT_EQ(body().at("fragments"), 1);
  EXPECT_FALSE(body().contains("second_fragment")) << "there is one only";
  for (int n = 0; n < 40; ++n) world.frame({});
  EXPECT_NE(body().at("outcome"), "original");
  world.reset();
  EXPECT_EQ(body().at("outcome"), "original");
}

/// A cube that falls, and is given a part of the energy of its fall that nobody accounts for.
json warnings_with(double part) {
  Recipe recipe;
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  for (int n = 0; n < 200; ++n) world.frame({});
  EXPECT_EQ(physics_summary(world, nullptr, 1).at("warnings"), json::array());
  BodyModel& cube = world.body(0);
  for (const Index cell : cube.body().lattice.masses)
    cube.place(cell, cube.displacement(cell), std::sqrt(1 + part) * cube.velocity(cell));
  world.frame({});
  return physics_summary(world, nullptr, 1).at("warnings");
}

TEST(PhysicsSummary, WarnsWhereEnergyDoesNotBalance) {
  for (const double part : {0.02, -0.02}) {
    const json warnings = warnings_with(part);
    ASSERT_EQ(warnings.size(), 1) << warnings;
    const std::string text = warnings[0];
    EXPECT_NE(text.find("the energy does not balance"), std::string::npos) << text;
    EXPECT_NE(text.find("set a smaller physics.step_ms"), std::string::npos) << text;
  }
  EXPECT_EQ(warnings_with(0.005), json::array());
}

/// Brittle tissue breaks on the floor faster than its step follows.
json warnings_of_a_smash(double step_ms) {
  Recipe recipe;
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 100\nviscosity_Pa_s = 1\nyield_ratio = 1.05\nbreak_ratio = "
      "1.1";
  recipe.shape = Recipe::box(40, 40, 40);
  recipe.spacing_mm = 8;
  recipe.physics = fmt::format("step_ms = {}", step_ms);
  recipe.world = floor_at(-21);
  World world(scene_of(recipe));
  BodyModel& cube = world.body(0);
  for (const Index cell : cube.body().lattice.masses) cube.place(cell, Vec3::Zero(), Vec3(1, 0, -4));
  world.restart_ledger();
  for (int n = 0; n < 200; ++n) world.frame({});
  const json summary = physics_summary(world, nullptr, 1);
  return summary.at("warnings");
}

TEST(PhysicsSummary, WarnsWhereStepsGenerateEnergy) {
  EXPECT_NE(warnings_of_a_smash(0.3).dump().find("the steps have generated"), std::string::npos);
  EXPECT_EQ(warnings_of_a_smash(0.005), json::array());
}

}  // namespace
}  // namespace palpate::physics
