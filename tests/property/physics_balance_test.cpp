// scenes/fem_sag.toml: it begins in balance and stays there; a hand presses its free end down, and it comes back; its books are kept.

#include <gtest/gtest.h>

#include "common/scene/load_scene.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

TEST(BalancedScene, StaysInBalanceAndComesBackToIt) {
  World world(load_scene(std::string(SCENES) + "/fem_sag.toml"));
  EXPECT_TRUE(world.remarks().empty());
  const Body& body = world.body(0).body();
  Index end = body.nodes()[0];
  for (const Index node : body.nodes())
    if (body.rest_position(node).sum() > body.rest_position(end).sum()) end = node;
  const Vec3 balanced = world.body(0).displacement(end);
  EXPECT_LT(balanced.z(), -5e-4);
  for (int n = 0; n < 25; ++n) world.frame({});
  EXPECT_LT((world.body(0).displacement(end) - balanced).norm(), 2e-3 * balanced.norm());
  auto hand = test::steady_hand({0, 0, 0.5});
  hand->proxy = {0.015, 0, 0.0143};
  hand->p_WT = {0.015, 0, 0.0130};
  test::run(world, hand, 150);
  const double pressed = (world.body(0).displacement(end) - balanced).norm();
  EXPECT_GT(pressed, 0.5 * balanced.norm());
  test::run(world, std::nullopt, 500);
  EXPECT_LT((world.body(0).displacement(end) - balanced).norm(), 0.05 * pressed);
  EXPECT_LT(world.ledger().balance_error(), 1e-3);
  EXPECT_EQ(world.report().unsolved, 0);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.report().newton_iterations, 5 * world.report().steps);
  EXPECT_GT(world.report().cg_iterations, world.report().newton_iterations);
}

}  // namespace
}  // namespace palpate::physics
