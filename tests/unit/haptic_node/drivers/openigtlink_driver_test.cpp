// The driver "openigtlink" against a tracker server whose messages are packed by Debian's library.

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <igtlPositionMessage.h>
#include <igtlStatusMessage.h>
#include <igtlTransformMessage.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/unit/haptic_node/drivers/opened_driver.h"

namespace palpate::haptic::test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

/// Sends the same messages again and again, in small pieces, until it is told to end.
class TrackerServer {
 public:
  TrackerServer() {
    listener_ = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port = std::to_string(ntohs(address.sin_port));
  }
  ~TrackerServer() {
    end();
    close(listener_);
  }
  template <class Message>
  void add(Message& message) {
    message->Pack();
    round_.append(static_cast<const char*>(message->GetPackPointer()),
                  static_cast<std::size_t>(message->GetPackSize()));
  }
  void add_raw(const std::string& bytes) { round_ += bytes; }
  void start() {
    thread_ = std::thread([this] {
      const int client = accept(listener_, nullptr, nullptr);
      for (std::size_t at = 0; client >= 0 && going_.load(); at = (at + 37) % round_.size()) {
        const std::size_t n = std::min<std::size_t>(37, round_.size() - at);
        if (send(client, round_.data() + at, n, MSG_NOSIGNAL) < 0) break;
        if (n < 37) at = round_.size() - 37;  // the next piece is the first again
        std::this_thread::sleep_for(200us);
      }
      if (client >= 0) close(client);
    });
  }
  void end() {
    going_.store(false);
    shutdown(listener_, SHUT_RDWR);
    if (thread_.joinable()) thread_.join();
  }
  std::map<std::string, std::string> options() const { return {{"server_port", port}}; }

  std::string port;

 private:
  int listener_ = -1;
  std::string round_;
  std::atomic<bool> going_{true};
  std::thread thread_;
};

igtl::TransformMessage::Pointer transform(const char* name, float x, float y, float z) {
  auto message = igtl::TransformMessage::New();
  message->SetDeviceName(name);
  igtl::Matrix4x4 m = {{0, -1, 0, x}, {1, 0, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}};
  message->SetMatrix(m);
  return message;
}

template <class Reached>
void read_until(DriverUnderTest& driver, Reached&& reached) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < end) {
    if (reached(driver.read())) return;
    std::this_thread::sleep_for(200us);
  }
  FAIL() << "waited in vain";
}

TEST(OpenIgtLink, TakesThePosesOfItsToolAmongOtherMessages) {
  TrackerServer server;
  auto other = transform("Other", 1, 2, 3);
  auto stylus = transform("Stylus", 100, -200, 50.5f);
  auto status = igtl::StatusMessage::New();
  status->SetDeviceName("Stylus");
  status->SetCode(1);
  status->SetSubCode(0);
  status->SetErrorName("none");
  status->SetStatusString("all is well");
  server.add(other);
  server.add(status);
  server.add(stylus);
  server.start();
  DriverUnderTest driver("openigtlink");
  ASSERT_EQ(driver.open(server.options(), "Stylus"), HDEV_OK) << driver.api().last_error(nullptr);
  EXPECT_STREQ(driver.info().model, "Stylus");
  driver.now += 1'000'000;
  read_until(driver, [&](hdev_status s) { return s == HDEV_OK && driver.state.t_ns == driver.now.load(); });
  EXPECT_NEAR(driver.state.pos[0], 0.1, 1e-6);
  EXPECT_NEAR(driver.state.pos[1], -0.2, 1e-6);
  EXPECT_NEAR(driver.state.pos[2], 0.0505, 1e-6);
  EXPECT_NEAR(driver.state.R[1], -1, 1e-6);
  EXPECT_NEAR(driver.state.R[3], 1, 1e-6);
  EXPECT_EQ(driver.power(true), HDEV_E_UNSUPPORTED);
}

TEST(OpenIgtLink, TakesTheFirstToolAndPositionsWithQuaternions) {
  TrackerServer server;
  auto position = igtl::PositionMessage::New();
  position->SetDeviceName("Pointer");
  position->SetPackType(igtl::PositionMessage::ALL);
  position->SetPosition(10, 20, 30);
  position->SetQuaternion(0, 0, 0.70710678f, 0.70710678f);
  server.add(position);
  server.start();
  DriverUnderTest driver("openigtlink");
  ASSERT_EQ(driver.open(server.options()), HDEV_OK) << driver.api().last_error(nullptr);
  EXPECT_STREQ(driver.info().model, "Pointer");
  read_until(driver, [&](hdev_status s) { return s == HDEV_OK; });
  EXPECT_NEAR(driver.state.pos[2], 0.03, 1e-6);
  EXPECT_NEAR(driver.state.R[3], 1, 1e-6);
}

TEST(OpenIgtLink, PassesOverDamagedMessagesAndMirrors) {
  TrackerServer server;
  auto damaged = transform("Stylus", 7, 7, 7);
  damaged->Pack();
  std::string bytes(static_cast<const char*>(damaged->GetPackPointer()),
                    static_cast<std::size_t>(damaged->GetPackSize()));
  bytes.back() = static_cast<char>(bytes.back() ^ 0x55);
  auto mirror = transform("Stylus", 8, 8, 8);
  igtl::Matrix4x4 m = {{-1, 0, 0, 8}, {0, 1, 0, 8}, {0, 0, 1, 8}, {0, 0, 0, 1}};
  mirror->SetMatrix(m);
  auto good = transform("Stylus", 1, 1, 1);
  server.add_raw(bytes);
  server.add(mirror);
  server.add(good);
  server.start();
  DriverUnderTest driver("openigtlink");
  ASSERT_EQ(driver.open(server.options()), HDEV_OK) << driver.api().last_error(nullptr);
  for (int i = 0; i < 20; ++i) {
    read_until(driver, [&](hdev_status s) { return s == HDEV_OK; });
    EXPECT_NEAR(driver.state.pos[0], 0.001, 1e-6);
  }
}

TEST(OpenIgtLink, NoticesThatTheServerHasGone) {
  TrackerServer server;
  auto stylus = transform("Stylus", 0, 0, 0);
  server.add(stylus);
  server.start();
  DriverUnderTest driver("openigtlink");
  ASSERT_EQ(driver.open(server.options()), HDEV_OK) << driver.api().last_error(nullptr);
  server.end();
  read_until(driver, [](hdev_status s) { return s == HDEV_E_LOST; });
  EXPECT_THAT(driver.last_error(), HasSubstr("the tracker server has gone: "));
}

TEST(OpenIgtLink, SaysWhyItDoesNotOpen) {
  DriverUnderTest driver("openigtlink");
  EXPECT_THAT(driver.trouble({{"server_port", "1"}}),
              HasSubstr("no OpenIGTLink server at localhost:1 (Connection refused); start it"));
  EXPECT_THAT(driver.trouble({{"host", "x"}}), HasSubstr("unknown key \"host\"; known are server_host"));
  TrackerServer server;
  auto other = transform("Other", 1, 2, 3);
  server.add(other);
  server.start();
  EXPECT_THAT(driver.trouble(server.options(), "Stylus"),
              HasSubstr("no TRANSFORM or POSITION named \"Stylus\""));
}

}  // namespace
}  // namespace palpate::haptic::test
