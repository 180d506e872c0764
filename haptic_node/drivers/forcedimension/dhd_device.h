#pragma once
// One Force Dimension device. The host's thread talks to it directly: one position, one status and one force a tick. The
// controller in the device lets go by itself when forces stop coming (its watchdog), which no fault of ours can prevent.

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "haptic_node/drivers/forcedimension/dhd.h"
#include "haptic_node/drivers/forcedimension/dhd_models.h"
#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/kit/emergency.h"

namespace palpate::haptic::forcedimension {

/// Motors off from outside, after the process that had the device open has died. @throws kit::Trouble
void rescue_device(const Dhd& dhd, const std::string& id);

class DhdDevice final : public kit::OpenDevice {
 public:
  static constexpr double watchdog_tick = 125e-6;       // unit of the device's watchdog [s]
  static constexpr unsigned char watchdog_ticks = 240;  // 30 ms; one byte holds no more than 31.9 ms
  static constexpr int transfers_to_lost = 20;          // failed ones in a row
  /// Samples in a row that say "no force" although it was switched on, without a cause that libdhd knows. Why: 50 ms at 1 kHz,
  /// ten times what a command takes to come back in the status.
  static constexpr int offs_to_fault = 50;
  /// For dhdEnableForce, before dhdStop is tried beside it.
  static constexpr std::uint32_t disable_within_us = 2000;

  /// @param dhd  outlives the device
  /// @throws kit::Trouble
  DhdDevice(const hdev_host& host, const Dhd& dhd, const std::string& id);
  ~DhdDevice() override;

  void fill(hdev_info& info) const override { info = info_; }
  void calibrate(std::uint32_t timeout_ms) override;
  void power(bool on) override;
  std::string last_words() const override;

  hdev_status read(hdev_state& state) noexcept override;
  hdev_status write(const kit::Effort& effort) noexcept override;
  hdev_status stop() noexcept override;
  hdev_status emergency_stop(std::uint32_t within_us) noexcept override;
  bool motors_are_off() const noexcept override;

 private:
  void say_what_it_is();
  bool measure(hdev_state& state) noexcept;
  std::uint32_t faults(const int* status) noexcept;
  std::uint32_t because(std::uint32_t fault, const char* why) noexcept;
  hdev_status failed() noexcept;
  hdev_status gone(const char* why) noexcept;
  void keep_ready_to_stop() noexcept;
  void keep_ready_to_brake() noexcept;
  void switch_off() noexcept;

  const Dhd& dhd_;
  char id_ = 0;
  Model model_;
  hdev_info info_{};
  // stop() may be called from a signal handler, where libdhd may not: it wakes the first thread, which calls libdhd. The second
  // one has its turn if that call does not come back.
  std::thread stopper_, braker_;
  kit::Bell wake_, wake_braker_;
  std::atomic<bool> leaving_{false};
  std::atomic<bool> powered_{false};
  std::atomic<bool> off_{true};            // and the device has been told so
  std::atomic<std::int64_t> force_ns_{0};  // when it was told a force last
  std::atomic<bool> doomed_{false};        // the process is dying: motors stay off
  std::atomic<bool> lost_{false};
  std::atomic<bool> calibrated_{false};
  std::uint64_t seq_ = 0;
  std::atomic<int> failed_in_a_row_{0};
  int offs_in_a_row_ = 0;
  // Of the newest trouble, static text. libdhd keeps its last error for each thread: what it says is taken where it failed.
  std::atomic<const char*> why_{""};
};

}  // namespace palpate::haptic::forcedimension
