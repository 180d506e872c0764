// Strands between two bodies of a scene: their force, momentum, books, and how they tear.
#include "physics_node/connection/connection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/error/error.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// Two blocks of 20 x 20 x 20 mm, one above the other with a gap of 2 mm.
Recipe two_blocks(const std::string& connection = "toughness_J_per_m2 = 2\n", const std::string& upper = "",
                  const std::string& lower = "fixed = [\"-z\"]\n") {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(20, 20, 20);
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 100\nviscosity_Pa_s = 50";
  recipe.body = "model = \"fem\"\n" + lower;
  recipe.world =
      "[contact]\nenabled = false\n"  // which would keep them farther apart than they begin
      "[[body]]\nname = \"upper\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 5\nmaterial = "
      "\"m\"\nshape = "
      "\"box\"\nsize_mm = [20, 20, 20]\nat_mm = [0, 0, 22]\n" +
      upper +
      "[[connection]]\nname = \"bed\"\nfrom = \"upper\"\nto = \"body\"\nwithin_mm = 3\nmodulus_kPa = 1\n" +
      connection;
  return recipe;
}

double height_of(const BodyModel& body) {
  double sum = 0;
  for (const Index node : body.body().nodes()) sum += body.position(node).z() / body.body().n_nodes();
  return sum;
}

TEST(Connection, OfTwoFacesAtRestHasNoForce) {
  World world(scene_of(two_blocks()));
  ASSERT_EQ(world.n_connections(), 1u);
  EXPECT_EQ(world.connection(0).n_strands(), 25);
  for (int n = 0; n < 50; ++n) world.frame({});
  EXPECT_EQ(world.connection(0).pull(), 0);
  EXPECT_EQ(world.connection(0).energy(), 0);
}

/// E A / L = 1 kPa x 400 mm^2 / 2 mm = 200 N/m, from which 8 g hang. Let go, they swing about where they would rest.
TEST(Connection, CarriesAWeightAsItsStiffnessSays) {
  Recipe recipe = (two_blocks("", "fixed = [\"+z\"]\n", ""));
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  const double before = height_of(world.body(0));
  constexpr double mass = 8e-3, weight = mass * 9.81, stiffness = 1e3 * 400e-6 / 2e-3;
  const double period = 2 * std::numbers::pi * std::sqrt(mass / stiffness);
  const int frames = static_cast<int>(std::round(10 * period * scene_of(recipe).physics->frame_Hz));
  double pull = 0;
  for (int n = 0; n < frames; ++n) world.frame({}), pull += world.connection(0).pull() / frames;
  EXPECT_NEAR(pull, weight, 0.02 * weight);
  const double swing = 2 * weight / stiffness;
  EXPECT_LT(height_of(world.body(0)), before);
  EXPECT_GT(height_of(world.body(0)), before - 1.2 * swing);
}

TEST(Connection, KeepsMomentaAndBooksWhileItSwingsAndTears) {
  Recipe recipe = (two_blocks("toughness_J_per_m2 = 0.08\n", "velocity_m_per_s = [0.02, 0, 0.15]\n", ""));
  World world(scene_of(recipe));
  const auto momenta = [&] {
    Momenta sum = world.body(0).momenta();
    sum.linear += world.body(1).momenta().linear, sum.angular += world.body(1).momenta().angular;
    return sum;
  };
  const Momenta before = momenta();
  double worst = 0, worst_watched = 0;
  for (int n = 0; n < 200; ++n) {
    world.frame({});
    worst = std::max(worst, world.ledger().balance_error());
    worst_watched = std::max(worst_watched, world.watched_ledger().balance_error());
  }
  const Momenta after = momenta();
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular.norm());
  EXPECT_LT(worst, 5e-3);
  EXPECT_LT(worst_watched, 5e-3);
  EXPECT_GT(world.connection(0).n_torn(), 0);
  EXPECT_GT(world.ledger().broken, 0);
}

/// All of it torn takes toughness times area, and a little more, since a step sees a strand beyond the most it holds.
TEST(Connection, TakesItsToughnessTimesItsAreaToTear) {
  World world(scene_of((two_blocks("toughness_J_per_m2 = 0.5\n", "velocity_m_per_s = [0, 0, 0.6]\n", ""))));
  for (int n = 0; n < 300; ++n) world.frame({});
  EXPECT_EQ(world.connection(0).n_torn(), 25);
  EXPECT_NEAR(world.ledger().broken, 0.5 * 400e-6, 0.03 * 0.5 * 400e-6);
  EXPECT_EQ(world.connection(0).pull(), 0);
}

/// So stiff and fast that a step takes a strand from rest to beyond what it holds.
TEST(Connection, TakesItsToughnessHoweverStiffAndFast) {
  for (const char* modulus : {"modulus_kPa = 1000\n", "modulus_kPa = 100000\n"}) {
    Recipe recipe = two_blocks("toughness_J_per_m2 = 1\n", "velocity_m_per_s = [0, 0, 4]\n", "");
    const std::string soft = "modulus_kPa = 1\n";
    recipe.world.replace(recipe.world.find(soft), soft.size(), modulus);
    World world(scene_of(recipe));
    for (int n = 0; n < 20; ++n) world.frame({});
    EXPECT_EQ(world.connection(0).n_torn(), 25);
    EXPECT_NEAR(world.ledger().broken, 400e-6, 0.05 * 400e-6) << modulus;
    EXPECT_LT(world.ledger().balance_error(), 0.01) << modulus;
    const double slower = 4 * 8e-3 - world.body(1).momenta().linear.z();
    EXPECT_NEAR(slower * 4, 400e-6, 0.2 * 400e-6) << "half of the energy goes with one body in swinging";
  }
}

/// Two masses of 8 g that part, k = 200 N/m and c = 0.2 N s/m between them, until nothing pulls any more: x = v / w
/// exp(-D t) sin(w t) up to where its second derivative is 0 again.
TEST(Connection, DampsASwingAsTheClosedFormSays) {
  World world(scene_of(two_blocks("viscosity_Pa_s = 1\n", "velocity_m_per_s = [0, 0, 0.1]\n", "")));
  const Vec3 start = world.body(1).momenta().linear + world.body(0).momenta().linear;
  const auto apart = [&] {
    return (world.body(1).momenta().linear.z() - world.body(0).momenta().linear.z()) / 8e-3;
  };
  const double m = 4e-3, D = 0.2 / (2 * m), w = std::sqrt(200 / m - D * D);
  double worst = 0, worst_watched = 0;
  for (int n = 0; n < 20; ++n) {
    world.frame({});
    worst = std::max(worst, world.ledger().balance_error());
    worst_watched = std::max(worst_watched, world.watched_ledger().balance_error());
  }
  EXPECT_EQ(world.connection(0).pull(), 0) << "they have come back";
  const double wt = std::numbers::pi - std::atan2(2 * D * w, w * w - D * D);
  const double left = std::exp(-D * wt / w) * (std::cos(wt) - D / w * std::sin(wt));
  EXPECT_NEAR(apart(), 0.1 * left, 0.003);
  EXPECT_GT(world.connection(0).viscous(), 0);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(worst_watched, 1e-3);
  const Vec3 end = world.body(1).momenta().linear + world.body(0).momenta().linear;
  EXPECT_LT((end - start).norm(), 1e-12 * start.norm());
}

TEST(Connection, ShortensTheStepByItsViscosity) {
  World world(scene_of(two_blocks("viscosity_Pa_s = 1000\n", "velocity_m_per_s = [0, 0, 0.1]\n", "")));
  EXPECT_LT(world.stable_step_seconds(), 0.5 * World(scene_of(two_blocks())).stable_step_seconds());
  for (int n = 0; n < 50; ++n) world.frame({});
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.ledger().balance_error(), 1e-3);
}

TEST(Connection, IsAfterAResetAsItWasLoaded) {
  const Recipe recipe = (two_blocks("toughness_J_per_m2 = 0.5\n", "velocity_m_per_s = [0, 0, 0.6]\n", ""));
  World world(scene_of(recipe));
  const std::uint64_t loaded = world.state_hash();
  for (int n = 0; n < 300; ++n) world.frame({});
  const std::uint64_t torn = world.state_hash();
  EXPECT_NE(torn, loaded);
  world.reset();
  EXPECT_EQ(world.state_hash(), loaded);
  EXPECT_EQ(world.connection(0).n_torn(), 0);
  for (int n = 0; n < 300; ++n) world.frame({});
  EXPECT_EQ(world.state_hash(), torn);
}

TEST(Connection, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const char* threads : {"threads = 1", "threads = 2", "threads = 3"}) {
    Recipe recipe = (two_blocks("toughness_J_per_m2 = 0.5\n", "velocity_m_per_s = [0.1, 0, 0.3]\n"));
    recipe.physics = threads;
    World world(scene_of(recipe));
    for (int n = 0; n < 100; ++n) world.frame({});
    if (first == 0) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads;
  }
}

/// So stiff that only its own bound keeps the step short enough.
TEST(Connection, ShortensTheStepByItsStiffness) {
  Recipe soft = two_blocks("", "velocity_m_per_s = [0, 0, 0.05]\n"), stiff = soft;
  const std::string modulus = "modulus_kPa = 1\n";
  stiff.world.replace(stiff.world.find(modulus), modulus.size(), "modulus_kPa = 100000\n");
  World slow(scene_of(stiff));
  EXPECT_LT(slow.stable_step_seconds(), 0.7 * World(scene_of(soft)).stable_step_seconds());
  for (int n = 0; n < 100; ++n) slow.frame({});
  EXPECT_EQ(slow.report().restored, 0);
}

TEST(Connection, OfTooMuchViscosityIsRefusedByItsName) {
  try {
    World world(scene_of(two_blocks("viscosity_Pa_s = 1000000\n")));
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("give connection \"bed\" a smaller modulus_kPa or viscosity_Pa_s"));
  }
}

TEST(Connection, ThatJoinsNothingIsRefused) {
  Recipe recipe = (two_blocks());
  const std::string near = "within_mm = 3";
  recipe.world.replace(recipe.world.find(near), near.size(), "within_mm = 1");
  try {
    World world(scene_of(recipe));
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("connection \"bed\" joins nothing"));
    EXPECT_THAT(error.what(), testing::HasSubstr("within 1 mm"));
  }
}

}  // namespace
}  // namespace palpate::physics::test
