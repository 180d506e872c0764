#pragma once
// What drivers in C++ share: the C table of haptic_device.h is filled once, in driver.cpp, and a driver says only what
// is its own. A driver defines this_driver() and links this folder's files.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "haptic_node/device/haptic_device.h"
#include "haptic_node/drivers/kit/options.h"

namespace palpate::haptic::kit {

/// Why a device cannot be opened, listed, calibrated or powered. Not for read() and write().
struct Trouble : std::runtime_error {
  Trouble(hdev_status the_status, const std::string& words) : std::runtime_error(words), status(the_status) {}
  hdev_status status;
};

/// Force and torque, finite and within what the device states.
struct Effort {
  double force[3]{};   // [N]
  double torque[3]{};  // [N m]
};

/// One open device, opened with its forces off. The destructor leaves it with no force and its motors off.
class OpenDevice {
 public:
  explicit OpenDevice(const hdev_host& host) : host_(&host) {}
  virtual ~OpenDevice() = default;
  OpenDevice(const OpenDevice&) = delete;
  OpenDevice& operator=(const OpenDevice&) = delete;

  /// Slow threads; may throw Trouble. @{
  virtual void fill(hdev_info& info) const = 0;  // `info` comes zeroed
  virtual void calibrate(std::uint32_t /*timeout_ms*/) {}
  virtual void power(bool on) = 0;
  virtual std::string last_words() const { return {}; }  // about trouble in read() and write()
  /// @}

  /// Real-time thread. @{
  virtual void attach() noexcept {}
  /// @param state  comes blank: the identity, no temperature, calibrated, t_ns the present
  /// @return HDEV_OK, or HDEV_E_FAULT with state.fault, or another answer, which leaves the host's sample as it is
  virtual hdev_status read(hdev_state& state) noexcept = 0;
  virtual hdev_status write(const Effort& effort) noexcept = 0;
  /// @}

  /// Any thread, signal handlers too.
  virtual hdev_status stop() noexcept = 0;

  /// The process dies: as hdev_api.emergency_stop says. Enough where stop() itself is.
  virtual hdev_status emergency_stop(std::uint32_t /*within_us*/) noexcept { return stop(); }

  /// Whether the motors are known to be off. Any thread. As it is enough where there are none, or stop() cannot fail.
  virtual bool motors_are_off() const noexcept { return true; }

 protected:
  std::int64_t now_ns() const noexcept { return host_->now_ns(host_->user); }
  void log(int level, const std::string& line) const { host_->log(host_->user, level, line.c_str()); }

 private:
  const hdev_host* host_;
};

struct Driver {
  const char* name;
  const char* version;
  /// Ids that open() takes, of the devices found now. Throws Trouble, which also says what the driver lacks.
  std::vector<std::string> (*list)();
  /// @param id  "" is the first device
  std::unique_ptr<OpenDevice> (*open)(const hdev_host& host, const std::string& id, Options& options);
  /// As hdev_api.rescue says. Null where a second process can do nothing, or nothing has to be done. Throws Trouble.
  void (*rescue)(const hdev_host& host, const std::string& id, Options& options) = nullptr;
};

/// Defined by each driver.
const Driver& this_driver();

}  // namespace palpate::haptic::kit
