#pragma once
// One device behind libHD. The vendor's scheduler thread owns it: each of its ticks is one frame that measures the hand
// and sets the force. The host's thread meets it in two triple buffers, so that neither waits; a force is felt in the
// tick after the one in which it was written.

#include <atomic>
#include <cstdint>
#include <string>

#include "common/exchange/triple_buffer.h"
#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/openhaptics/hd_scheduler.h"
#include "haptic_node/drivers/openhaptics/hd_stopper.h"

namespace palpate::haptic::openhaptics {

class HdDevice final : public kit::OpenDevice {
 public:
  /// Silence of the host after which the force is none. The host itself starts anew after as much.
  static constexpr std::int64_t silence_ns = 20'000'000;
  /// Failed transfers in a row after which the device counts as unplugged.
  static constexpr int transfers_to_lost = 20;
  /// Without a frame, after which the vendor's scheduler counts as dead. Why: a hundred frames; its thread may have no more
  /// rights than any other on a busy machine. The host must have asked in vain as well: a process that was stopped finds its
  /// own threads as late as the vendor's.
  static constexpr std::int64_t dead_ns = 100'000'000;
  static constexpr int reads_to_dead = 50;
  /// Frames between two questions whether the forces are still on, and after switching them on before the first one.
  static constexpr std::uint64_t frames_between_looks = 10, frames_to_settle = 100;

  /// @throws kit::Trouble
  HdDevice(const hdev_host& host, const Hd& hd, const std::string& name, unsigned long rate_Hz);
  ~HdDevice() override;

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
  struct Sample {
    hdev_state state{};
    hdev_status status = HDEV_OK;
  };
  struct Order {
    kit::Effort effort;
    std::int64_t t_ns = 0;
  };
  static unsigned int frame(void* self);
  static void prepare(void* self);
  void measure(hdev_state& state) const noexcept;
  void set_effort(const kit::Effort& effort) const noexcept;
  kit::Effort effort_due(std::int64_t now) noexcept;
  void heed_errors(Sample& sample) noexcept;
  void look_at_force_output() noexcept;
  bool is_dead() noexcept;
  bool may_force() const noexcept;
  void switch_motors(bool wanted, bool were_on) noexcept;

  const Hd& hd_;
  hdev_info info_{};
  unsigned long rate_Hz_;
  ScheduledDevice scheduled_;
  HdStopper stopper_;

  TripleBuffer<Sample> samples_;  // vendor's thread -> host's
  TripleBuffer<Order> orders_;    // host's thread -> vendor's
  std::uint64_t last_seq_ = 0;    // host's, as the next two
  std::int64_t heard_ns_ = 0;     // of the newest sample
  int reads_in_vain_ = 0;         // since then
  std::atomic<bool> wanted_{false}, powered_{false}, lost_{false};
  std::atomic<bool> doomed_{false};  // the process is dying: motors stay off
  std::atomic<int> scheduler_thread_{0};
  std::atomic<bool> dead_{false};         // the vendor's scheduler
  std::atomic<bool> dropped_{false};      // the device switched its forces off by itself
  std::atomic<bool> leave_alone_{false};  // frames do nothing any more
  std::atomic<std::uint32_t> calibration_{HDEV_CAL_NEEDED};
  std::atomic<unsigned int> last_code_{HD_SUCCESS};   // of the newest error
  std::atomic<unsigned int> fault_code_{HD_SUCCESS};  // of the first that took the forces away
  // Vendor's thread:
  std::uint64_t seq_ = 0;
  std::uint64_t on_since_ = 0;  // frame in which the forces were switched on
  std::uint32_t fault_ = 0;
  int failed_in_a_row_ = 0;
};

}  // namespace palpate::haptic::openhaptics
