// The driver "openhaptics" against a stand-in for libHD that notes every breach of the vendor's rules.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "tests/support/devices/stub_hd.h"
#include "tests/unit/haptic_node/drivers/opened_driver.h"
#include "tests/unit/haptic_node/drivers/stub_library.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

using palpate::test::StubHd;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::map<std::string, std::string> with_stub{{"library", STUB_HD}};

class OpenHaptics : public testing::Test {
 protected:
  OpenHaptics() : hd(stub_library<StubHd>(STUB_HD, "stub_hd")) { hd.reset(); }
  ~OpenHaptics() override { EXPECT_THAT(hd.breaches(), IsEmpty()); }
  StubHd& hd;
};

/// Opened, calibrated, forces on.
void bring_up(DriverUnderTest& driver, StubHd& hd) {
  ASSERT_EQ(driver.open(with_stub), HDEV_OK) << driver.api().last_error(nullptr);
  ASSERT_EQ(driver.calibrate(), HDEV_OK);
  ASSERT_EQ(driver.power(true), HDEV_OK);
  hd.tick(1);
  ASSERT_EQ(driver.read(), HDEV_OK);
  ASSERT_EQ(driver.state.force_enabled, 1u);
}

TEST_F(OpenHaptics, MeasuresInSiUnitsAndTurnsColumnsIntoRows) {
  auto& device = hd.device(0);
  device.transform = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, -20, 30, 1};  // a quarter turn about z
  device.velocity = {100, 0, -50};
  device.angular_velocity = {0, 0, 2};
  device.buttons = 5;
  device.temperature = 0.75;
  DriverUnderTest driver("openhaptics");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK) << driver.api().last_error(nullptr);
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN) << "no tick of the scheduler yet";
  driver.now += 3'000'000;
  hd.tick(1);
  ASSERT_EQ(driver.read(), HDEV_OK);
  const hdev_state& s = driver.state;
  EXPECT_EQ(s.t_ns, driver.now.load());
  EXPECT_NEAR(s.pos[0], 0.010, 1e-15);
  EXPECT_NEAR(s.pos[1], -0.020, 1e-15);
  EXPECT_NEAR(s.pos[2], 0.030, 1e-15);
  EXPECT_THAT(s.R, ElementsAre(0, -1, 0, 1, 0, 0, 0, 0, 1));
  EXPECT_NEAR(s.vel[0], 0.1, 1e-15);
  EXPECT_NEAR(s.vel[2], -0.05, 1e-15);
  EXPECT_EQ(s.angvel[2], 2);
  EXPECT_EQ(s.buttons, 5u);
  EXPECT_EQ(s.temperature, 0.75);
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN) << "the same frame again";
}

TEST_F(OpenHaptics, SaysWhatTheDeviceIs) {
  DriverUnderTest driver("openhaptics");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  const hdev_info info = driver.info();
  EXPECT_STREQ(info.model, "Stub");
  EXPECT_NEAR(info.max_force, 3.3, 1e-12);
  EXPECT_NEAR(info.cont_force, 0.88, 1e-12);
  EXPECT_NEAR(info.max_stiffness, 500, 1e-9);
  EXPECT_NEAR(info.ws_min[0], -0.210, 1e-12);
  EXPECT_NEAR(info.ws_max[2], 0.130, 1e-12);
  EXPECT_EQ(info.caps & HDEV_CAP_TORQUE, 0u);
}

TEST_F(OpenHaptics, FeelsAForceInTheNextFrameAndZeroBeforeTheMotorsGoOff) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  EXPECT_EQ(driver.write(1, -2, 0.5), HDEV_OK);
  hd.tick(1);
  EXPECT_THAT(hd.device(0).force, ElementsAre(1, -2, 0.5));
  EXPECT_EQ(driver.write(30, 0, 40), HDEV_OK);  // the direction stays, the length is the device's
  hd.tick(1);
  EXPECT_NEAR(hd.device(0).force[0], 3.3 * 0.6, 1e-12);
  EXPECT_NEAR(hd.device(0).force[2], 3.3 * 0.8, 1e-12);
  EXPECT_EQ(driver.write(std::nan(""), 0, 0), HDEV_E_ARG);
  driver.close();
  EXPECT_THAT(hd.calls(), ElementsAre("init Default PHANToM", "forces on", "forces off", "disable device 0"));
  EXPECT_THAT(hd.device(0).force, ElementsAre(0, 0, 0));
}

TEST_F(OpenHaptics, StopsFromAnyThreadWithinOneFrame) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  driver.write(1, 0, 0);
  hd.tick(1);
  std::thread([&] { driver.stop(); }).join();
  driver.write(1, 0, 0);
  hd.tick(1);
  EXPECT_FALSE(hd.device(0).force_on);
  EXPECT_THAT(hd.device(0).force, ElementsAre(0, 0, 0));
  driver.read();
  EXPECT_EQ(driver.state.force_enabled, 0u);
}

TEST_F(OpenHaptics, DropsTheForceWhenTheHostFallsSilent) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  driver.write(1, 0, 0);
  driver.now += 20'000'000;
  hd.tick(1);
  EXPECT_EQ(hd.device(0).force[0], 1);
  driver.now += 1;
  hd.tick(1);
  EXPECT_EQ(hd.device(0).force[0], 0);
}

TEST_F(OpenHaptics, CalibratesBeforeItEnables) {
  auto& device = hd.device(0);
  device.calibration = 0x5001;
  device.calibration_style = 1 | 2 | 4;  // it knows all; the automatic one is taken
  DriverUnderTest driver("openhaptics");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  EXPECT_EQ(driver.power(true), HDEV_E_NOTCAL);
  EXPECT_THAT(driver.last_error(), HasSubstr("until the device is calibrated"));
  EXPECT_EQ(driver.calibrate(), HDEV_OK);
  EXPECT_EQ(driver.power(true), HDEV_OK);
  hd.tick(1);
  EXPECT_TRUE(device.force_on);
  EXPECT_THAT(hd.calls(), ElementsAre("init Default PHANToM", "update calibration 2", "forces on"));
}

TEST_F(OpenHaptics, TellsThePersonWhatCalibrationNeeds) {
  hd.device(0).calibration = 0x5002;
  hd.device(0).calibration_style = 4;
  DriverUnderTest driver("openhaptics");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  EXPECT_EQ(driver.calibrate(20), HDEV_E_NOTCAL);
  EXPECT_THAT(driver.last_error(), HasSubstr("put the pen into the inkwell"));
  EXPECT_THAT(driver.log, HasSubstr("put the pen into the inkwell"));
  hd.tick(1);
  ASSERT_EQ(driver.read(), HDEV_OK);
  EXPECT_EQ(driver.state.cal, static_cast<std::uint32_t>(HDEV_CAL_NEEDS_USER));
}

TEST_F(OpenHaptics, CallsEveryErrorOfTheVendorByItsName) {
  struct Case {
    unsigned int code;
    std::uint32_t fault;
  };
  const Case cases[] = {
      {0x0200, HDEV_FAULT_OVERTEMP},  {0x0201, HDEV_FAULT_OVERFORCE}, {0x0202, HDEV_FAULT_OVERFORCE},
      {0x0203, HDEV_FAULT_OVERSPEED}, {0x0204, HDEV_FAULT_INTERNAL},  {0x0300, HDEV_FAULT_POWER},
      {0x0303, HDEV_FAULT_INTERNAL},  {0x0304, HDEV_FAULT_INTERNAL},  {0x0100, HDEV_FAULT_INTERNAL},
      {0x0101, HDEV_FAULT_INTERNAL},  {0x0102, HDEV_FAULT_INTERNAL},  {0x0103, HDEV_FAULT_INTERNAL},
      {0x0104, HDEV_FAULT_INTERNAL},  {0x0400, HDEV_FAULT_INTERNAL},  {0x0401, HDEV_FAULT_INTERNAL},
      {0x0402, HDEV_FAULT_INTERNAL},  {0x0500, HDEV_FAULT_INTERNAL},  {0x0501, HDEV_FAULT_INTERNAL},
      {0x0600, HDEV_FAULT_INTERNAL}};
  for (const Case& one : cases) {
    DriverUnderTest driver("openhaptics");
    bring_up(driver, hd);
    driver.write(1, 0, 0);
    hd.raise(0, one.code);
    hd.tick(1);
    EXPECT_EQ(driver.read(), HDEV_E_FAULT) << std::hex << one.code;
    EXPECT_EQ(driver.state.fault, one.fault) << std::hex << one.code;
    hd.tick(1);
    EXPECT_FALSE(hd.device(0).force_on) << std::hex << one.code;
    EXPECT_THAT(driver.last_error(), HasSubstr("(0x0"));
  }
}

TEST_F(OpenHaptics, SurvivesAFailedTransferAndGivesUpAnUnpluggedDevice) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  hd.device(0).unplugged = true;
  hd.tick(1);
  EXPECT_EQ(driver.read(), HDEV_E_COMM);
  hd.device(0).unplugged = false;
  hd.tick(1);
  EXPECT_EQ(driver.read(), HDEV_OK);

  hd.device(0).unplugged = true;
  hd.tick(20);
  EXPECT_EQ(driver.read(), HDEV_E_LOST);
  const int frames = hd.device(0).frames;
  EXPECT_EQ(driver.write(1, 0, 0), HDEV_E_LOST);
  hd.tick(5);
  EXPECT_EQ(hd.device(0).frames, frames) << "nothing more is said to it";
  EXPECT_EQ(driver.power(true), HDEV_E_LOST);
  EXPECT_THAT(driver.last_error(), HasSubstr("unplugged: Device communication error (0x0302)"));
}

TEST_F(OpenHaptics, NamesTheErrorThatTookTheForcesAndNotWhatCameAfter) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  hd.raise(0, 0x0200);
  hd.tick(1);
  EXPECT_EQ(driver.read(), HDEV_E_FAULT);
  hd.raise(0, 0x0302);
  hd.tick(3);
  EXPECT_THAT(driver.last_error(), HasSubstr("(0x0200)"));
}

/// As a device does that gets too warm or whose switch is let go, without an error of libHD.
TEST_F(OpenHaptics, NoticesForcesThatTheDeviceSwitchedOffByItself) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  driver.write(0.2, 0, 0);
  hd.tick(150);
  ASSERT_EQ(driver.read(), HDEV_OK);
  hd.device(0).force_on = false;
  hd.tick(20);
  EXPECT_EQ(driver.read(), HDEV_E_FAULT);
  EXPECT_EQ(driver.state.fault, std::uint32_t{HDEV_FAULT_FORCE_OFF});
  EXPECT_THAT(driver.last_error(), HasSubstr("force output is off"));
  driver.write(0.48, 0, 0);
  hd.tick(20);
  EXPECT_THAT(hd.device(0).force, ElementsAre(0, 0, 0));
  EXPECT_EQ(driver.read(), HDEV_E_FAULT) << "latched";
  EXPECT_THAT(hd.calls(), ElementsAre("init Default PHANToM", "forces on"));
}

TEST_F(OpenHaptics, DeclaresASchedulerDeadThatCallsBackNoMoreAndSwitchesOffWithoutIt) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  driver.write(1, 0, 0);
  hd.tick(1);
  ASSERT_EQ(driver.read(), HDEV_OK);
  hd.fall_silent(true);
  hdev_status status = HDEV_E_AGAIN;
  int ms = 0;
  for (; ms < 200 && status == HDEV_E_AGAIN; ++ms) {
    driver.now += 1'000'000;
    hd.tick(1);
    status = driver.read();
  }
  EXPECT_EQ(status, HDEV_E_FAULT);
  EXPECT_EQ(driver.state.fault, std::uint32_t{HDEV_FAULT_SILENT});
  EXPECT_NEAR(ms, 101, 1);
  EXPECT_THAT(driver.last_error(), HasSubstr("the scheduler of libHD has not called back for 100 ms"));
  driver.stop();
  // Closing waits for the scheduler; the motors do not.
  std::thread closing([&] { driver.close(); });
  for (int i = 0; i < 10'000 && hd.calls().back() != "forces off"; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_THAT(hd.calls(), ElementsAre("init Default PHANToM", "forces on", "forces off"));
  hd.fall_silent(false);
  closing.join();
  EXPECT_THAT(hd.device(0).force, ElementsAre(0, 0, 0));
}

/// The host was away, and the vendor's thread with it: no fault, whatever the clock says.
TEST_F(OpenHaptics, ForgivesAProcessThatWasStopped) {
  DriverUnderTest driver("openhaptics");
  bring_up(driver, hd);
  driver.now += 5'000'000'000;
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN);
  driver.now += 1'000'000;
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN);
  hd.tick(1);
  EXPECT_EQ(driver.read(), HDEV_OK);
}

TEST_F(OpenHaptics, SaysWhyADeviceDoesNotOpen) {
  DriverUnderTest driver("openhaptics"), second("openhaptics");
  EXPECT_THAT(driver.trouble(with_stub, "right"),
              HasSubstr("device \"right\" does not open: Device communication error "
                        "(0x0302, internal 21); plug it in"));
  EXPECT_THAT(driver.trouble({{"library", STUB_HD}, {"scheduler_Hz", "700"}}),
              HasSubstr("does not run at 700 Hz"));
  hd.device(0).init_error = 0x0600;
  EXPECT_EQ(driver.open(with_stub), HDEV_E_SDK);
  hd.device(0).init_error = 0;
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  EXPECT_EQ(second.open(with_stub), HDEV_E_BUSY);
  EXPECT_THAT(driver.api().last_error(nullptr), HasSubstr("another tool or program has it"));
}

TEST_F(OpenHaptics, DrivesTwoDevicesApart) {
  DriverUnderTest right("openhaptics"), left("openhaptics");
  bring_up(right, hd);
  ASSERT_EQ(left.open(with_stub, "left"), HDEV_OK) << left.api().last_error(nullptr);
  ASSERT_EQ(left.calibrate(), HDEV_OK);
  ASSERT_EQ(left.power(true), HDEV_OK);
  hd.device(1).transform[12] = 77;
  hd.tick(1);
  right.write(1, 0, 0);
  left.write_wrench({0, 2, 0, 0.05, 0, -0.1});
  hd.tick(1);
  left.read();
  right.read();
  EXPECT_NEAR(left.state.pos[0], 0.077, 1e-15);
  EXPECT_NEAR(right.state.pos[0], 0, 1e-15);
  EXPECT_THAT(hd.device(0).force, ElementsAre(1, 0, 0));
  EXPECT_THAT(hd.device(1).force, ElementsAre(0, 2, 0));
  EXPECT_NEAR(hd.device(1).torque[0], 50, 1e-9) << "mN m";
  EXPECT_NEAR(hd.device(1).torque[2], -100, 1e-9);
  left.write_wrench({0, 0, 0, 3, 0, 4});  // the stand-in objects to more than 188 mN m
  hd.tick(1);
  EXPECT_NEAR(hd.device(1).torque[2], 188 * 0.8, 1e-9);
  right.close();
  hd.tick(1);
  EXPECT_FALSE(hd.device(0).open);
  EXPECT_TRUE(hd.device(1).force_on) << "the other goes on";
}

TEST_F(OpenHaptics, OpensAndClosesAThousandTimes) {
  DriverUnderTest driver("openhaptics");
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(driver.open(with_stub), HDEV_OK) << "time " << i << ": " << driver.api().last_error(nullptr);
    driver.close();
  }
}

TEST_F(OpenHaptics, RunsUnderTheVendorsOwnThread) {
  hd.use_thread(true);
  DriverUnderTest driver("openhaptics");
  ASSERT_EQ(driver.open(with_stub), HDEV_OK);
  ASSERT_EQ(driver.calibrate(), HDEV_OK);
  ASSERT_EQ(driver.power(true), HDEV_OK);
  std::uint64_t samples = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (samples < 50 && std::chrono::steady_clock::now() < end) {
    samples += driver.read() == HDEV_OK ? 1 : 0;
    driver.write(0.5, 0, 0);
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  EXPECT_EQ(samples, 50u);
  EXPECT_EQ(driver.state.applied_force[0], 0.5);
  driver.close();
  EXPECT_THAT(hd.calls(), ElementsAre("init Default PHANToM", "forces on", "forces off", "disable device 0"));
}

/// The whole way: a scene that names the driver, a hand that presses, the force on the stand-in's motors.
TEST_F(OpenHaptics, IsFeltThroughAScene) {
  Scene scene = scene_with(HandModel::rigid, {}, 300);
  scene.tools[0].damping = 0;
  scene.devices[0].driver = "openhaptics";
  scene.devices[0].options = {{"library", STUB_HD}};
  auto& device = hd.device(0);
  device.transform[14] = 5;  // before the node looks: a hand that jumps by 5 mm is a fault
  VirtualWorld world(scene);
  double largest = 0;
  world.run(1.5, 500, [&] {
    if (world.session.state() == HapticState::run)
      device.transform[14] = std::max(device.transform[14] - 0.02, -2.0);  // 20 mm/s down to 2 mm deep
    hd.tick(1);
    largest = std::max(largest, device.force[2]);
  });
  EXPECT_EQ(world.session.state(), HapticState::run);
  EXPECT_NEAR(device.force[2], 300 * 0.002, 1e-3);
  EXPECT_LE(largest, 0.88) << "what it bears for long";
  // unplugged in contact: nothing more is written, and the fault stays
  device.unplugged = true;
  world.run(0.1, 500, [&] { hd.tick(1); });
  EXPECT_EQ(world.session.state(), HapticState::fault);
  device.unplugged = false;
  const int frames = device.frames;
  world.run(0.1, 500, [&] { hd.tick(1); });
  EXPECT_EQ(world.session.state(), HapticState::fault);
  EXPECT_EQ(device.frames, frames);
}

TEST(OpenHapticsWithout, SaysWhatIsMissingAndWhereItLooked) {
  DriverUnderTest driver("openhaptics");
  EXPECT_EQ(driver.open({{"library", "/no/such/libHD.so"}}), HDEV_E_SDK);
  const std::string none = driver.api().last_error(nullptr);
  EXPECT_THAT(none, HasSubstr("/no/such/libHD.so: cannot open shared object file"));
  EXPECT_THAT(none, HasSubstr("LD_LIBRARY_PATH"));
  EXPECT_EQ(driver.open({{"library", STUB_HD_OLD}}), HDEV_E_SDK);
  EXPECT_THAT(driver.api().last_error(nullptr), HasSubstr("lacks hdStartScheduler()"));
  EXPECT_THAT(driver.trouble({{"labrary", "x"}}),
              HasSubstr("unknown key \"labrary\"; known are library, scheduler_Hz"));
}

}  // namespace
}  // namespace palpate::haptic::test
