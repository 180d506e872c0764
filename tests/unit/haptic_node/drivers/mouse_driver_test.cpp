// The driver "mouse" against pointers that this test publishes, as the render window would.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "haptic_node/drivers/mouse/pointer_follower.h"
#include "tests/system/dds_domain.h"
#include "tests/unit/haptic_node/drivers/opened_driver.h"

namespace palpate::haptic::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

std::map<std::string, std::string> here(std::map<std::string, std::string> more = {}) {
  more["domain"] = std::to_string(palpate::test::own_domain());
  return more;
}

Pointer pointer_at(const Array3& p, std::uint32_t tool = 0) {
  static std::uint64_t tick = 0;
  Pointer pointer;
  pointer.tool = tool;
  pointer.tick = ++tick;
  pointer.p_W = p;
  pointer.held = 1;
  return pointer;
}

/// The window's end of the wire.
struct Window {
  void say(const Pointer& pointer) { EXPECT_TRUE(writer.write(pointer)); }
  Participant participant{palpate::test::own_domain()};
  Writer<Pointer> writer{participant};
};

/// Says `pointer` over and over, as a window does with every picture, until `reached(status)`; the host's clock goes on.
template <class Reached>
void read_until(DriverUnderTest& driver, Window& window, const Pointer& pointer, Reached&& reached) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < end) {
    window.say(pointer);
    for (int i = 0; i < 10; ++i) {
      driver.now += 1'000'000;
      if (reached(driver.read())) return;
    }
    std::this_thread::sleep_for(1ms);
  }
  FAIL() << "waited in vain";
}

bool is_at(const DriverUnderTest& driver, double x, double y, double z) {
  const double* p = driver.state.pos;
  return std::hypot(p[0] - x, p[1] - y, p[2] - z) < 1e-6;
}

TEST(Mouse, FollowsThePointerOfItsTool) {
  DriverUnderTest driver("mouse");
  ASSERT_EQ(driver.open(here({{"tool", "1"}})), HDEV_OK) << driver.api().last_error(nullptr);
  const hdev_info info = driver.info();
  EXPECT_TRUE((info.caps & HDEV_CAP_DEADMAN) != 0 && (info.caps & HDEV_CAP_FORCE) != 0);
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN) << "nobody has pointed";
  Window window;
  // 1. it begins where the pointer is
  read_until(driver, window, pointer_at({0.01, 0.02, 0.03}, 1), [](hdev_status s) { return s == HDEV_OK; });
  EXPECT_TRUE(is_at(driver, 0.01, 0.02, 0.03));
  EXPECT_EQ(driver.state.deadman, 1u);
  // 2. another tool's pointer moves another tool
  for (int i = 0; i < 20; ++i) window.say(pointer_at({1, 1, 1}, 0));
  // 3. it goes where the pointer goes, turns and presses its button with it
  Pointer pointer = pointer_at({0.05, 0.02, 0.03}, 1);
  pointer.q_W = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  pointer.buttons = 5;
  double fastest = 0, last = driver.state.pos[0];
  read_until(driver, window, pointer, [&](hdev_status s) {
    fastest = std::max(fastest, std::abs(driver.state.pos[0] - last) / 1e-3);
    last = driver.state.pos[0];
    return s == HDEV_OK && is_at(driver, 0.05, 0.02, 0.03) && std::abs(driver.state.R[3] - 1) < 1e-6;
  });
  EXPECT_LE(fastest, 0.5 + 1e-9);
  EXPECT_EQ(driver.state.buttons, 5u);
  // 4. let go, it stays
  pointer.held = 0;
  read_until(driver, window, pointer,
             [&](hdev_status s) { return s == HDEV_OK && driver.state.deadman == 0; });
  EXPECT_TRUE(is_at(driver, 0.05, 0.02, 0.03));
}

TEST(Mouse, ShowsForcesWithoutMotors) {
  DriverUnderTest driver("mouse");
  Window window;
  ASSERT_EQ(driver.open(here({{"max_force_N", "2"}})), HDEV_OK);
  read_until(driver, window, pointer_at({0, 0, 0}), [](hdev_status s) { return s == HDEV_OK; });
  EXPECT_EQ(driver.state.force_enabled, 0u);
  ASSERT_EQ(driver.power(true), HDEV_OK);
  ASSERT_EQ(driver.write(0, 0, 3), HDEV_OK);
  ASSERT_EQ(driver.read(), HDEV_OK);
  EXPECT_EQ(driver.state.force_enabled, 1u);
  EXPECT_NEAR(driver.state.applied_force[2], 2, 1e-12);
  driver.stop();
  ASSERT_EQ(driver.read(), HDEV_OK);
  EXPECT_EQ(driver.state.force_enabled, 0u);
  EXPECT_EQ(driver.state.applied_force[2], 0);
}

TEST(Mouse, HasNothingNewWhenTheWindowHasGoneAndGoesOnWhenItReturns) {
  DriverUnderTest driver("mouse");
  ASSERT_EQ(driver.open(here()), HDEV_OK);
  auto window = std::make_unique<Window>();
  const auto ok = [](hdev_status s) { return s == HDEV_OK; };
  read_until(driver, *window, pointer_at({0, 0, 0}), ok);
  // 1. silent for longer than pictures take, once what was under way has come
  const auto silent_by = std::chrono::steady_clock::now() + 20s;
  do {
    std::this_thread::sleep_for(1ms);
    driver.now += 600'000'000;
  } while (driver.read() != HDEV_E_AGAIN && std::chrono::steady_clock::now() < silent_by);
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN);
  read_until(driver, *window, pointer_at({0.001, 0, 0}), ok);
  // 2. closed
  window.reset();
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (driver.read() != HDEV_E_AGAIN && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(1ms);
  EXPECT_EQ(driver.read(), HDEV_E_AGAIN);
  EXPECT_THAT(driver.last_error(), HasSubstr("no window points"));
  // 3. opened again
  Window another;
  read_until(driver, another, pointer_at({0.002, 0, 0}),
             [&](hdev_status s) { return s == HDEV_OK && is_at(driver, 0.002, 0, 0); });
}

TEST(Mouse, PointsInTheWorldWhateverTheCalibration) {
  DriverUnderTest driver("mouse");
  // x_w = s R x_d + o with a quarter turn about z: x_d = R^T (p - o) / s
  ASSERT_EQ(
      driver.open(here(
          {{"world_rotation", "0 -1 0  1 0 0  0 0 1"}, {"world_scale", "2"}, {"world_offset_m", "0.1 0 0"}})),
      HDEV_OK)
      << driver.api().last_error(nullptr);
  Window window;
  read_until(driver, window, pointer_at({0.1, 0.04, 0.02}), [](hdev_status s) { return s == HDEV_OK; });
  EXPECT_TRUE(is_at(driver, 0.02, 0, 0.01));
  EXPECT_NEAR(driver.state.R[1], 1, 1e-12);  // R^T of the identity in the world
}

TEST(Mouse, SharesItsDomainWithTheProgramThatLoadsIt) {
  // The driver is a library with a wire of its own; whoever comes or goes first, the other one still hears.
  const auto hears = [](Writer<Command>& writer, Reader<Command>& reader) {
    static std::uint64_t id = 0;
    const auto end = std::chrono::steady_clock::now() + 20s;
    Command command, heard;
    command.id = ++id;
    while (std::chrono::steady_clock::now() < end) {
      writer.write(command);
      if (reader.wait(5ms) && reader.take(heard)) return true;
    }
    return false;
  };
  DriverUnderTest driver("mouse");
  for (int round = 0; round < 3; ++round) {
    ASSERT_EQ(driver.open(here()), HDEV_OK) << driver.api().last_error(nullptr);
    {
      Participant participant(palpate::test::own_domain());
      EXPECT_TRUE(participant.local_only());
      Writer<Command> writer(participant);
      Reader<Command> reader(participant);
      EXPECT_TRUE(hears(writer, reader));
      driver.close();
      EXPECT_TRUE(hears(writer, reader)) << "the driver took the domain with it";
      ASSERT_EQ(driver.open(here()), HDEV_OK);
    }
    Window window;
    read_until(driver, window, pointer_at({0, 0, 0}), [](hdev_status s) { return s == HDEV_OK; });
    driver.close();
  }
}

TEST(Mouse, SaysWhyItDoesNotOpen) {
  DriverUnderTest driver("mouse");
  EXPECT_THAT(driver.trouble({}), HasSubstr("there is no window to point in; use palpate run"));
  EXPECT_THAT(driver.trouble(here({{"speed", "1"}})),
              HasSubstr("unknown key \"speed\"; known are speed_mm_per_s"));
  EXPECT_THAT(driver.trouble(here({{"speed_mm_per_s", "0"}})), HasSubstr("a number above 0"));
  EXPECT_THAT(driver.trouble(here({{"world_rotation", "1 0 0"}})), HasSubstr("9 numbers between blanks"));
  EXPECT_THAT(driver.trouble(here(), "left"), HasSubstr("there is only \"window\""));
}

TEST(PointerFollower, ComesToAPointerAtRestWithoutOvershoot) {
  for (const double step : {1e-4, 1e-3, 0.02}) {
    mouse::PointerFollower follower(0.5);
    follower.begin({0, 0, 0}, Eigen::Quaterniond::Identity());
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()));
    double before = 0, seconds = 0;
    while (seconds < 1.0) {
      follower.step({0.2, 0, 0}, turned, step);
      seconds += step;
      ASSERT_GE(follower.x().x(), before) << "it never goes back";
      ASSERT_LE(follower.x().x(), 0.2 + 1e-12);
      ASSERT_LE(follower.x().x() - before, 0.5 * step + 1e-12);
      before = follower.x().x();
    }
    EXPECT_NEAR(follower.x().x(), 0.2, 1e-6);
    EXPECT_LT(follower.q().angularDistance(turned), 1e-6);
  }
}

TEST(PointerFollower, MovesAsTheClosedFormSays) {
  // From rest, far below the limit of speed: x = p (1 - (1 + w t) exp(-w t)), the same for any step.
  for (const double step : {1e-4, 1e-3, 7e-3}) {
    mouse::PointerFollower follower(10.0);
    follower.begin({0, 0, 0}, Eigen::Quaterniond::Identity());
    double t = 0;
    for (int i = 0; i < 20; ++i) {
      follower.step({0, 0.01, 0}, Eigen::Quaterniond::Identity(), step);
      t += step;
      const double w = mouse::PointerFollower::corner;
      ASSERT_NEAR(follower.x().y(), 0.01 * (1 - (1 + w * t) * std::exp(-w * t)), 1e-14);
    }
  }
}

}  // namespace
}  // namespace palpate::haptic::test
