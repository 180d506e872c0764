// The driver "forcedimension" against a stand-in for libdhd that notes every breach of the vendor's rules.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "tests/support/devices/stub_dhd.h"
#include "tests/unit/haptic_node/drivers/opened_driver.h"
#include "tests/unit/haptic_node/drivers/stub_library.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

using palpate::test::StubDhd;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::map<std::string, std::string> with_stub{{"library", STUB_DHD}};

class ForceDimension : public testing::Test {
 protected:
  ForceDimension() : dhd(stub_library<StubDhd>(STUB_DHD, "stub_dhd")) { dhd.reset(); }
  ~ForceDimension() override { EXPECT_THAT(dhd.breaches(), IsEmpty()); }
  StubDhd& dhd;
};

void bring_up(DriverUnderTest& driver, const std::string& id = "") {
  ASSERT_EQ(driver.open(with_stub, id), HDEV_OK) << driver.api().last_error(nullptr);
  ASSERT_EQ(driver.calibrate(), HDEV_OK);
  ASSERT_EQ(driver.power(true), HDEV_OK) << driver.last_error();
  ASSERT_EQ(driver.read(), HDEV_OK);
  ASSERT_EQ(driver.state.force_enabled, 1u);
}

TEST_F(ForceDimension, MeasuresEveryAxisThatTheModelHas) {
  auto& device = dhd.device(0);
  device.type = 35;  // omega.7
  device.position = {0.01, -0.02, 0.03};
  device.frame = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  device.velocity = {0.1, 0, -0.2};
  device.angular_velocity = {0, 0, 3};
  device.buttons = 1;
  DriverUnderTest driver("forcedimension");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK) << driver.api().last_error(nullptr);
  ASSERT_EQ(driver.read(), HDEV_OK);
  const hdev_state& s = driver.state;
  EXPECT_THAT(s.pos, ElementsAre(0.01, -0.02, 0.03));
  EXPECT_THAT(s.R, ElementsAre(0, -1, 0, 1, 0, 0, 0, 0, 1));
  EXPECT_THAT(s.vel, ElementsAre(0.1, 0, -0.2));
  EXPECT_EQ(s.angvel[2], 3);
  EXPECT_EQ(s.grip, 0.01);
  EXPECT_EQ(s.buttons, 1u);
  EXPECT_EQ(s.t_ns, driver.now.load());
  EXPECT_EQ(driver.info().dof_in, 7u);
  EXPECT_STREQ(driver.info().serial, "40123");
  EXPECT_STREQ(driver.info().sdk_version, "3.17.5.0");
}

TEST_F(ForceDimension, ArmsTheDevicesOwnWatchdogAndLimits) {
  DriverUnderTest driver("forcedimension");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  const hdev_info info = driver.info();
  EXPECT_EQ(dhd.device(0).watchdog, 240);
  EXPECT_NEAR(info.hw_watchdog_s, 0.030, 1e-12);
  EXPECT_NE(info.caps & HDEV_CAP_HW_WATCHDOG, 0u);
  EXPECT_EQ(dhd.device(0).max_force, 12);
  EXPECT_TRUE(dhd.device(0).gravity);
  driver.close();
  dhd.reset();
  dhd.device(0).has_watchdog = false;
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  EXPECT_EQ(driver.info().caps & HDEV_CAP_HW_WATCHDOG, 0u);
  EXPECT_THAT(driver.log, HasSubstr("takes no watchdog: feature not available"));
}

TEST_F(ForceDimension, TakesPositiveAnswersForGood) {
  DriverUnderTest driver("forcedimension");
  bring_up(driver);
  dhd.device(0).measure_answer = 1;  // DHD_TIMEGUARD
  EXPECT_EQ(driver.read(), HDEV_OK);
  EXPECT_EQ(driver.write(0, 0, 11), HDEV_OK);  // answered with DHD_MOTOR_SATURATED
  EXPECT_EQ(dhd.device(0).effort[2], 11);
  EXPECT_EQ(driver.write(0, 30, 40), HDEV_OK);
  EXPECT_NEAR(dhd.device(0).effort[1], 12 * 0.6, 1e-12);
  EXPECT_NEAR(dhd.device(0).effort[2], 12 * 0.8, 1e-12);
}

TEST_F(ForceDimension, SwitchesForcesWithZeroAndClosesWithZero) {
  DriverUnderTest driver("forcedimension");
  bring_up(driver);
  driver.write(1, 2, 3);
  driver.close();
  EXPECT_THAT(dhd.calls(), ElementsAre("open 0", "forces on 0", "forces off 0", "close 0"));
  EXPECT_TRUE(dhd.device(0).stopped);
}

TEST_F(ForceDimension, StopsFromAnyThread) {
  DriverUnderTest driver("forcedimension");
  bring_up(driver);
  driver.write(1, 2, 3);
  std::thread([&] { driver.stop(); }).join();
  EXPECT_TRUE(dhd.stop_comes(0));
  const int forces = dhd.device(0).forces_set;
  EXPECT_EQ(driver.write(1, 2, 3), HDEV_OK);
  EXPECT_EQ(dhd.device(0).forces_set, forces) << "no force until they are switched on again";
  EXPECT_EQ(driver.power(true), HDEV_OK);
  EXPECT_EQ(driver.write(1, 2, 3), HDEV_OK);
  EXPECT_EQ(dhd.device(0).effort[2], 3);
}

TEST_F(ForceDimension, WaitsForTheCalibration) {
  dhd.device(0).resetting = true;
  DriverUnderTest driver("forcedimension");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  EXPECT_EQ(driver.calibrate(10), HDEV_E_NOTCAL);
  EXPECT_THAT(driver.last_error(), HasSubstr("lead the handle to its reference position"));
  EXPECT_EQ(driver.power(true), HDEV_E_NOTCAL);
  dhd.device(0).resetting = false;
  dhd.device(0).wrist = true;
  EXPECT_EQ(driver.calibrate(10), HDEV_E_NOTCAL) << "the wrist is not ready";
  dhd.device(0).wrist_ready = true;
  EXPECT_EQ(driver.calibrate(10), HDEV_OK);
}

TEST_F(ForceDimension, SaysWhyTheDeviceLetGo) {
  const std::pair<int, std::uint32_t> causes[] = {
      {1, HDEV_FAULT_ESTOP}, {2, HDEV_FAULT_OVERSPEED}, {3, HDEV_FAULT_WATCHDOG}, {6, HDEV_FAULT_DEADMAN}};
  for (const auto& [cause, fault] : causes) {
    dhd.reset();
    DriverUnderTest driver("forcedimension");
    bring_up(driver);
    dhd.device(0).force_on = false;
    dhd.device(0).force_off_cause = cause;
    EXPECT_EQ(driver.read(), HDEV_E_FAULT) << cause;
    EXPECT_EQ(driver.state.fault, fault) << cause;
    EXPECT_THAT(driver.last_error(), HasSubstr("forces off by the")) << cause;
  }
  dhd.reset();
  DriverUnderTest driver("forcedimension");
  bring_up(driver);
  dhd.device(0).error = true;
  EXPECT_EQ(driver.read(), HDEV_E_FAULT);
  EXPECT_EQ(driver.state.fault, static_cast<std::uint32_t>(HDEV_FAULT_INTERNAL));
  dhd.device(0).powered = false;
  EXPECT_EQ(driver.read(), HDEV_E_FAULT);
  EXPECT_EQ(driver.state.fault, static_cast<std::uint32_t>(HDEV_FAULT_POWER));
}

/// Without a cause, or with that of its own software: some models do so when they get warm.
TEST_F(ForceDimension, NoticesForcesThatTheDeviceSwitchedOffByItself) {
  for (const int cause : {0, 4}) {
    dhd.reset();
    DriverUnderTest driver("forcedimension");
    bring_up(driver);
    dhd.device(0).force_on = false;
    dhd.device(0).force_off_cause = cause;
    int reads = 0;
    hdev_status status = HDEV_OK;
    for (; reads < 200 && status == HDEV_OK; ++reads) status = driver.read();
    EXPECT_EQ(status, HDEV_E_FAULT) << cause;
    EXPECT_EQ(reads, 50) << cause;
    EXPECT_EQ(driver.state.fault, std::uint32_t{HDEV_FAULT_FORCE_OFF}) << cause;
    EXPECT_THAT(driver.last_error(), HasSubstr("does not say why")) << cause;
  }
}

/// What libdhd said in the thread that failed; it keeps its last error for each thread.
TEST_F(ForceDimension, HandsOutTheWordsOfTheThreadThatFailed) {
  DriverUnderTest driver("forcedimension");
  bring_up(driver);
  std::thread loop([&] {
    dhd.device(0).connected = false;
    driver.write(1, 0, 0);
  });
  loop.join();
  EXPECT_THAT(driver.last_error(), HasSubstr("communication error"));
  EXPECT_EQ(driver.read(), HDEV_E_LOST);
  EXPECT_THAT(driver.last_error(), HasSubstr("unplugged: not connected"));
}

TEST_F(ForceDimension, SurvivesAFailedTransferAndGivesUpAnUnpluggedDevice) {
  DriverUnderTest driver("forcedimension");
  bring_up(driver);
  dhd.device(0).measure_answer = -1;
  EXPECT_EQ(driver.read(), HDEV_E_COMM);
  dhd.device(0).measure_answer = 0;
  EXPECT_EQ(driver.read(), HDEV_OK);
  dhd.device(0).connected = false;
  EXPECT_EQ(driver.read(), HDEV_E_LOST);
  dhd.device(0).connected = true;
  const int forces = dhd.device(0).forces_set;
  EXPECT_EQ(driver.write(1, 0, 0), HDEV_E_LOST);
  EXPECT_EQ(driver.read(), HDEV_E_LOST) << "only close() from here";
  EXPECT_EQ(driver.power(true), HDEV_E_LOST);
  EXPECT_EQ(dhd.device(0).forces_set, forces);
  dhd.device(0).connected = false;
}

TEST_F(ForceDimension, DrivesTwoDevicesApart) {
  DriverUnderTest right("forcedimension"), left("forcedimension");
  bring_up(right);
  EXPECT_EQ(left.open(with_stub), HDEV_E_NODEV);
  EXPECT_THAT(left.api().last_error(nullptr), HasSubstr("device already in use; plug it in"));
  bring_up(left, "1");
  right.write(1, 0, 0);
  left.write(0, 2, 0);
  EXPECT_EQ(dhd.device(0).effort[0], 1);
  EXPECT_EQ(dhd.device(1).effort[1], 2);
  right.close();
  EXPECT_TRUE(dhd.device(1).force_on);
}

TEST_F(ForceDimension, OpensAndClosesAThousandTimes) {
  DriverUnderTest driver("forcedimension");
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(driver.open(with_stub), HDEV_OK) << "time " << i << ": " << driver.api().last_error(nullptr);
    driver.close();
  }
}

TEST_F(ForceDimension, IsFeltThroughAScene) {
  Scene scene = scene_with(HandModel::rigid, {}, 1000);
  scene.tools[0].damping = 0;
  scene.devices[0].driver = "forcedimension";
  scene.devices[0].options = {{"library", STUB_DHD}};
  auto& device = dhd.device(0);
  device.position[2] = 0.005;
  {
    VirtualWorld world(scene);
    world.run(1.5, 500, [&] {
      if (world.session.state() == HapticState::run)
        device.position[2] = std::max(device.position[2] - 20e-6, -0.002);
    });
    EXPECT_EQ(world.session.state(), HapticState::run);
    EXPECT_NEAR(device.effort[2], 2.0, 1e-3);
    // the device lets go: the fault stays, and its motors are stopped
    device.force_on = false;
    device.force_off_cause = 2;
    world.run(0.01, 500);
    EXPECT_EQ(world.session.state(), HapticState::fault);
    EXPECT_TRUE(dhd.stop_comes(0));
  }
  EXPECT_FALSE(device.open);
}

TEST(ForceDimensionWithout, SaysWhatIsMissingAndWhereItLooked) {
  DriverUnderTest driver("forcedimension");
  EXPECT_EQ(driver.open({{"library", "/no/such/libdhd.so"}}), HDEV_E_SDK);
  EXPECT_THAT(driver.api().last_error(nullptr),
              HasSubstr("/no/such/libdhd.so: cannot open shared object file"));
  EXPECT_EQ(driver.open({{"library", STUB_DHD_OLD}}), HDEV_E_SDK);
  EXPECT_THAT(driver.api().last_error(nullptr), HasSubstr("lacks dhdSetWatchdog()"));
}

}  // namespace
}  // namespace palpate::haptic::test
