// Rows at rest are skipped, and wake when something reaches them: by a push, through their neighbours, by a reset.
#include <gtest/gtest.h>

#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

class Sleep : public testing::TestWithParam<const char*> {
 protected:
  bool is_solid() const { return GetParam() == std::string("finite elements"); }

  /// A bar of soft, damped tissue along y, held at one end. Rows run along x.
  Recipe bar(bool sleep, std::string keys = "fixed = [\"-y\"]") const {
    Recipe recipe;
    recipe.shape = Recipe::box(40, 400, 40);
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 20";
    if (is_solid()) {
      recipe.lattice = "voxel";
      keys += "\nmodel = \"fem\"";
    }
    recipe.body = keys;
    recipe.physics = std::string("sleep = ") + (sleep ? "true" : "false");
    return recipe;
  }
};

/// Gives the masses at the free end this upward speed, every frame anew. What that does is not the ledger's.
void push(World& world, double speed, int frames) {
  const Body& body = world.body(0).body();
  double far = -1e9;
  for (const Index cell : body.lattice.masses) far = std::max(far, body.lattice.rest_position(cell).y());
  for (int n = 0; n < frames; ++n) {
    for (const Index cell : body.lattice.masses)
      if (body.lattice.rest_position(cell).y() > far - 1e-6)
        world.body(0).place(cell, world.body(0).displacement(cell), Vec3(0, 0, speed));
    world.restart_ledger();
    world.frame({});
  }
}

void rest(World& world, double seconds) {
  const double end = world.t() + seconds;
  while (world.t() < end && !world.has_stopped()) world.frame({});
  EXPECT_FALSE(world.has_stopped()) << *world.stopped();
}

double farthest(const World& world) {
  double most = 0;
  for (const Index cell : world.body(0).body().lattice.masses)
    most = std::max(most, world.body(0).displacement(cell).norm());
  return most;
}

TEST_P(Sleep, BeginsAtOnceWhereNothingEverMoved) {
  World world(scene_of(bar(true)));
  rest(world, 0.005);
  EXPECT_EQ(world.body(0).sleeping_fraction(), 1);
  const auto hash = world.state_hash();
  rest(world, 0.1);
  EXPECT_EQ(world.state_hash(), hash);
  EXPECT_EQ(world.ledger().exchanged, 0);
}

TEST_P(Sleep, CountsMassesAndNoPlacesWithoutOne) {
  Recipe recipe = bar(true, "fixed = [\"-z\"]");
  recipe.shape =
      "shape = \"tube\"\nouter_radius_mm = 40\ninner_radius_mm = 20\nlength_mm = 100\naxis = \"z\"";
  World world(scene_of(recipe));
  rest(world, 0.005);
  EXPECT_EQ(world.body(0).sleeping_fraction(), 1) << "rows across the bore have a gap";
}

TEST_P(Sleep, EndsThroughNeighboursAndMovesAsIfNothingHadSlept) {
  World sleeper(scene_of(bar(true))), awake(scene_of(bar(false)));
  rest(sleeper, 0.3), rest(awake, 0.3);
  ASSERT_EQ(sleeper.body(0).sleeping_fraction(), 1);
  push(sleeper, 0.05, 300), push(awake, 0.05, 300);
  const double moved = farthest(awake);
  EXPECT_GT(moved, 0.005);
  EXPECT_NEAR(farthest(sleeper), moved, 0.01 * moved);
  EXPECT_LT(sleeper.body(0).sleeping_fraction(), 0.3);
  double most = 0;
  for (const Index cell : awake.body(0).body().lattice.masses)
    most = std::max(most, (awake.body(0).displacement(cell) - sleeper.body(0).displacement(cell)).norm());
  EXPECT_LT(most, 0.01 * moved);
}

TEST_P(Sleep, ComesBackAfterAPushNearTheRestPosition) {
  Recipe recipe = bar(true, "fixed = [\"-z\"]");
  recipe.physics += "\nsafety = 0.3";  // for the ledger
  World world(scene_of(recipe));
  push(world, 0.05, 50);
  const double moved = farthest(world);
  rest(world, 5);
  EXPECT_EQ(world.body(0).sleeping_fraction(), 1);
  EXPECT_LT(farthest(world), 0.02 * moved);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
}

TEST_P(Sleep, LeavesTheFarEndAsleepWhileTheNearOneIsTouched) {
  Recipe recipe = bar(true, "fixed = [\"-y\", \"-z\"]");  // on a table: a push does not travel far
  recipe.shape = Recipe::box(40, 800, 40);
  World world(scene_of(recipe));
  push(world, 0.05, 20);
  EXPECT_GT(farthest(world), 1e-4);
  EXPECT_GT(world.body(0).sleeping_fraction(), 0.3);
  EXPECT_LT(world.body(0).sleeping_fraction(), 0.99);
}

TEST_P(Sleep, IsNotForBodiesThatFly) {
  Recipe recipe = bar(true, "velocity_m_per_s = [0, 0, 0.00001]");
  World world(scene_of(recipe));
  rest(world, 1);
  EXPECT_EQ(world.body(0).sleeping_fraction(), 0);
}

TEST_P(Sleep, EndsWithAReset) {
  World world(scene_of(bar(true)));
  rest(world, 0.01);
  ASSERT_EQ(world.body(0).sleeping_fraction(), 1);
  world.reset();
  EXPECT_EQ(world.body(0).sleeping_fraction(), 0);
}

TEST_P(Sleep, IsTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = bar(true);
    recipe.precision = "single";
    recipe.physics += "\nthreads = " + std::to_string(threads);
    World world(scene_of(recipe));
    push(world, 0.05, 100);
    rest(world, 1);
    if (threads == 1) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads;
  }
}

/// A memory that fades slower than any threshold sees must not be stopped.
TEST(SleepOfTissue, IsNotForWhatCreeps) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 20\nrelaxation = [[0.5, 100]]";
  recipe.body = "fixed = [\"-z\"]\nmodel = \"fem\"";
  recipe.physics = "sleep = true";
  World world(scene_of(recipe));
  rest(world, 0.5);
  EXPECT_EQ(world.body(0).sleeping_fraction(), 0);
}

/// Rows that stand beside one that moves hold it as they would if they had been awake, and books stay whole.
TEST(SleepOfTissue, KeepsTheBooksOfDampersThatFallAsleepAndWake) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(40, 200, 40);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 20";
  recipe.body = "fixed = [\"-z\"]\nmodel = \"fem\"";
  recipe.physics = "sleep = true\nsafety = 0.1";  // what a blow gives depends on the step
  recipe.gravity = "[0, 0, -3]";
  World world(scene_of(recipe));
  rest(world, 2);  // it sags and falls asleep
  ASSERT_EQ(world.body(0).sleeping_fraction(), 1);
  const double dissipated = world.ledger().dissipated;
  EXPECT_GT(dissipated, 0);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
  const Body& body = world.body(0).body();
  const Index corner = body.nodes().back();
  const Vec3 dv(0, 0.3, -0.3);
  constexpr int pushes = 5;
  for (int n = 0; n < pushes; ++n) {
    const NodalPush push{corner, dv};
    world.body(0).push({&push, 1}, 0);
    rest(world, 1);
    EXPECT_EQ(world.body(0).sleeping_fraction(), 1);
  }
  const double given = pushes * 0.5 * node_mass(body, corner) * dv.squaredNorm();
  EXPECT_NEAR(world.ledger().dissipated - dissipated, given, 0.02 * given);
}

INSTANTIATE_TEST_SUITE_P(Models, Sleep, testing::Values("springs", "finite elements"),
                         [](const auto& kind) { return kind.index == 0 ? "Springs" : "FiniteElements"; });

}  // namespace
}  // namespace palpate::physics::test
