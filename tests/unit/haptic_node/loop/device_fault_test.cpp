// What the hand feels when the device is unplugged, stopped by a switch, let go of, or left alone: in simulated time,
// with every call to the driver written down.

#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>

#include "common/scene/device_spec.h"
#include "tests/unit/haptic_node/loop/watched_world.h"

namespace palpate::haptic::test {
namespace {

/// In 0.3 s from 20 mm above to 4 mm inside, from 1.5 s on out again.
std::vector<Waypoint> in_and_out() {
  return {{0, {0, 0, 0.02}},
          {0.3, {0, 0, -0.004}},
          {1.5, {0, 0, -0.004}},
          {1.7, {0, 0, 0.01}},
          {1.9, {0, 0, -0.004}}};
}

TEST(DeviceFault, UnpluggedInContactFaultsInOneTickAndIsOnlyClosed) {
  WatchedWorld world(scene_with(HandModel::rigid, in_and_out()));
  world.run(1000);
  ASSERT_NEAR(world.fz(), 1.6, 1e-3);
  const std::uint64_t writes = world.file->writes;
  world.file->unplugged = 1;
  world.tick();
  EXPECT_EQ(world.session->state(), HapticState::fault);
  EXPECT_EQ(world.fz(), 0.0);
  world.run(500);
  world.session->stop_motors();  // as the watchdog would
  EXPECT_EQ(world.file->writes, writes);
  world.session->close();
  world.session->close();
  EXPECT_EQ(world.file->closed, 1u);
  EXPECT_EQ(world.file->after_lost, 0u);
}

TEST(DeviceFault, OpenedAnewItForcesOnlyAfterTheToolHasLeft) {
  WatchedWorld world(
      scene_with(HandModel::rigid, {{0, {0, 0, -0.004}}, {0.1, {0, 0, -0.004}}, {0.4, {0, 0, 0.01}}}));
  world.patch = flat_patch(1, -0.02);
  world.run(100);
  world.patch = flat_patch(1000);  // the tissue has come up while the device is away
  world.file->unplugged = 1;
  world.run(5);
  const std::uint64_t ticks = world.session->counts().ticks;
  world.file->unplugged = 0;
  world.replug();
  EXPECT_EQ(world.file->calibrated, 2u);
  world.run(50, [&] { ASSERT_EQ(world.fz(), 0.0); });
  EXPECT_EQ(world.session->state(), HapticState::ready);
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::inside);
  EXPECT_EQ(world.file->enabled, 1u) << "motors of the old device only";
  EXPECT_EQ(world.session->counts().ticks, ticks + 50) << "ticks go on";
  EXPECT_EQ(world.session->counts().faults, 1u);
  world.patch = flat_patch(2000, -0.02);
  world.run(50);
  EXPECT_EQ(world.session->state(), HapticState::run);
}

/// 1000 times into contact, out of the socket, and back; memory must not grow.
TEST(DeviceFault, BearsAThousandUnplugs) {
  WatchedWorld world(
      scene_with(HandModel::rigid, {{0, {0, 0, 0.004}}, {0.03, {0, 0, 0.003}}, {0.06, {0, 0, -0.002}}}));
  std::size_t warm = 0;
  for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
    world.run(100);
    ASSERT_GT(world.fz(), 0.01) << cycle;
    world.file->unplugged = 1;
    world.tick();
    ASSERT_EQ(world.session->state(), HapticState::fault) << cycle;
    world.run(3);
    world.file->unplugged = 0;
    world.replug();
    ASSERT_EQ(world.session->counts().faults, cycle);
    if (cycle == 100) warm = mallinfo2().uordblks;
  }
  EXPECT_EQ(world.file->closed, 1000u);
  EXPECT_EQ(world.file->opened, 1001u);
  EXPECT_EQ(world.file->after_lost, 0u);
  // Why: less than the smallest block a cycle, 32 bytes, and more than the buffer of a stream that is used late.
  EXPECT_LT(mallinfo2().uordblks, warm + 16384);
}

TEST(DeviceFault, AnEmergencyStopIsLatchedInOneTick) {
  WatchedWorld world(scene_with(HandModel::rigid, in_and_out()));
  world.run(1000);
  world.file->estop = 1;
  world.tick();
  EXPECT_EQ(world.fz(), 0.0);
  EXPECT_EQ(world.file->stops, 1u);
  EXPECT_EQ(world.file->powered, 0u);
  world.file->estop = 0;
  world.run(1000, [&] { ASSERT_EQ(world.fz(), 0.0); });
  EXPECT_EQ(world.session->state(), HapticState::fault);
  EXPECT_EQ(world.file->powered, 0u);
}

struct Trouble {
  const char* name;
  void (*begin)(palpate::test::WatchedDevice&);
  FaultCause cause;
  int ticks;  // at most
};

TEST(DeviceFault, EachCauseIsNamedOnceAndLatched) {
  const Trouble troubles[] = {
      {"unplugged", [](auto& device) { device.unplugged = 1; }, FaultCause::lost, 1},
      {"button", [](auto& device) { device.estop = 1; }, FaultCause::emergency_stop, 1},
      {"not a number", [](auto& device) { device.nonsense = 1; }, FaultCause::impossible, 3},
      {"too warm", [](auto& device) { device.temperature = 1.0; }, FaultCause::overtemp, 1},
      {"forces off", [](auto& device) { device.dropped = 1; }, FaultCause::force_off, 1},
  };
  for (const Trouble& trouble : troubles) {
    WatchedWorld world(scene_with(HandModel::rigid, in_and_out()));
    world.run(1000);
    ASSERT_GT(world.fz(), 1.0) << trouble.name;
    ASSERT_EQ(world.session->fault_cause(), FaultCause::none) << trouble.name;
    trouble.begin(*world.file);
    world.run(trouble.ticks);
    EXPECT_EQ(world.session->state(), HapticState::fault) << trouble.name;
    EXPECT_EQ(world.session->fault_cause(), trouble.cause) << trouble.name;
    EXPECT_EQ(world.fz(), 0.0) << trouble.name;
    // The trouble is over: the cause stays, no force comes back, wherever the hand goes.
    new (&*world.file) palpate::test::WatchedDevice;
    world.run(2000, [&] { ASSERT_EQ(world.fz(), 0.0) << trouble.name; });
    EXPECT_EQ(world.session->fault_cause(), trouble.cause) << trouble.name;
    EXPECT_EQ(world.file->powered, 0u) << trouble.name;
  }
}

/// What the host itself switches off, or a hand that lets go, is no fault of the device.
TEST(DeviceFault, MotorsThatWereAskedToStopAreNoFault) {
  WatchedWorld world(scene_with(HandModel::rigid, in_and_out()));
  world.run(1000);
  world.session->stop_motors();
  world.file->dropped = 1;
  world.run(50);
  world.file->dropped = 0;
  world.run(2000);
  EXPECT_EQ(world.session->counts().faults, 0u);
  EXPECT_EQ(world.session->state(), HapticState::run);
}

TEST(DeviceFault, WarmMotorsGetLessForceAndNoneBeforeTheirLimit) {
  WatchedWorld world(scene_with(HandModel::rigid, {{0, {0, 0, 0.02}},
                                                   {0.3, {0, 0, -0.004}},
                                                   {3, {0, 0, -0.004}},
                                                   {3.2, {0, 0, 0.01}},
                                                   {4.2, {0, 0, 0.01}},
                                                   {4.4, {0, 0, -0.004}}}));
  world.file->temperature = 0.5;
  world.run(1000);
  const double cold = world.fz();
  ASSERT_NEAR(cold, 1.6, 1e-3);
  double last = cold;
  const auto never_rises = [&] {
    ASSERT_LE(world.fz(), last + 1e-9);
    ASSERT_GE(world.fz(), last - cold * 1e-3 / ThermalLimit::fall - 1e-9)
        << "no drop from one tick to the next";
    last = world.fz();
  };
  world.file->temperature = 0.875;
  world.run(200, never_rises);
  EXPECT_NEAR(world.fz(), 0.5 * cold, 1e-3);
  EXPECT_NEAR(world.session->controller().thermal_gain(), 0.5, 1e-9);
  world.file->temperature = 0.96;
  world.run(200, never_rises);
  EXPECT_EQ(world.fz(), 0.0);
  EXPECT_EQ(world.session->state(), HapticState::run) << "no fault below the limit";
  world.file->temperature = 0.5;  // cooled down while pressed in: nothing comes from below the hand
  world.run(1000, never_rises);
  EXPECT_EQ(world.fz(), 0.0);
  world.run(3000);  // it has been outside
  EXPECT_NEAR(world.fz(), cold, 1e-2);
  EXPECT_NEAR(world.session->counts().temperature_max, 0.96, 1e-12);
}

TEST(DeviceFault, ATemperatureThatIsNoNumberChangesNothing) {
  WatchedWorld world(scene_with(HandModel::rigid, in_and_out()));
  world.run(1000);
  world.file->temperature = std::nan("");
  world.run(100);
  EXPECT_NEAR(world.fz(), 1.6, 1e-3);
}

TEST(DeviceFault, WhoLetsGoFeelsNothingUntilHeldAgainOutside) {
  WatchedWorld world(scene_with(HandModel::rigid, in_and_out()));
  world.run(1000);
  ASSERT_GT(world.fz(), 1.0);
  world.file->let_go = 1;
  world.tick();
  EXPECT_EQ(world.fz(), 0.0);
  world.run(200, [&] { ASSERT_EQ(world.fz(), 0.0); });
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::not_held);
  world.file->let_go = 0;
  world.run(200, [&] { ASSERT_EQ(world.fz(), 0.0); });
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::inside);
  world.run(900);
  EXPECT_EQ(world.session->state(), HapticState::run) << "it has been outside in between";
  EXPECT_GT(world.fz(), 1.0);
}

/// 5 ms: as if nothing had been. 25 ms: the device still forces, the force is ramped down. 50 and 500 ms: the device has
/// let go by its own watchdog of 30 ms and is not pushed back at once.
TEST(DeviceFault, AStallEndsWithoutAKick) {
  for (const int stall_ms : {5, 25, 50, 500}) {
    WatchedWorld world(scene_with(HandModel::rigid, {{0, {0, 0, 0.02}}, {0.3, {0, 0, -0.004}}}));
    world.run(1200);
    ASSERT_NEAR(world.fz(), 1.6, 1e-3);
    world.now += stall_ms * 1'000'000;
    const std::uint64_t first = world.file->writes;
    world.run(1500);
    double last = stall_ms > 30 ? 0.0 : 1.6;  // what the hand feels at the end of the stall
    for (std::uint64_t n = first; n < world.file->writes; ++n) {
      const double force = world.file->at(n).norm;
      ASSERT_LE(force - last, 0.1 + 1e-9) << stall_ms << " ms, write " << n - first;
      last = force;
    }
    EXPECT_EQ(world.file->at(first).felt, stall_ms > 30 ? 0.0 : world.file->at(first - 1).norm) << stall_ms;
    EXPECT_NEAR(world.fz(), 1.6, 0.02) << stall_ms;
    EXPECT_EQ(world.session->counts().safe_events, stall_ms > 20 ? 1u : 0u);
  }
}

/// Held 2 mm deep, the hand of no mass feels the gain alone.
TEST(DeviceFault, ForcesComeOverHalfASecondAfterArming) {
  WatchedWorld world(
      scene_with(HandModel::rigid, {{0, {0, 0, 0.001}}, {0.01, {0, 0, -0.0005}}, {0.02, {0, 0, -0.002}}}));
  world.run(20);
  ASSERT_EQ(world.session->state(), HapticState::run);
  double last = 0;
  bool early = true;
  for (int i = 0; i < 600; ++i) {
    world.tick();
    const double gain = std::abs(world.fz()) / 0.8;
    if (i < 400) early = early && gain < 0.9;
    ASSERT_LE(std::abs(world.fz()), last + 0.1);
    last = std::abs(world.fz());
  }
  EXPECT_TRUE(early);
}

TEST(DeviceFault, SaysWhyItDoesNotArm) {
  WatchedWorld world(scene_with(HandModel::rigid, {{0, {0, 0, -0.004}}, {1, {0, 0, -0.004}}}));
  world.session->tick(nullptr);
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::no_patch);
  world.tick();
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::inside);
  world.file->let_go = 1;
  world.tick();
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::not_held);
  world.file->let_go = 0;
  world.patch = flat_patch(1000, -0.02);
  world.tick();
  EXPECT_EQ(world.session->controller().refusal(), ArmRefusal::none);
  EXPECT_EQ(world.session->state(), HapticState::armed);
}

}  // namespace
}  // namespace palpate::haptic::test
