#include "haptic_node/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/error/error.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

TEST(HapticSession, GivesNoForceAtAllInFreeSpace) {
  VirtualWorld world(scene_with(HandModel::rigid, {{0, {0, 0, 0.02}}, {1, {0.01, 0, 0.0005}}}));
  world.run(1.5, 100, [&] { ASSERT_EQ(world.force(), 0.0); });
  EXPECT_EQ(world.session.state(), HapticState::run);
  EXPECT_EQ(world.session.trace().energy, 0.0);
}

TEST(HapticSession, PressesAPlaneWithStiffnessTimesDepth) {
  VirtualWorld world(scene_with(HandModel::rigid, press(0.002)));
  world.run(1, 150);
  EXPECT_NEAR(world.fz(), 400 * 0.002, 1e-6);
  EXPECT_NEAR(world.session.tool_state().proxy[2], 0.0, 1e-8);
}

TEST(HapticSession, PutsTissueInSeriesWithTheHandSpring) {
  VirtualWorld world(scene_with(HandModel::rigid, press(0.002)));
  world.patch = flat_patch(1, 0, 200);
  world.run(1, 150);
  const double k = 400.0 * 200.0 / 600.0;
  EXPECT_NEAR(world.fz(), k * 0.002, 1e-6);
  EXPECT_NEAR(world.session.tool_state().proxy[2], -0.002 + k * 0.002 / 400, 1e-8);
}

TEST(HapticSession, MovesAHandByForceOverItsStiffness) {
  const std::pair<HandModel, double> hands[] = {
      {HandModel::arm, 135}, {HandModel::pinch, 100}, {HandModel::firm, 700}};
  for (const auto& [hand, k_hand] : hands) {
    VirtualWorld world(scene_with(hand, press(0.003)));
    world.run(3, 150);
    EXPECT_GT(world.fz(), 0.1);
    EXPECT_NEAR(world.z() - -0.003, world.fz() / k_hand, 2e-6) << "hand of " << k_hand << " N/m";
    EXPECT_NEAR(world.fz(), 0.003 / (1.0 / 400 + 1.0 / k_hand), 2e-3) << "hand of " << k_hand << " N/m";
  }
}

TEST(HapticSession, KeepsTheLimitAndTheDirection) {
  Scene scene = scene_with(HandModel::rigid, {{0, {0, 0, 0.02}}, {0.6, {0, 0, 0.02}}, {1.1, {0, 0, -0.03}}});
  scene.devices[0].force_limit = 1.25;
  VirtualWorld world(scene);
  const double tilt = 0.3;
  for (auto& facet : world.patch.facets) facet.normal = {std::sin(tilt), 0, std::cos(tilt)};
  world.run(1.6, 150, [&] { ASSERT_LE(world.force(), 1.25 * (1 + 1e-12)); });
  EXPECT_NEAR(world.force(), 1.25, 1e-9);
  EXPECT_NEAR(std::atan2(world.session.trace().force[0], world.fz()), tilt, 1e-3);
}

TEST(HapticSession, FadesToNothingWhenPatchesStop) {
  for (const HandModel hand : {HandModel::rigid, HandModel::arm, HandModel::firm}) {
    for (const double rate : {20.0, 60.0, 150.0, 1000.0}) {
      VirtualWorld world(scene_with(hand, press(0.004)));
      world.run(2, rate);
      const double before = world.fz();
      ASSERT_GT(before, 0.3);
      double last = std::numeric_limits<double>::infinity();
      world.run(0.4, 0, [&] {
        if (world.session.state() != HapticState::stale) return;
        ASSERT_LE(world.fz(), last);
        last = world.fz();
      });
      EXPECT_EQ(world.force(), 0.0) << rate << " Hz";
      EXPECT_EQ(world.session.state(), HapticState::stale);
      EXPECT_EQ(world.session.counts().stale_events, 1u);
    }
  }
}

TEST(HapticSession, StaysSilentInsideUntilTheToolHasLeft) {
  VirtualWorld world(scene_with(HandModel::rigid, {{0, {0, 0, 0.02}},
                                                   {0.3, {0, 0, -0.004}},
                                                   {2, {0, 0, -0.004}},
                                                   {2.3, {0, 0, 0.01}},
                                                   {2.6, {0, 0, -0.002}}}));
  world.run(1, 150);
  ASSERT_GT(world.fz(), 1.0);
  world.run(0.5, 0);
  bool left = false;
  world.run(0.9, 150, [&] {
    left = left || world.z() > 0;
    if (!left) {
      ASSERT_EQ(world.force(), 0.0);
    }
  });
  world.run(0.6, 150);
  EXPECT_NEAR(world.fz(), 0.8, 1e-6);
  EXPECT_EQ(world.session.state(), HapticState::run);
}

TEST(HapticSession, GoesOnWithoutAJumpWhenPatchesReturnDuringTheFade) {
  VirtualWorld world(scene_with(HandModel::rigid, press(0.004)));
  world.run(1, 150);
  const double before = world.fz();
  world.run(0.25, 0);
  const double faded = world.fz();
  ASSERT_LT(faded, 0.7 * before);
  ASSERT_GT(faded, 0.1 * before);
  double last = faded;
  world.run(1.5, 150, [&] {
    ASSERT_LE(std::abs(world.fz() - last), 0.1 + 1e-9);
    last = world.fz();
  });
  EXPECT_NEAR(world.fz(), before, 0.01 * before);
}

TEST(HapticSession, DoesNotArmInsideTheTissue) {
  VirtualWorld world(scene_with(HandModel::rigid, {{0, {0, 0, -0.002}}, {0.5, {0, 0, 0.01}}}));
  world.run(1, 150);
  EXPECT_EQ(world.session.state(), HapticState::ready);
  EXPECT_EQ(world.session.tool_state().engaged, 0u);
  EXPECT_NEAR(world.z(), -0.002, 1e-12);  // the path has not begun
}

TEST(HapticSession, WaitsForTheFirstPatch) {
  VirtualWorld world(scene_with(HandModel::rigid, press(0.002)));
  world.run(1, 0);
  EXPECT_EQ(world.session.state(), HapticState::ready);
  EXPECT_NEAR(world.z(), 0.02, 1e-12);
  world.run(0.01, 150);
  EXPECT_EQ(world.session.state(), HapticState::run);
}

TEST(HapticSession, FeelsAStallAsAFreshStartWithoutAJump) {
  VirtualWorld world(scene_with(HandModel::rigid, press(0.004)));
  world.run(1, 1000);
  const double before = world.fz();
  world.now += 50'000'000;
  double last = before;
  bool was_safe = false;
  world.run(0.06, 1000, [&] {
    was_safe = was_safe || world.session.state() == HapticState::safe;
    ASSERT_LE(std::abs(world.fz() - last), before / 20 * 50 + 1e-9);
    last = world.fz();
  });
  EXPECT_TRUE(was_safe);
  world.run(1.5, 1000);
  EXPECT_EQ(world.session.state(), HapticState::run);
  EXPECT_NEAR(world.fz(), before, 0.01 * before);
}

TEST(HapticSession, TurnsAndScalesTheDeviceIntoTheWorld) {
  Scene scene = scene_with(HandModel::rigid, press(0.002));
  scene.devices[0].rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  scene.devices[0].scale = 2;
  scene.devices[0].offset = {0.1, -0.05, 0.2};
  VirtualWorld world(scene);
  world.run(1, 150);
  EXPECT_NEAR(world.z(), -0.002, 1e-12);
  EXPECT_NEAR(world.fz(), 0.8, 1e-6);
}

TEST(HapticSession, IsTheSameTwice) {
  const Scene scene = scene_with(HandModel::arm, press(0.003));
  VirtualWorld a(scene), b(scene);
  b.now = 7'777'000'000;
  for (int i = 0; i < 1000; ++i) {
    a.run(0.001, 150);
    b.run(0.001, 150);
    ASSERT_EQ(a.z(), b.z());
    ASSERT_EQ(a.fz(), b.fz());
  }
}

TEST(HapticSession, NamesTheSceneWhenADriverDislikesAnOption) {
  Scene scene = scene_with(HandModel::rigid, press(0.002));
  scene.devices[0].place = {"scenes/x.toml", 12, 3};
  scene.devices[0].options = {{"mas", "0.1"}};
  std::int64_t now = 0;
  try {
    HapticSession session(scene, 0, "", &read_clock, &now);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("scenes/x.toml:12:3: "), std::string::npos) << line;
    EXPECT_NE(line.find("unknown key \"mas\""), std::string::npos) << line;
  }
}

/// The device of the tests gives no torques unless it is told to.
TEST(HapticSession, FeelsThePlaneUnderAStickWhereItsDeviceHasNoTorquesAndSaysSo) {
  Scene scene = scene_with(HandModel::rigid, press(0.002));
  scene.tools[0].shape = ToolShape::stick;
  scene.tools[0].force_model = ForceModel::tangent;
  const VirtualWorld without(scene);
  EXPECT_FALSE(without.session.controller().needs_wrench());
  EXPECT_EQ(without.session.force_model().model, ForceModel::norton);
  EXPECT_FALSE(warning_of(without.session.force_model()).empty());
  scene.devices[0].options = {{"max_torque", "0.02"}, {"turn_stiffness", "0.2"}};
  const VirtualWorld with(scene);
  EXPECT_TRUE(with.session.controller().needs_wrench());
  EXPECT_EQ(with.session.force_model().model, ForceModel::tangent);
  EXPECT_TRUE(warning_of(with.session.force_model()).empty());
}

}  // namespace
}  // namespace palpate::haptic::test
