// Contact as printed: what two masses do to each other.
#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Dice;
using test::Recipe;

/// Two bodies of two masses each, 10 mm apart, whose elements are so soft that they do next to nothing.
Recipe two_pairs(double other_mass_g) {
  Recipe recipe = test::pair_of_masses("mass_g = 1\nk1_N_per_m = 1e-12");
  recipe.shape = Recipe::box(7.2, 7.2, 1);
  recipe.spacing_mm = 10;
  recipe.physics = "sleep = false";
  recipe.world = "[contact]\ndistance = \"paper\"\n[material.n]\nk1_N_per_m = 1e-12\nmass_g = " +
                 std::to_string(other_mass_g) +
                 "\n[[body]]\nname = \"other\"\nlattice = \"fcc\"\nspacing_mm = 10\nmaterial = \"n\"\n" +
                 recipe.shape + "\nat_mm = [0, 0, 12]\n";
  return recipe;
}

struct Sums {
  double kinetic = 0;
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};
Sums sums(const World& world) {
  Sums sum;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    sum.kinetic += world.body(b).energies(Vec3::Zero()).kinetic;
    const Momenta p = world.body(b).momenta();
    sum.linear += p.linear;
    sum.angular += p.angular;
  }
  return sum;
}

TEST(Exchange, KeepsMomentumAndKineticEnergyOfTwoMassesThatMeet) {
  Dice dice(1);
  for (int n = 0; n < 50; ++n) {
    World world(test::scene_of(two_pairs(dice.between(0.1, 1000))));
    const Index mine = world.body(0).body().lattice.masses.front();
    const Index theirs = world.body(1).body().lattice.masses.front();
    world.body(0).place(mine, Vec3::Zero(),
                        Vec3(dice.between(-0.05, 0.05), dice.between(-0.05, 0.05), dice.between(0.5, 2)));
    world.body(1).place(theirs, Vec3::Zero(), Vec3(0, 0, dice.between(-1, 0.3)));
    world.restart_ledger();
    const Sums before = sums(world);
    for (int frame = 0; frame < 40; ++frame) world.frame({});
    ASSERT_GE(world.collisions()->tally().collisions, 1) << "seed 1, case " << n;
    const Sums after = sums(world);
    EXPECT_NEAR(after.kinetic / before.kinetic, 1, 1e-12) << "seed 1, case " << n;
    EXPECT_LE((after.linear - before.linear).norm(), 1e-12 * before.linear.norm()) << "seed 1, case " << n;
    EXPECT_LE((after.angular - before.angular).norm(), 1e-11 * (before.linear.norm() * 0.1))
        << "seed 1, case " << n;
  }
}

TEST(Exchange, OfEqualMassesHeadOnSwapsTheirVelocities) {
  World world(test::scene_of(two_pairs(1)));
  const Index mine = world.body(0).body().lattice.masses.front();
  const Index theirs = world.body(1).body().lattice.masses.front();
  world.body(0).place(mine, Vec3::Zero(), Vec3(0, 0, 1));
  world.restart_ledger();
  for (int frame = 0; frame < 30; ++frame) world.frame({});
  EXPECT_EQ(world.collisions()->tally().collisions, 1);
  EXPECT_NEAR(world.body(0).velocity(mine).z(), 0, 1e-9);
  EXPECT_NEAR(world.body(1).velocity(theirs).z(), 1, 1e-9);
  // They met at L / sqrt(3), within a step.
  const double gap = world.body(1).position(theirs).z() - world.body(0).position(mine).z();
  EXPECT_GT(gap, 0.010 / std::sqrt(3.0) - 0.001);
}

TEST(Exchange, WithRestitutionZeroLeavesOneVelocityAndBooksWhatIsLost) {
  Recipe recipe = two_pairs(1);
  recipe.world.replace(recipe.world.find("distance"), 0, "restitution = 0\n");
  World world(test::scene_of(recipe));
  const Index mine = world.body(0).body().lattice.masses.front();
  const Index theirs = world.body(1).body().lattice.masses.front();
  world.body(0).place(mine, Vec3::Zero(), Vec3(0, 0, 1));
  world.restart_ledger();
  for (int frame = 0; frame < 30; ++frame) world.frame({});
  EXPECT_NEAR(world.body(0).velocity(mine).z(), 0.5, 1e-9);
  EXPECT_NEAR(world.body(1).velocity(theirs).z(), 0.5, 1e-9);
  EXPECT_NEAR(world.ledger().contact, 0.25e-3, 1e-12);
  EXPECT_LT(world.ledger().balance_error(), 1e-9);
}

TEST(Exchange, LetsMassesThatPartGo) {
  World world(test::scene_of(two_pairs(1)));
  const Index mine = world.body(0).body().lattice.masses.front();
  world.body(0).place(mine, Vec3(0, 0, 0.010), Vec3(0, 0, -1));  // within reach of the other, on its way out
  for (int frame = 0; frame < 5; ++frame) world.frame({});
  EXPECT_EQ(world.collisions()->tally().collisions, 0);
}

TEST(Exchange, IsSkippedWhileBodiesAreApart) {
  Recipe recipe = two_pairs(1);
  recipe.world.replace(recipe.world.find("[0, 0, 12]"), 10, "[0, 0, 500]");
  World world(test::scene_of(recipe));
  for (int frame = 0; frame < 20; ++frame) world.frame({});
  EXPECT_EQ(world.report()[Stage::contact_forces].calls, 0);
  EXPECT_EQ(world.report()[Stage::contact_forces].skipped, world.report().steps);
}

}  // namespace
}  // namespace palpate::physics
