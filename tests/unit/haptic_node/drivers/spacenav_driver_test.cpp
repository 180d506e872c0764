// The driver "spacenav" with Debian's libspnav against a daemon of our own on a local socket.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/unit/haptic_node/drivers/opened_driver.h"

namespace palpate::haptic::test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

/// What spacenavd does for a client that speaks the first version of its protocol: packets of eight 32-bit numbers.
class FakeDaemon {
 public:
  FakeDaemon() {
    std::filesystem::remove(path);
    listener_ = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
  }
  ~FakeDaemon() {
    die();
    close(listener_);
    std::filesystem::remove(path);
  }
  void welcome() { client_ = accept(listener_, nullptr, nullptr); }
  void say(const std::array<std::int32_t, 8>& packet) {
    EXPECT_EQ(send(client_, packet.data(), sizeof packet, MSG_NOSIGNAL), static_cast<ssize_t>(sizeof packet));
  }
  void die() {
    if (client_ >= 0) close(client_);
    client_ = -1;
  }

  std::string path =
      (std::filesystem::temp_directory_path() / ("palpate_spnav_" + std::to_string(getpid()) + ".sock"))
          .string();

 private:
  int listener_ = -1, client_ = -1;
};

template <class Reached>
void read_until(DriverUnderTest& driver, Reached&& reached) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < end) {
    if (reached(driver.read())) return;
    std::this_thread::sleep_for(200us);
  }
  FAIL() << "waited in vain";
}

TEST(Spacenav, MovesTheHandleAsFarAsTheCapWasPushed) {
  FakeDaemon daemon;
  DriverUnderTest driver("spacenav");
  ASSERT_EQ(driver.open({{"socket", daemon.path},
                         {"speed_mm_per_s", "40"},
                         {"turn_deg_per_s", "90"},
                         {"half_workspace_mm", "10"}}),
            HDEV_OK)
      << driver.api().last_error(nullptr);
  daemon.welcome();
  EXPECT_EQ(driver.info().caps & HDEV_CAP_FORCE, 0u);
  ASSERT_EQ(driver.read(), HDEV_OK);

  // 1. pushed halfway along +x, with a button; the clock stands, so nothing moves yet
  daemon.say({0, 175, 0, 0, 0, 0, 0, 16});
  daemon.say({1, 3, 1, 0, 0, 0, 0, 0});
  read_until(driver, [&](hdev_status s) { return s == HDEV_OK && driver.state.buttons == 8; });
  for (int i = 0; i < 100; ++i) {
    driver.now += 1'000'000;
    ASSERT_EQ(driver.read(), HDEV_OK);
  }
  EXPECT_NEAR(driver.state.pos[0], 0.020 * 0.1, 1e-12);
  EXPECT_NEAR(driver.state.vel[0], 0.020, 1e-9);
  EXPECT_EQ(driver.state.pos[1], 0);
  EXPECT_EQ(driver.state.pos[2], 0);

  // 2. let go, then turned by a quarter about one axis
  daemon.say({0, 0, 0, 0, 350, 0, 0, 16});
  daemon.say({2, 3, 0, 0, 0, 0, 0, 0});
  read_until(driver, [&](hdev_status s) { return s == HDEV_OK && driver.state.buttons == 0; });
  for (int i = 0; i < 1000; ++i) {
    driver.now += 1'000'000;
    ASSERT_EQ(driver.read(), HDEV_OK);
  }
  EXPECT_NEAR(driver.state.pos[0], 0.002, 1e-12) << "it stays";
  EXPECT_NEAR(driver.state.R[0], 1, 1e-9);
  EXPECT_NEAR(driver.state.R[4], 0, 1e-9);
  EXPECT_NEAR(driver.state.R[7], 1, 1e-9);

  // 3. pushed for long: it does not leave its cube
  daemon.say({0, 350, 0, 0, 0, 0, 0, 16});
  daemon.say({1, 0, 1, 0, 0, 0, 0, 0});
  read_until(driver, [&](hdev_status s) { return s == HDEV_OK && driver.state.buttons == 1; });
  for (int i = 0; i < 1000; ++i) {
    driver.now += 1'000'000;
    driver.read();
  }
  EXPECT_NEAR(driver.state.pos[0], 0.010, 1e-12);
}

TEST(Spacenav, NoticesThatTheDaemonHasGone) {
  FakeDaemon daemon;
  DriverUnderTest driver("spacenav");
  ASSERT_EQ(driver.open({{"socket", daemon.path}}), HDEV_OK) << driver.api().last_error(nullptr);
  daemon.welcome();
  EXPECT_EQ(driver.power(true), HDEV_E_UNSUPPORTED);
  daemon.die();
  read_until(driver, [](hdev_status s) { return s == HDEV_E_LOST; });
  EXPECT_THAT(driver.last_error(), HasSubstr("spacenavd has gone"));
}

TEST(Spacenav, SaysWhyItDoesNotOpen) {
  DriverUnderTest driver("spacenav"), second("spacenav");
  EXPECT_THAT(driver.trouble({{"socket", "/no/such.sock"}}),
              HasSubstr("no spacenavd at /no/such.sock; install"));
  EXPECT_THAT(driver.trouble({{"speed", "1"}}), HasSubstr("unknown key \"speed\"; known are speed_mm_per_s"));
  EXPECT_THAT(driver.trouble({{"turn_deg_per_s", "0"}}), HasSubstr("a number above 0"));
  FakeDaemon daemon;
  ASSERT_EQ(driver.open({{"socket", daemon.path}}), HDEV_OK);
  daemon.welcome();
  EXPECT_EQ(second.open({{"socket", daemon.path}}), HDEV_E_BUSY);
}

}  // namespace
}  // namespace palpate::haptic::test
