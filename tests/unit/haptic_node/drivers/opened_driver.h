#pragma once
// A driver as the host sees it, without the host: loaded, opened, read and written by hand, in a clock that the test
// turns.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "haptic_node/device/driver_library.h"

namespace palpate::haptic::test {

class DriverUnderTest {
 public:
  explicit DriverUnderTest(const std::string& name) : library_(load(name)) {
    host_.size = sizeof host_;
    host_.user = this;
    host_.log = [](void* self, int, const char* line) {
      static_cast<DriverUnderTest*>(self)->log += std::string(line) + "\n";
    };
    host_.now_ns = [](void* self) { return static_cast<DriverUnderTest*>(self)->now.load(); };
  }
  ~DriverUnderTest() { close(); }
  DriverUnderTest(const DriverUnderTest&) = delete;
  DriverUnderTest& operator=(const DriverUnderTest&) = delete;

  hdev_status open(const std::map<std::string, std::string>& options = {}, const std::string& id = "") {
    close();
    std::vector<const char*> kv;
    for (const auto& [key, value] : options) kv.insert(kv.end(), {key.c_str(), value.c_str()});
    return api().open(&host_, id.c_str(), kv.data(), static_cast<std::uint32_t>(options.size()), &device_);
  }
  /// What the driver says of the open() that must fail.
  std::string trouble(const std::map<std::string, std::string>& options, const std::string& id = "") {
    if (open(options, id) == HDEV_OK) {
      close();
      return "opened";
    }
    EXPECT_EQ(device_, nullptr);
    return api().last_error(nullptr);
  }
  std::string last_error() { return api().last_error(device_); }
  void close() {
    if (device_ != nullptr) api().close(device_);
    device_ = nullptr;
  }

  hdev_info info() {
    hdev_info info{};
    info.size = sizeof info;
    EXPECT_EQ(api().get_info(device_, &info), HDEV_OK);
    return info;
  }
  hdev_status calibrate(std::uint32_t timeout_ms = 100) { return api().calibrate(device_, timeout_ms); }
  hdev_status power(bool on) { return api().enable_force(device_, on ? 1u : 0u); }
  hdev_status read() {
    state.size = sizeof state;
    return api().read(device_, &state, 0);
  }
  hdev_status write(double x, double y, double z) { return write_wrench({x, y, z, 0, 0, 0}); }
  hdev_status write_wrench(const std::vector<double>& w) {
    hdev_command command{};
    command.size = sizeof command;
    for (std::size_t i = 0; i < 3; ++i) command.force[i] = w[i], command.torque[i] = w[i + 3];
    return api().write(device_, &command);
  }
  hdev_status stop() { return api().stop(device_); }

  const hdev_api& api() const { return library_.api(); }
  const hdev_host& host() const { return host_; }
  hdev* device() const { return device_; }

  std::atomic<std::int64_t> now{1'000'000'000};  // drivers with threads read it, too
  hdev_state state{};
  std::string log;

 private:
  static DriverLibrary load(const std::string& name) {
    setenv("PALPATE_DRIVERS", PALPATE_TEST_DRIVERS, 1);
    return DriverLibrary::load(name);
  }
  DriverLibrary library_;
  hdev_host host_{};
  hdev* device_ = nullptr;
};

}  // namespace palpate::haptic::test
