// The driver "inverse3" against a stand-in for the vendor's service that stands on another WebSocket library.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "haptic_node/drivers/inverse3/websocket_accept.h"
#include "tests/support/devices/helper_process.h"
#include "tests/unit/haptic_node/drivers/opened_driver.h"

namespace palpate::haptic::test {
namespace {

using palpate::test::HelperProcess;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// The service, from its start until it is told to end.
struct Service {
  explicit Service(const std::string& mood = "calm", const std::string& force_key = "values")
      : process({"/usr/bin/python3", HAPLY_SERVICE, force_key, mood, log}), port(process.line()) {}
  ~Service() { std::filesystem::remove(log); }

  std::map<std::string, std::string> options() const { return {{"service_port", port}}; }
  /// What the client has said; call it once the client has gone.
  std::vector<nlohmann::json> messages() {
    process.wait();
    std::vector<nlohmann::json> all;
    std::ifstream file(log);
    for (std::string line; std::getline(file, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }

  std::string log =
      (std::filesystem::temp_directory_path() / ("palpate_haply_" + std::to_string(getpid()))).string();
  HelperProcess process;
  std::string port;
};

/// Reads until `reached` or too much time has passed. @return the last answer
template <class Reached>
hdev_status read_until(DriverUnderTest& driver, Reached&& reached) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  hdev_status status = HDEV_E_AGAIN;
  while (std::chrono::steady_clock::now() < end) {
    status = driver.read();
    if (reached(status)) return status;
    std::this_thread::sleep_for(200us);
  }
  ADD_FAILURE() << "waited in vain; last answer " << status;
  return status;
}

bool is_good(hdev_status status) { return status == HDEV_OK; }

TEST(Inverse3, KeepsToThePublishedExamplesOfTheHandshake) {
  EXPECT_EQ(inverse3::accept_of("dGhlIHNhbXBsZSBub25jZQ=="),
            "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");  // RFC 6455, 1.3
  const std::string letters = "fooba";        // RFC 4648, 10
  EXPECT_EQ(inverse3::base64(reinterpret_cast<const std::uint8_t*>(letters.data()), 5), "Zm9vYmE=");
  EXPECT_EQ(inverse3::base64(reinterpret_cast<const std::uint8_t*>(letters.data()), 4), "Zm9vYg==");
}

TEST(Inverse3, MeasuresHandGripAndButtons) {
  Service service;
  DriverUnderTest driver("inverse3");
  ASSERT_EQ(driver.open(service.options()), HDEV_OK) << driver.api().last_error(nullptr);
  EXPECT_STREQ(driver.info().serial, "049D");
  read_until(driver, is_good);
  driver.now += 1'000'000'000;
  read_until(driver, [&](hdev_status s) { return is_good(s) && driver.state.t_ns == driver.now.load(); });
  EXPECT_NEAR(driver.state.pos[1], -0.02, 1e-12) << "left out by the service, so as it was";
  EXPECT_NEAR(driver.state.pos[2], 0.03, 1e-12);
  EXPECT_NEAR(driver.state.vel[1], 0.5, 1e-12);
  EXPECT_NEAR(driver.state.R[1], -1, 1e-6);
  EXPECT_NEAR(driver.state.R[3], 1, 1e-6);
  EXPECT_EQ(driver.state.buttons, 5u);
  EXPECT_EQ(driver.state.force_enabled, 0u);
}

TEST(Inverse3, SendsForcesOnlyWhenTheyAreOnAndEndsWithZero) {
  Service service("calm", "vector");
  auto options = service.options();
  options["force_key"] = "vector";
  DriverUnderTest driver("inverse3");
  ASSERT_EQ(driver.open(options, "0500"), HDEV_OK) << driver.api().last_error(nullptr);
  driver.write(3, 0, 0);
  read_until(driver, is_good);
  EXPECT_EQ(driver.state.pos[0], 0);
  ASSERT_EQ(driver.power(true), HDEV_OK);
  driver.write(2, 0, 0);
  read_until(driver, [&](hdev_status s) { return is_good(s) && driver.state.pos[0] != 0; });
  driver.write(2, 0, 0);
  read_until(driver,
             [&](hdev_status s) { return is_good(s) && std::abs(driver.state.pos[0] - 0.002) < 1e-12; });
  EXPECT_NEAR(driver.state.applied_force[0], 2, 1e-12);
  driver.write(30, 0, 40);  // the direction stays, the length is the device's
  read_until(driver,
             [&](hdev_status s) { return is_good(s) && std::abs(driver.state.pos[0] - 0.0024) < 1e-12; });
  driver.close();

  const auto messages = service.messages();
  ASSERT_GT(messages.size(), 4u);
  EXPECT_EQ(messages.front()["session"]["configure"]["profile"]["name"], "palpate");
  EXPECT_TRUE(messages.front()["inverse3"][0]["commands"].contains("probe_position"));
  EXPECT_FALSE(messages[1].contains("session"));
  for (const auto& message : messages) EXPECT_EQ(message["inverse3"][0]["device_id"], "0500");
  const auto& last = messages.back()["inverse3"][0]["commands"];
  ASSERT_TRUE(last.contains("set_cursor_force")) << last;
  EXPECT_EQ(last["set_cursor_force"]["vector"], (nlohmann::json{{"x", 0.0}, {"y", 0.0}, {"z", 0.0}}));
}

TEST(Inverse3, DropsTheForceWhenStoppedOrWhenTheHostFallsSilent) {
  Service service;
  DriverUnderTest driver("inverse3");
  ASSERT_EQ(driver.open(service.options()), HDEV_OK) << driver.api().last_error(nullptr);
  driver.power(true);
  driver.write(2, 0, 0);
  read_until(driver, [&](hdev_status s) { return is_good(s) && driver.state.pos[0] > 0; });
  driver.now += 20'000'001;
  read_until(driver, [&](hdev_status s) { return is_good(s) && driver.state.pos[0] == 0; });
  EXPECT_EQ(driver.state.force_enabled, 1u);
  driver.write(2, 0, 0);
  read_until(driver, [&](hdev_status s) { return is_good(s) && driver.state.pos[0] > 0; });
  driver.stop();
  read_until(driver, [&](hdev_status s) { return is_good(s) && driver.state.pos[0] == 0; });
  EXPECT_EQ(driver.state.force_enabled, 0u);
}

TEST(Inverse3, GivesUpAServiceThatIsNoMore) {
  const std::pair<const char*, const char*> moods[] = {{"leaves", "closed the connection"},
                                                       {"silent", "fallen silent"},
                                                       {"garbage", "speaks of no Inverse3"},
                                                       {"deviceless", "speaks of no Inverse3"}};
  for (const auto& [mood, words] : moods) {
    Service service(mood);
    DriverUnderTest driver("inverse3");
    ASSERT_EQ(driver.open(service.options()), HDEV_OK) << mood << ": " << driver.api().last_error(nullptr);
    driver.power(true);
    read_until(driver, [&](hdev_status s) { return s == HDEV_E_LOST; });
    EXPECT_EQ(driver.write(1, 0, 0), HDEV_E_LOST) << mood;
    EXPECT_EQ(driver.power(true), HDEV_E_LOST) << mood;
    EXPECT_THAT(driver.last_error(), HasSubstr(words)) << mood;
  }
}

TEST(Inverse3, NamesWhatTheServiceSaysOfTheDeviceAndForcesNoMore) {
  struct Case {
    const char* mood;
    std::uint32_t fault;
    const char* words;
  };
  for (const Case& one : {Case{"powerless", HDEV_FAULT_POWER, "power_supply is false"},
                          Case{"unready", HDEV_FAULT_FORCE_OFF, "ready is false"},
                          Case{"limp", HDEV_FAULT_FORCE_OFF, "current_cursor_force is none"}}) {
    Service service(one.mood);
    DriverUnderTest driver("inverse3");
    ASSERT_EQ(driver.open(service.options()), HDEV_OK)
        << one.mood << ": " << driver.api().last_error(nullptr);
    driver.power(true);
    read_until(driver, [&](hdev_status s) {
      driver.write(1, 0, 0);
      return s == HDEV_E_FAULT;
    });
    EXPECT_EQ(driver.state.fault, one.fault) << one.mood;
    EXPECT_THAT(driver.last_error(), HasSubstr(one.words)) << one.mood;
    driver.write(1, 0, 0);
    const std::uint64_t seq = driver.state.seq;
    read_until(driver, [&](hdev_status s) { return s == HDEV_E_FAULT && driver.state.seq > seq + 5; });
    EXPECT_EQ(driver.state.force_enabled, 0u) << one.mood;
    driver.close();
    const auto messages = service.messages();
    EXPECT_FALSE(messages.back()["inverse3"][0]["commands"].contains("set_cursor_force"))
        << one.mood << ": a question only";
  }
}

/// Versions of the service that never tell of a force: no reason to take it for none.
TEST(Inverse3, BelievesThatForcesAreFeltWhereTheServiceNeverTellsOfThem) {
  Service service("untold");
  DriverUnderTest driver("inverse3");
  ASSERT_EQ(driver.open(service.options()), HDEV_OK) << driver.api().last_error(nullptr);
  driver.power(true);
  std::uint64_t first = 0;
  const hdev_status last = read_until(driver, [&](hdev_status s) {
    driver.write(1, 0, 0);
    if (first == 0 && is_good(s)) first = driver.state.seq;
    return s == HDEV_E_FAULT || (first > 0 && driver.state.seq > first + 400);
  });
  EXPECT_NE(last, HDEV_E_FAULT) << driver.last_error();
}

TEST(Inverse3, SaysWhyADeviceDoesNotOpen) {
  DriverUnderTest driver("inverse3");
  EXPECT_THAT(driver.trouble({{"service_port", "1"}}),
              HasSubstr("no Haply Inverse service at ws://localhost:1 (Connection refused); start it"));
  EXPECT_THAT(driver.trouble({{"port", "1"}}),
              HasSubstr("unknown key \"port\"; known are service_host, service_port"));
  EXPECT_THAT(driver.trouble({{"service_port", "-1"}}), HasSubstr("a whole number from 0 to 65535"));
  Service service;
  EXPECT_THAT(driver.trouble(service.options(), "left"),
              HasSubstr("no Inverse3 \"left\"; the service has 049D, 0500"));
  Service shy("shy");
  EXPECT_THAT(driver.trouble(shy.options()), HasSubstr("says nothing"));
}

}  // namespace
}  // namespace palpate::haptic::test
