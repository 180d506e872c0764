// The driver "simulated": hands and devices against closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
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

/// A hand that turns, with torques up to 0.1 N m; `more` overrides.
Keys turning(const Keys& more) {
  Keys keys = more;
  keys.insert({{"max_torque", "0.1"}, {"attitudes", "0 1 0 0 0"}});
  return keys;
}

/// Commands of that torque about x every millisecond. @return the angle about x that the device tells [rad]
double turn_under(DriverUnderTest& driver, double torque, int ms) {
  for (int i = 0; i < ms; ++i) {
    driver.write_wrench({0, 0, 0, torque, 0, 0});
    driver.now += 1'000'000;
    EXPECT_EQ(driver.read(), HDEV_OK);
  }
  return std::atan2(driver.state.R[7], driver.state.R[8]);
}

TEST(SimulatedDriver, SpinsFreelyWithoutLosingEnergy) {
  DriverUnderTest driver("simulated");
  ASSERT_EQ(driver.open(turning({{"turn_inertia", "1e-3"}, {"turn_stiffness", "0"}, {"turn_damping", "0"}})),
            HDEV_OK);
  driver.power(true);
  turn_under(driver, 0.05, 100);  // w = M t / J
  const double w = 0.05 * 0.1 / 1e-3;
  EXPECT_NEAR(driver.state.angvel[0], w, 1e-9);
  const double angle = turn_under(driver, 0, 1);
  for (int i = 1; i <= 100; ++i) {
    EXPECT_NEAR(std::remainder(turn_under(driver, 0, 10) - angle - 0.01 * i * w, 2 * M_PI), 0, 1e-9);
    EXPECT_NEAR(driver.state.angvel[0], w, 1e-12) << "energy is J w^2 / 2";
  }
  const auto& R = driver.state.R;  // still a rotation after 50,000 steps
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(R[i] * R[j] + R[3 + i] * R[3 + j] + R[6 + i] * R[6 + j], i == j ? 1 : 0, 1e-12);
}

/// A torsional spring under a constant torque: theta = M/k (1 - e^{-g t} (cos w t + g/w sin w t)),  g = b / 2 J.
TEST(SimulatedDriver, SwingsAboutTheAngleOfItsSpringUnderATorque) {
  constexpr double J = 1e-3, b = 4e-3, k = 0.4, M = 0.08;
  DriverUnderTest driver("simulated");
  ASSERT_EQ(
      driver.open(turning({{"turn_inertia", "1e-3"}, {"turn_damping", "4e-3"}, {"turn_stiffness", "0.4"}})),
      HDEV_OK);
  driver.power(true);
  const double g = b / (2 * J), w = std::sqrt(k / J - g * g);
  for (int ms = 10; ms <= 1000; ms += 10) {
    const double t = 1e-3 * ms;
    const double closed = M / k * (1 - std::exp(-g * t) * (std::cos(w * t) + g / w * std::sin(w * t)));
    EXPECT_NEAR(turn_under(driver, M, 10), closed, 2e-3 * M / k) << ms << " ms";
  }
  EXPECT_NEAR(turn_under(driver, M, 10'000), M / k, 1e-6);
}

TEST(SimulatedDriver, TurnsLikeTheSpringOfItsHandAtTheEndOfALever) {
  const std::pair<const char*, double> hands[] = {{"arm", 135}, {"pinch", 100}, {"firm", 700}};
  for (const auto& [hand, k] : hands) {
    DriverUnderTest driver("simulated");
    ASSERT_EQ(driver.open(turning({{"hand", hand}})), HDEV_OK);
    driver.power(true);
    EXPECT_NEAR(turn_under(driver, 0.01, 3000), 0.01 / (k * 0.03 * 0.03), 1e-6) << hand;
  }
}

TEST(SimulatedDriver, SticksUnderLessThanItsFrictionAgainstTurning) {
  DriverUnderTest driver("simulated");
  ASSERT_EQ(driver.open(turning({{"hand", "pinch"}, {"turn_friction", "0.01"}})), HDEV_OK);
  driver.power(true);
  EXPECT_EQ(turn_under(driver, 0.009, 500), 0);
  EXPECT_GT(turn_under(driver, 0.02, 500), 0.05);
}

TEST(SimulatedDriver, FollowsAPathOfAttitudes) {
  // A quarter turn about x in a second, then one about the device's y.
  DriverUnderTest driver("simulated");
  ASSERT_EQ(driver.open({{"hand", "rigid"},
                         {"attitudes",
                          "0 1 0 0 0; 1 0.70710678118654757 0.70710678118654757 0 0; 2 0.5 0.5 0.5 -0.5"}}),
            HDEV_OK);
  EXPECT_NE(driver.info().caps & HDEV_CAP_ROT, 0u);
  EXPECT_EQ(driver.info().caps & HDEV_CAP_TORQUE, 0u);
  driver.power(true);
  driver.read();
  EXPECT_NEAR(turn_under(driver, 0, 500), M_PI / 4, 1e-3);
  EXPECT_NEAR(driver.state.angvel[0], M_PI / 2, 1e-9);
  turn_under(driver, 0, 1000);
  EXPECT_NEAR(driver.state.angvel[1], M_PI / 2, 1e-9);
  turn_under(driver, 0, 1000);
  const double end[] = {0, 1, 0, 0, 0, -1, -1, 0, 0};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(driver.state.R[i], end[i], 1e-9) << i;
  EXPECT_EQ(driver.state.angvel[1], 0);
}

TEST(SimulatedDriver, LimitsItsTorqueByNormAndDropsItWhenCommandsStop) {
  DriverUnderTest driver("simulated");
  ASSERT_EQ(driver.open(turning({})), HDEV_OK);
  EXPECT_EQ(driver.info().max_torque, 0.1);
  EXPECT_EQ(driver.info().dof_out, 6u);
  driver.power(true);
  driver.write_wrench({0, 0, 0, 0.3, 0, -0.4});
  driver.read();
  EXPECT_NEAR(driver.state.applied_torque[0], 0.06, 1e-15);
  EXPECT_NEAR(driver.state.applied_torque[2], -0.08, 1e-15);
  EXPECT_EQ(driver.write_wrench({0, 0, 0, std::nan(""), 0, 0}), HDEV_E_ARG);
  driver.now += 31'000'000;
  driver.read();
  EXPECT_EQ(driver.state.applied_torque[0], 0);
  driver.write_wrench({0, 0, 0, 0.05, 0, 0});
  driver.stop();
  driver.now += 1'000'000;
  driver.read();
  EXPECT_EQ(driver.state.applied_torque[0], 0);
}

TEST(SimulatedDriver, TellsNoAttitudeUnlessItTurns) {
  DriverUnderTest driver("simulated");
  ASSERT_EQ(driver.open(), HDEV_OK);
  EXPECT_EQ(driver.info().caps & (HDEV_CAP_ROT | HDEV_CAP_TORQUE), 0u);
  driver.read();
  EXPECT_EQ(driver.state.valid & (HDEV_CAP_ROT | HDEV_CAP_ANGVEL), 0u);
  EXPECT_EQ(driver.state.R[0], 1);
}

TEST(SimulatedDriver, RefusesAttitudesAndTurnsThatAreNone) {
  DriverUnderTest driver("simulated");
  EXPECT_THAT(driver.trouble({{"attitudes", "0 1 1 0 0"}}), HasSubstr("a time and a unit quaternion"));
  EXPECT_THAT(driver.trouble({{"attitudes", "0 1 0 0 0; 0 1 0 0 0"}}), HasSubstr("after the one before"));
  EXPECT_THAT(driver.trouble({{"turn_damping", "-1"}}), HasSubstr("not below 0"));
  EXPECT_THAT(driver.trouble(turning({{"turn_inertia", "1e-9"}})), HasSubstr("turn_inertia is too small"));
}

/// The scene aims in the world, whichever way the device stands in it.
TEST(SimulatedDriver, IsAimedInTheWorld) {
  for (const bool aimed : {false, true}) {
    Scene scene = scene_with(HandModel::rigid, press(0.002));
    scene.devices[0].rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    scene.devices[0].options = {{"max_torque", "0.1"}};
    if (aimed) scene.devices[0].options.emplace_back("attitudes", "0 0.6 0 0.8 0");
    VirtualWorld world(scene);
    world.run(0.1, 150);
    const Array4 wanted = aimed ? Array4{0.6, 0, 0.8, 0} : Array4{1, 0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(world.session.tool_state().q_WT[i], wanted[i], 1e-12);
    EXPECT_NEAR(world.session.controller().torque_limit(), 0.1, 1e-12);
  }
}

}  // namespace
}  // namespace palpate::haptic::test
