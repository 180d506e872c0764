#include "physics_node/collision/collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

/// From rest onto a held plate 5 mm below, hard: at the start of the frame in which they meet nothing is fast.
TEST(Collisions, TakeShorterStepsOnceSomethingHasBecomeFastWithinAFrame) {
  test::Recipe recipe{.shape = test::Recipe::box(120, 120, 30)};
  recipe.body = "fixed = [{ min_mm = [-99, -99, -99], max_mm = [99, 99, 99] }]";
  recipe.physics = "frame_Hz = 100";
  recipe.gravity = "[0, 0, -4000]";
  recipe.world =
      "[contact]\ncount_passages = true\n[[body]]\nname = \"ball\"\nmaterial = \"m\"\nlattice = \"fcc\"\n"
      "spacing_mm = 10\nat_mm = [3, 2, 40]\n" +
      test::Recipe::sphere(20);
  World world(test::scene_of(recipe));
  world.frame({});
  // The speed of a fall of 5 mm, and spacing / sqrt(2) apart.
  EXPECT_LT(world.collisions()->wanted_step(), 0.25 * 0.00708 / std::sqrt(2 * 4000 * 0.005));
  EXPECT_GT(world.collisions()->tally().collisions, 0);
  EXPECT_EQ(world.collisions()->tally().passages, 0);
  double lowest = 1;
  const BodyModel& ball = world.body(1);
  for (const Index mass : ball.body().lattice.masses) lowest = std::min(lowest, ball.position(mass).z());
  EXPECT_GT(lowest, 0);
  EXPECT_FALSE(world.has_stopped());
}

}  // namespace
}  // namespace palpate::physics
