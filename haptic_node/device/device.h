#pragma once
// One open device behind its driver: opens, asks what it is, and makes sure that it is closed with its forces off.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "haptic_node/device/bounded_call.h"
#include "haptic_node/device/driver_library.h"
#include "haptic_node/device/haptic_device.h"

namespace palpate::haptic {

/// The time, real or simulated, as drivers and the controller see it [ns].
using ClockFunction = std::int64_t (*)(void* user);

/// For a person at a device whose driver could not stop it.
inline constexpr const char* motors_may_be_on =
    "ITS MOTORS MAY STILL BE ON: let go, press its emergency stop or pull its plug";

/// How another process finds a device: its driver, and what open() was told.
struct RescueWords {
  std::string driver;  // name
  std::string file;    // of the driver
  std::string id;
  std::vector<std::string> pairs;  // key, value, key, value, ...
  bool shared = false;             // HDEV_CAP_SHARED
};

class Device {
 public:
  using Options = std::vector<std::pair<std::string, std::string>>;

  /// For a driver to close its device. Why: what a person asked to end is gone within a second, and a vendor's library may
  /// block for ever; those that work take some 10 ms.
  static constexpr std::chrono::milliseconds close_within{500};

  /// For motors to be off after stop(), before a person is told that they may be on. Why: drivers take 15 ms where one call of a
  /// vendor's library hangs, and a busy machine as much again.
  static constexpr std::chrono::milliseconds off_within{50};

  /// Opens and calibrates; forces stay off.
  /// @param options  keys and values for the driver; "id" picks the device instead of the first one
  /// @throws InputError with the driver's own words, beginning with `place` where given
  Device(const DriverLibrary& library, const Options& options, ClockFunction now_ns, void* user,
         const std::string& place);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const hdev_info& info() const noexcept { return info_; }
  bool can(std::uint32_t capability) const noexcept { return (info_.caps & capability) != 0; }

  /// Motors on or off; not from the real-time thread. @return HDEV_OK or why not
  hdev_status enable_force(bool on) noexcept;

  /// Real-time thread. @{
  hdev_status rt_attach() noexcept { return api_->rt_attach(handle_); }
  hdev_status read(hdev_state& state) noexcept { return api_->read(handle_, &state, 0); }
  hdev_status write(const hdev_command& command) noexcept { return api_->write(handle_, &command); }
  /// @}

  /// Motors off now; any thread.
  void stop() noexcept;
  /// Whether they are known to be off; the thread that owns this. Once it is being closed: what was known then, until it is.
  bool motors_off() const noexcept;

  /// The process dies: motors off, from a signal handler on any thread (see haptic_device.h). @return whether they are
  /// known to be off; of a driver without that function, its own word
  bool emergency_stop(std::uint32_t within_us) noexcept;
  /// Whether another process can switch the motors off once this one has gone; by these words.
  bool can_be_rescued() const noexcept { return api_->rescue != nullptr; }
  const RescueWords& rescue_words() const noexcept { return words_; }

  /// The driver's own words about its trouble; "" if it has none. Slow threads only; one line.
  std::string last_words() const;

  /// After stop(), which comes at once where what follows may hang. Motors off, device released: by a thread of its own, which begins at once.
  /// @param answers  the device still answers, and is written no force first
  void begin_close(bool answers) noexcept;
  /// Begins if need be, waits until close_within is over. Safe to repeat.
  /// @return false if the driver has not come back: a line has said so, and the device is that thread's for good
  bool close() noexcept;
  bool is_open() const noexcept { return handle_ != nullptr; }

 private:
  bool becomes_off() const noexcept;

  const hdev_api* api_;
  std::string name_;                 // of the driver
  std::shared_ptr<hdev_host> host_;  // lent to the driver until it has closed, however long that takes
  hdev* handle_ = nullptr;
  hdev_info info_{};
  RescueWords words_;
  std::optional<BoundedCall> closing_;
  std::chrono::steady_clock::time_point close_by_;
  bool off_before_closing_ = true;
  bool told_ = false;
};

}  // namespace palpate::haptic
