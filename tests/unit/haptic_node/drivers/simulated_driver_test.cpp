// The driver "simulated": hands and devices against closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/haptic_node/drivers/opened_driver.h"
#include "tests/unit/haptic_node/virtual_world.h"

namespace palpate::haptic::test {
namespace {

using testing::HasSubstr;
using Keys = std::map<std::string, std::string>;

/// Where the handle comes to rest under a force along x, commands coming every millisecond [m].
double rest_under(DriverUnderTest& driver, double force, int ms = 1000) {
  for (int i = 0; i < ms; ++i) {
    driver.write(force, 0, 0);
    driver.now += 1'000'000;
    EXPECT_EQ(driver.read(), HDEV_OK);
  }
  return driver.state.pos[0];
}

TEST(SimulatedDriver, GivesWayLikeTheSpringOfTheHand) {
  const std::pair<const char*, double> hands[] = {{"arm", 135}, {"pinch", 100}, {"firm", 700}};
  for (const auto& [hand, k] : hands) {
    DriverUnderTest driver("simulated");
    ASSERT_EQ(driver.open({{"hand", hand}}), HDEV_OK);
    driver.power(true);
    EXPECT_NEAR(rest_under(driver, 0.5, 3000), 0.5 / k, 1e-6) << hand;
  }
}

TEST(SimulatedDriver, SticksUnderLessThanItsFrictionAndGivesWayLessByIt) {
  const std::pair<const char*, double> devices[] = {{"touch", 0.26}, {"premium", 0.04}, {"omega", 0.3}};
  for (const auto& [model, friction] : devices) {
    DriverUnderTest driver("simulated");
    ASSERT_EQ(driver.open({{"hand", "pinch"}, {"model", model}}), HDEV_OK);
    driver.power(true);
    EXPECT_EQ(rest_under(driver, 0.9 * friction), 0) << model;
    // Pushed slowly further, it stops where spring and friction together bear the force: x = (F - f_c) / k.
    double x = 0;
    for (int i = 0; i <= 100; ++i) x = rest_under(driver, friction + 0.5 * i / 100.0, 30);
    EXPECT_NEAR(x, 0.5 / 100, 3e-4) << model;
  }
}

TEST(SimulatedDriver, MeasuresInStepsOfItsEncoders) {
  DriverUnderTest driver("simulated");
  ASSERT_EQ(driver.open({{"hand", "rigid"}, {"model", "touch"}, {"waypoints", "0 0 0 0; 1 0.01 0 0"}}),
            HDEV_OK);
  driver.power(true);
  driver.read();
  double last = 0;
  for (int i = 0; i < 900; ++i) {
    driver.now += 1'000'000;
    driver.read();
    const double steps = driver.state.pos[0] / 55e-6;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    EXPECT_GE(driver.state.pos[0], last);
    last = driver.state.pos[0];
  }
  EXPECT_NEAR(last, 0.009, 55e-6);
  const hdev_info info = driver.info();
  EXPECT_EQ(info.pos_resolution, 55e-6);
  EXPECT_EQ(info.friction, 0.26);
}

/// From a scene's word to the limit that the hand feels.
TEST(SimulatedDriver, TakesItsModelFromTheScene) {
  Scene scene = scene_with(HandModel::arm, press(0.002));
  scene.devices[0].options = {{"model", "touch"}};
  VirtualWorld world(scene);
  EXPECT_STREQ(world.session.device_info().model, "simulated hand on a device like touch");
  EXPECT_NEAR(world.session.controller().force_limit(), 0.88, 1e-15);
}

TEST(SimulatedDriver, StatesTheForcesOfItsModel) {
  struct Case {
    const char* model;
    double peak, lasting, stiffness, mass;
  };
  for (const Case& one : {Case{"plain", 7.9, 7.9, 1000, 0.045}, Case{"touch", 3.3, 0.88, 1000, 0.045},
                          Case{"premium", 8.5, 1.4, 500, 0.075}, Case{"omega", 12, 12, 5000, 0.2}}) {
    DriverUnderTest driver("simulated");
    ASSERT_EQ(driver.open({{"model", one.model}}), HDEV_OK);
    const hdev_info info = driver.info();
    EXPECT_EQ(info.max_force, one.peak) << one.model;
    EXPECT_EQ(info.cont_force, one.lasting) << one.model;
    EXPECT_EQ(info.max_stiffness, one.stiffness) << one.model;
    EXPECT_EQ(info.apparent_mass, one.mass) << one.model;
  }
  EXPECT_THAT(DriverUnderTest("simulated").trouble({{"model", "phantom"}}),
              HasSubstr("plain, touch, premium or omega"));
}

}  // namespace
}  // namespace palpate::haptic::test
