#pragma once
// Motors off without the vendor's thread, which hangs in a call of its own library or calls back no more. Two threads
// are kept ready, since the library may hang for whoever calls it: one switches the force output off; should that not
// come back, the other one disables the device, which is known to stop nothing but lets another process have it.
// Neither begins or ends a frame: where one call of a frame hangs, they all may.

#include <atomic>
#include <cstdint>
#include <thread>

#include "haptic_node/drivers/kit/emergency.h"
#include "haptic_node/drivers/openhaptics/hd.h"

namespace palpate::haptic::openhaptics {

class HdStopper {
 public:
  /// Without a finished frame, after which the vendor's thread is not waited for. Why: eight frames at 1 kHz, which a thread
  /// that lives finishes on a busy machine, too; with what comes after it, a hand is free within 30 ms.
  static constexpr std::int64_t late_ns = 8'000'000;
  /// For a frame that has just begun to end, as the process may have been stopped.
  static constexpr std::uint32_t settle_us = 2000;
  /// For hdDisable, before hdDisableDevice is tried beside it.
  static constexpr std::uint32_t disable_within_us = 5000;

  /// @param hd  outlives this
  explicit HdStopper(const Hd& hd);
  /// Waits for both threads: for ever, if the library holds one.
  ~HdStopper();
  HdStopper(const HdStopper&) = delete;
  HdStopper& operator=(const HdStopper&) = delete;

  /// From now on there is a device to be stopped.
  void watch(HHD device) noexcept { device_.store(device); }

  /// The vendor's thread, at the end of each of its callbacks.
  void frame_ends() noexcept { frame_ns_.store(kit::clock_ns()); }
  /// The same, before it switches the motors on, and when it has switched them off.
  void motors_on() noexcept { off_.store(false), zero_owed_.store(true); }
  void motors_off() noexcept { off_.store(true); }

  /// Motors off: by the vendor's next frame, else from here. Any thread, signal handlers too; returns at once.
  void ask() noexcept;
  /// In the calling thread. A signal handler's last resort: it may never return.
  void switch_off_here() noexcept;

  /// No frame has ended for late_ns.
  bool is_late() const noexcept { return kit::clock_ns() - frame_ns_.load() > late_ns; }
  /// The motors are known to be off.
  bool is_off() const noexcept { return off_.load(); }
  /// The library is being called from here: frames do nothing.
  bool is_busy() const noexcept { return busy_.load(); }
  /// The device has been disabled, and must not be used any more.
  bool has_disabled_device() const noexcept { return disabled_device_.load(); }
  /// Once for each time that the motors were on: a frame owes the device no force before they go on again.
  bool take_zero_owed() noexcept { return zero_owed_.exchange(false); }

 private:
  void keep_ready_to_disable() noexcept;
  void keep_ready_to_disable_device() noexcept;

  const Hd& hd_;
  kit::Bell wake_, wake_second_;
  std::atomic<HHD> device_{HD_INVALID_HANDLE};
  std::atomic<std::int64_t> frame_ns_{0};
  std::atomic<bool> asked_{false}, off_{true}, busy_{false}, leaving_{false};
  std::atomic<bool> disabled_device_{false}, zero_owed_{false};
  std::thread first_, second_;
};

}  // namespace palpate::haptic::openhaptics
