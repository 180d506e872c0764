#include "haptic_node/control/controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

/// A controller with a hand that is set by hand.
struct Bench {
  Bench() : controller(ControllerSettings{}) {
    controller.set_state(HapticState::ready);
    sample.has_new = true;
    sample.powered = true;
    sample.x = {0, 0, 0.01};
  }
  ControllerOutput tick() {
    now += 1'000'000;
    sample.t_ns = now - sample_age_ns;
    patch.tick += 1;
    return controller.tick(now, sample, &patch);
  }
  /// Until the force comes in full after arming.
  void warm_up() {
    for (int i = 0; i < 600; ++i) tick();
  }
  /// 0.2 mm a tick.
  void move_to(double z) {
    while (std::abs(sample.x.z() - z) > 1e-9) {
      sample.x.z() += std::clamp(z - sample.x.z(), -2e-4, 2e-4);
      tick();
    }
  }

  Controller controller;
  DeviceSample sample;
  ContactPatch patch = flat_patch(1);
  std::int64_t now = 1'000'000'000;
  std::int64_t sample_age_ns = 0;
};

TEST(Controller, AsksForPowerAndRunsOnceItIsThere) {
  Bench bench;
  bench.sample.powered = false;
  EXPECT_TRUE(bench.tick().want_power);
  EXPECT_EQ(bench.controller.state(), HapticState::armed);
  bench.sample.powered = true;
  bench.tick();
  EXPECT_EQ(bench.controller.state(), HapticState::run);
}

TEST(Controller, LatchesAFaultWhenTheDeviceIsLost) {
  Bench bench;
  bench.warm_up();
  bench.move_to(-0.002);
  EXPECT_GT(bench.tick().force.z(), 0.5);
  bench.sample.lost = true;
  const ControllerOutput out = bench.tick();
  EXPECT_TRUE(out.stop_motors);
  EXPECT_FALSE(out.write);
  EXPECT_EQ(out.force.norm(), 0.0);
  bench.sample.lost = false;
  for (int i = 0; i < 1000; ++i) {
    const ControllerOutput later = bench.tick();
    ASSERT_FALSE(later.write);
    ASSERT_FALSE(later.stop_motors);
  }
  EXPECT_EQ(bench.controller.state(), HapticState::fault);
  EXPECT_EQ(bench.controller.faults(), 1u);
  EXPECT_EQ(bench.controller.fault_cause(), FaultCause::lost);
}

TEST(FaultCause, HasWordsForEachAndSaysWhatAPersonDidFirst) {
  for (std::uint32_t i = 0; i < n_fault_causes; ++i) {
    const auto cause = static_cast<FaultCause>(i);
    EXPECT_EQ(i == 0, std::string(text_of(cause)).empty()) << i;
    EXPECT_EQ(i == 0, std::string(advice_of(cause)).empty()) << i;
    for (std::uint32_t j = 0; j < i; ++j)
      EXPECT_STRNE(text_of(cause), text_of(static_cast<FaultCause>(j))) << i << " and " << j;
    // "rt: fifo=yes mlock=yes; tip: fault: TEXT; ADVICE, palpate reset tip" in the note of a status
    EXPECT_LE(std::string(text_of(cause)).size() + std::string(advice_of(cause)).size(), 127u - 60u) << i;
  }
  EXPECT_EQ(cause_of(0), FaultCause::none);
  for (std::uint32_t bit = 0; bit < 32; ++bit) EXPECT_NE(cause_of(1u << bit), FaultCause::none) << bit;
  EXPECT_EQ(cause_of(HDEV_FAULT_ESTOP | HDEV_FAULT_FORCE_OFF | HDEV_FAULT_INTERNAL),
            FaultCause::emergency_stop);
}

TEST(Controller, FaultsOnFaultBits) {
  Bench bench;
  bench.tick();
  bench.sample.fault = 1;
  EXPECT_TRUE(bench.tick().stop_motors);
}

TEST(Controller, BearsTwoImpossibleSamplesButNotThree) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), 0.5}) {
    Bench bench;
    bench.tick();
    const Vec3 before = bench.sample.x;
    bench.sample.x.x() = x;
    bench.tick();
    EXPECT_TRUE(bench.tick().write);
    bench.sample.x = before;
    bench.tick();
    EXPECT_EQ(bench.controller.state(), HapticState::run);
    bench.sample.x.x() = x;
    bench.tick();
    bench.tick();
    EXPECT_EQ(bench.controller.state(), HapticState::run);
    bench.tick();
    EXPECT_EQ(bench.controller.state(), HapticState::fault);
    EXPECT_EQ(bench.controller.motion().rejected(), 5u);
  }
}

TEST(Controller, RampsDownWithinTwentyMillisecondsOnOldSamples) {
  Bench bench;
  bench.warm_up();
  bench.move_to(-0.004);
  for (int i = 0; i < 50; ++i) bench.tick();
  const double before = bench.tick().force.z();
  ASSERT_NEAR(before, 1.6, 0.05);
  bench.sample.has_new = false;
  int ticks = 0;
  while (bench.controller.state() == HapticState::run) {
    ASSERT_LE(++ticks, 25);
    bench.tick();
  }
  double last = before;
  for (int i = 0; i < 20; ++i) {
    const double f = bench.tick().force.z();
    ASSERT_LE(f, last);
    last = f;
  }
  EXPECT_EQ(last, 0.0);
}

TEST(Controller, IsSafeOnOverspeedAndComesBackOnlyFromOutside) {
  Bench bench;
  bench.sample.x.z() = 0.05;
  bench.tick();
  for (int i = 0; i < 30; ++i) bench.sample.x.z() -= 1.8e-3, bench.tick();
  EXPECT_EQ(bench.controller.safe_events(), 1u);
  ASSERT_LT(bench.sample.x.z(), -0.003);
  for (int i = 0; i < 300; ++i) ASSERT_EQ(bench.tick().force.norm(), 0.0);
  EXPECT_EQ(bench.controller.state(), HapticState::ready);
  bench.move_to(0.001);
  bench.warm_up();
  bench.move_to(-0.001);
  for (int i = 0; i < 50; ++i) bench.tick();
  EXPECT_NEAR(bench.tick().force.z(), 0.4, 1e-6);
}

TEST(Controller, AsksForPowerAgainWhenMotorsWereSwitchedOff) {
  Bench bench;
  bench.move_to(-0.002);
  bench.sample.powered = false;
  bench.tick();
  EXPECT_EQ(bench.controller.state(), HapticState::safe);
  bool asked = false;
  for (int i = 0; i < 100 && !asked; ++i) asked = bench.tick().want_power;
  ASSERT_TRUE(asked);
  bench.sample.powered = true;
  double last = 0;
  for (int i = 0; i < 500; ++i) {
    const double f = bench.tick().force.z();
    ASSERT_LE(std::abs(f - last), 0.1001);
    last = f;
  }
  EXPECT_NEAR(last, 0.8, 0.01);
}

TEST(Controller, StopsWithinTwentyMillisecondsWithoutRising) {
  Bench bench;
  bench.move_to(-0.004);
  double last = bench.tick().force.z();
  bench.controller.begin_stop();
  for (int i = 0; i < 20; ++i) {
    const double f = bench.tick().force.z();
    ASSERT_LE(f, last);
    last = f;
  }
  EXPECT_EQ(last, 0.0);
  EXPECT_TRUE(bench.controller.stopped());
}

/// A ramp that nobody hears only holds up what follows it.
TEST(Controller, StopsAtOnceWithoutARamp) {
  Bench bench;
  bench.move_to(-0.004);
  for (int i = 0; i < 100; ++i) bench.tick();
  ASSERT_GT(bench.tick().force.z(), 0.3);
  bench.controller.begin_stop(false);
  EXPECT_TRUE(bench.controller.stopped());
  EXPECT_EQ(bench.tick().force.z(), 0.0);
}

TEST(PatchWatch, WaitsThreePeriodsWithin120And200Milliseconds) {
  const std::pair<double, double> cases[] = {{1000, 0.12}, {60, 0.12}, {20, 0.15}, {11, 0.2}};
  for (const auto& [rate, patience] : cases) {
    PatchWatch watch(0);
    ContactPatch patch = flat_patch(1);
    std::int64_t now = 0;
    for (int i = 0; i < 300; ++i) {
      patch.tick += 1;
      watch.accept(&patch, now);
      now += static_cast<std::int64_t>(1e9 / rate);
    }
    EXPECT_NEAR(watch.patience(), patience, 1e-4 + 0.02 * patience) << rate << " Hz";
  }
}

TEST(PatchWatch, TakesTheNewestAndARestartButNotThePast) {
  PatchWatch watch(0);
  ContactPatch patch = flat_patch(10);
  EXPECT_TRUE(watch.accept(&patch, 0));
  EXPECT_FALSE(watch.accept(&patch, 1'000'000));
  patch.tick = 9;
  EXPECT_FALSE(watch.accept(&patch, 2'000'000));
  patch.tick = 12;
  EXPECT_TRUE(watch.accept(&patch, 3'000'000));
  patch.tick = 1;
  EXPECT_TRUE(watch.accept(&patch, 900'000'000)) << "physics has begun again";
}

TEST(ForceGuard, KeepsDirectionLimitAndStep) {
  ForceGuard guard(3.0, 400, 1e-3);
  EXPECT_NEAR(guard.jump(), 0.4, 1e-12);
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 20; ++i) {
    const Vec3 f = guard.pass({1e200, 1e200, 0}, 1, false);
    ASSERT_LE((f - last).norm(), guard.jump() * (1 + 1e-12));
    last = f;
  }
  EXPECT_NEAR(last.norm(), 3.0, 1e-12);
  EXPECT_NEAR(last.x(), last.y(), 1e-12);
}

TEST(ForceGuard, LetsAForceComeAsTheHandMovesAndATenthOfANewtonMore) {
  for (const double moved : {0.0, 5e-5, 4e-4}) {
    ForceGuard guard(3.0, 400, 1e-3);
    double last = 0;
    for (int i = 0; i < 40; ++i) {
      const double force = guard.pass({0, 0, 2.0}, 1.0, false, moved).norm();
      ASSERT_LE(force - last, 400 * moved + 0.1 + 1e-12) << moved;
      last = force;
    }
    EXPECT_NEAR(last, 2.0, 1e-12) << "it comes all the same";
    EXPECT_EQ(guard.pass(Vec3::Zero(), 1.0, false, 0.0).norm(), 0.0) << "and goes at once";
  }
}

TEST(ForceGuard, TurnsWhatIsNoForceIntoNone) {
  const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    ForceGuard guard(3.0, 400, 1e-3);
    EXPECT_EQ(guard.pass({0, value, 0}, 1, false).norm(), 0.0);
    EXPECT_EQ(guard.pass({0, 0.1, 0}, value > 0 ? 0.0 : value, false).norm(), 0.0);
  }
}

}  // namespace
}  // namespace palpate::haptic::test
