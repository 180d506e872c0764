// Tools that are bodies: led by a hand, felt by what they hit.
#include <gtest/gtest.h>

#include "common/scene/load_scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

/// A plate that a hand holds at the origin, its blade up, and a ball that flies at its side.
Scene plate_and_ball(const std::string& ball_velocity) {
  return parse_scene(
      "gravity_m_per_s2 = [0, 0, 0]\n[physics]\nprecision = \"double\"\n"
      "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius_mm = 12\nspacing_mm = 6\nat_mm = [20, 30, 10]\n"
      "velocity_m_per_s = " +
          ball_velocity +
          "\nmaterial = \"m\"\n"
          "[[tool]]\nname = \"plate\"\nshape = \"knife\"\nlength_mm = 40\nheight_mm = 40\nspacing_mm = 5\n"
          "material = \"steel\"\ndevice = \"hand\"\nset_point_mm = [20, 0, 40]\n"
          "[material.m]\nmass_g = 1\nk1_N_per_m = 500\n"
          "[material.steel]\nmass_g = 10\nk1_N_per_m = 20000\n"
          "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 0], [1, 0, 0, 0]]\n",
      "plate.toml");
}

std::vector<std::optional<ToolState>> hand_at(const Vec3& p, std::uint64_t tick) {
  ToolState state{};
  state.tick = tick;
  state.engaged = 1;
  state.p_WT = {p.x(), p.y(), p.z()};
  state.q_WT = {1, 0, 0, 0};
  return {state};
}

TEST(BodyTool, FeelsTheMomentumThatItGives) {
  World world(plate_and_ball("[0, -1, 0]"));
  const Vec3 set_point(0.02, 0, 0.04);
  const auto momenta = [&] { return world.body(0).momenta(); };
  const Momenta before = momenta();
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  for (std::uint64_t n = 1; n <= 60; ++n) {
    world.frame(hand_at(Vec3::Zero(), n));
    linear += world.frame_seconds() * world.tool(0).raw_wrench().force;
    angular += world.frame_seconds() * world.tool(0).raw_wrench().moment;
  }
  const Momenta after = momenta();
  const Vec3 given = -(after.linear - before.linear);
  EXPECT_LT(given.y(), -0.5 * before.linear.norm()) << "it bounced off";
  EXPECT_LT((linear - given).norm(), 1e-9 * given.norm());
  const Vec3 turned =
      -((after.angular - set_point.cross(after.linear)) - (before.angular - set_point.cross(before.linear)));
  EXPECT_LT((angular - turned).norm(), 1e-6 * turned.norm());
}

TEST(BodyTool, IsLedByItsHandle) {
  World world(plate_and_ball("[0, 0, 0]"));
  const Body& plate = world.body(1).body();
  const auto positions = [&] {
    std::vector<Vec3> all;
    for (const Index cell : plate.handle) all.push_back(world.body(1).position(cell));
    return all;
  };
  const auto rest = positions();
  ASSERT_FALSE(rest.empty());
  for (std::uint64_t n = 0; n <= 50; ++n)
    world.frame(hand_at(Vec3(0, -1e-4 * static_cast<double>(n), 2e-4 * static_cast<double>(n)), n + 1));
  const auto moved = positions();
  for (std::size_t n = 0; n < rest.size(); ++n)
    EXPECT_LT((moved[n] - rest[n] - Vec3(0, -0.005, 0.01)).norm(), 1e-9);
  EXPECT_EQ(world.tool(0).raw_wrench().force, Vec3::Zero()) << "nothing was hit";
}

TEST(BodyTool, HoldsStillWhenTheHandFallsSilent) {
  World world(plate_and_ball("[0, 0, 0]"));
  const Body& plate = world.body(1).body();
  for (std::uint64_t n = 0; n <= 20; ++n)
    world.frame(hand_at(Vec3(0, 0, 1e-4 * static_cast<double>(n)), n + 1));
  const Vec3 held = world.body(1).position(plate.handle[0]);
  for (int n = 0; n < 20; ++n) world.frame({});
  EXPECT_LT((world.body(1).position(plate.handle[0]) - held).norm(), 1e-9);
}

}  // namespace
}  // namespace palpate::physics
