// Bodies whose elements act once for several steps of the world: what that may change, and what not.
#include "physics_node/step/strides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics::test {
namespace {

/// Soft tetrahedra of 40 x 40 x 40 mm, and 2 mm above them a block a thousand times stiffer, joined by strands.
Recipe soft_below_stiff(const std::string& of_soft = "", const std::string& of_stiff = "") {
  Recipe recipe = mesh_box({4, 4, 4}, 0.01);
  recipe.material += "\nviscosity_Pa_s = 1";
  recipe.body = of_soft;
  recipe.world =
      "[contact]\nenabled = false\n"
      "[material.stiff]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = 10000\npoisson_ratio = 0.3\n"
      "[[body]]\nname = \"stiff\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 10\nmaterial = "
      "\"stiff\"\n"
      "shape = \"box\"\nsize_mm = [40, 40, 40]\nat_mm = [0, 0, 42]\n" +
      of_stiff +
      "[[connection]]\nname = \"bed\"\nfrom = \"stiff\"\nto = \"body\"\nwithin_mm = 3\nmodulus_kPa = 1\n";
  return recipe;
}

struct Way {
  std::vector<Vec3> soft, stiff;  // the middle of each body, by frame [m]
  double worst_balance = 0;
  std::int64_t steps = 0, of_soft = 0, of_stiff = 0;
};

Vec3 middle(const BodyModel& body) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : body.body().nodes()) sum += body.position(node);
  return sum / static_cast<double>(body.body().nodes().size());
}

Way run(World& world, int frames) {
  Way way;
  for (int n = 0; n < frames; ++n) {
    world.frame({});
    way.soft.push_back(middle(world.body(0)));
    way.stiff.push_back(middle(world.body(1)));
    way.worst_balance = std::max(way.worst_balance, world.watched_ledger().balance_error());
  }
  way.steps = world.report().steps, way.of_soft = world.steps_of_body(0),
  way.of_stiff = world.steps_of_body(1);
  return way;
}

/// A step that is given is one of all bodies.
Way run_with_all_in_every_step(Recipe recipe, double step_s, int frames) {
  recipe.physics += "\nstep_ms = " + std::to_string(1e3 * step_s);
  World world(scene_of(recipe));
  return run(world, frames);
}

TEST(Strides, DivideTheStepsThatThereAre) {
  Strides strides;
  strides.add(0, 1);
  strides.add(0.6e-3, 1);
  strides.share(17, 1e-3);
  EXPECT_EQ(strides.shared(17), 18);
  constexpr double dt = 1e-3 / 18;
  const auto acted = [&](int n, bool each = false) {  // in n steps, the last of a frame
    std::vector<int> steps;
    for (int left = n - 1; left >= 0; --left) {
      EXPECT_EQ(strides.acts_for(0, left, dt, each), 1);
      steps.push_back(strides.acts_for(1, left, dt, each));
    }
    return steps;
  };
  using testing::ElementsAre;
  strides.divide(18, dt, 1);
  EXPECT_THAT(acted(18), ElementsAre(8, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 9))
      << "at first up to there";
  EXPECT_THAT(acted(18), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 9));
  // Stiffer: 0.46 ms at once are 8.3 of these steps, and of no more only 6 divides 18.
  strides.divide(18, dt, 1.3);
  EXPECT_THAT(acted(18), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 6, 0, 0, 0, 0, 0, 6));
  EXPECT_THAT(acted(6, true), ElementsAre(0, 0, 0, 0, 0, 1)) << "in each, when what they acted for is over";
  EXPECT_THAT(acted(3, true), ElementsAre(1, 1, 1));
  strides.act_in_every_step(1);
  EXPECT_THAT(acted(3), ElementsAre(1, 1, 1));
  strides.divide(17, dt, 1);
  EXPECT_THAT(acted(3), ElementsAre(1, 1, 1)) << "a prime";
  EXPECT_EQ(strides.acted(1), 3 + 2 + 3 + 1 + 9);
}

/// One that sets the pace by itself wants as many steps as it wants, and no more of them.
TEST(Strides, AddNoStepsWhereNoneIsLeftOut) {
  Strides alone;
  alone.add(0.1e-3, 1);
  alone.share(10, 1e-3);
  for (int n = 10; n < 40; ++n) EXPECT_EQ(alone.shared(n), n);
}

TEST(Strides, LeaveOutWhatASoftBodyDoesNotNeed) {
  Recipe recipe = soft_below_stiff();
  World world(scene_of(recipe));
  const Way way = run(world, 20);
  EXPECT_EQ(way.of_stiff, way.steps);
  EXPECT_LT(way.of_soft, way.steps / 3);
  EXPECT_GE(way.of_soft, 20);
  const Way all = run_with_all_in_every_step(recipe, world.step_seconds(), 20);
  EXPECT_EQ(all.of_soft, all.steps);
}

TEST(Strides, OfABodyAloneAreNone) {
  Recipe recipe = mesh_box({2, 2, 2}, 0.01);
  recipe.physics = "frame_Hz = 100";
  World world(scene_of(recipe));
  for (int n = 0; n < 10; ++n) world.frame({});
  EXPECT_GT(world.report().steps, 10);
  EXPECT_EQ(world.steps_of_body(0), world.report().steps);
}

/// Nothing acts from outside: what the one gives the other takes.
TEST(Strides, KeepBothMomentaAndTheBooks) {
  const Recipe recipe =
      soft_below_stiff("velocity_m_per_s = [0.1, 0, -0.2]\n", "velocity_m_per_s = [0, 0.3, 0.1]\n");
  World world(scene_of(recipe));
  const auto momenta = [&] {
    Momenta sum = world.body(0).momenta();
    sum.linear += world.body(1).momenta().linear, sum.angular += world.body(1).momenta().angular;
    return sum;
  };
  const Momenta before = momenta();
  const Way way = run(world, 200);
  const Momenta after = momenta();
  EXPECT_LT(way.of_soft, way.steps / 3);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular.norm());
  EXPECT_GT(world.connection(0).pull(), 0);
  const Way all = run_with_all_in_every_step(recipe, world.step_seconds(), 200);
  std::printf("worst balance %.2e, with all in every step %.2e\n", way.worst_balance, all.worst_balance);
  EXPECT_LT(way.worst_balance, 1e-3);
}

TEST(Strides, MoveBodiesAsStepsOfAllDo) {
  const Recipe recipe = soft_below_stiff("fixed = [\"-z\"]\n", "velocity_m_per_s = [0.2, 0, 0.3]\n");
  World world(scene_of(recipe));
  const Way few = run(world, 150);
  const Way all = run_with_all_in_every_step(recipe, world.step_seconds(), 150);
  double worst_soft = 0, worst_stiff = 0, most_soft = 0, most_stiff = 0;
  for (std::size_t n = 0; n < few.soft.size(); ++n) {
    worst_soft = std::max(worst_soft, (few.soft[n] - all.soft[n]).norm());
    worst_stiff = std::max(worst_stiff, (few.stiff[n] - all.stiff[n]).norm());
    most_soft = std::max(most_soft, (all.soft[n] - all.soft[0]).norm());
    most_stiff = std::max(most_stiff, (all.stiff[n] - all.stiff[0]).norm());
  }
  std::printf("soft %.3g of %.3g mm, stiff %.3g of %.3g mm; acted %lld of %lld\n", 1e3 * worst_soft,
              1e3 * most_soft, 1e3 * worst_stiff, 1e3 * most_stiff, static_cast<long long>(few.of_soft),
              static_cast<long long>(few.steps));
  EXPECT_LT(worst_soft, 0.02 * most_soft);
  EXPECT_LT(worst_stiff, 0.01 * most_stiff);
  EXPECT_GT(most_soft, 1e-4);
}

/// Gravity acts on elements' own terms, and must not be lost between them.
TEST(Strides, FallAsBodiesDo) {
  Recipe recipe = soft_below_stiff();
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  const Vec3 soft = middle(world.body(0)), stiff = middle(world.body(1));
  const Way way = run(world, 100);
  const double fallen = 0.5 * 9.81 * 0.1 * 0.1, frame = 1e-3;
  EXPECT_NEAR(soft.z() - way.soft.back().z(), fallen, 9.81 * 0.1 * frame);
  EXPECT_NEAR(stiff.z() - way.stiff.back().z(), fallen, 9.81 * 0.1 * frame);
  EXPECT_LT(way.worst_balance, 1e-4);
}

/// Where bodies may strike each other contact asks for what moved them in each step.
TEST(Strides, AreNoneWhereBodiesMayMeet) {
  Recipe recipe = soft_below_stiff();
  recipe.world.replace(recipe.world.find("enabled = false"), 15, "enabled = true");
  World world(scene_of(recipe));
  const Way way = run(world, 10);
  EXPECT_EQ(way.of_soft, way.steps);
}

TEST(Strides, BeginAnewAfterAReset) {
  World world(scene_of(soft_below_stiff("fixed = [\"-z\"]\n", "velocity_m_per_s = [0.2, 0, 0.3]\n")));
  const Way first = run(world, 7);
  const std::uint64_t hash = world.state_hash();
  world.reset();
  run(world, 7);
  EXPECT_EQ(world.state_hash(), hash);
}

}  // namespace
}  // namespace palpate::physics::test
