#pragma once
// Whether the device's samples can be believed, and how fast the hand moves.

#include <cstdint>

#include "common/math/vec3.h"
#include "haptic_node/contact/hand_motion.h"
#include "haptic_node/control/fault_cause.h"

namespace palpate::haptic {

/// One look at a device, in the world frame.
struct DeviceSample {
  bool has_new = false;                   // false: the device had nothing newer
  bool lost = false;                      // unplugged
  std::uint32_t fault = 0;                // HDEV_FAULT_*
  FaultCause trouble = FaultCause::none;  // that the host has found by itself
  double temperature = -1;                // of the hottest motor, 1 = its limit; below 0: unknown
  std::int64_t t_ns = 0;                  // when it was measured
  Vec3 x = Vec3::Zero();                  // tip [m]
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  // attitude, unit
  bool is_rotation = true;                                // false: what the device calls its attitude is none
  bool powered = false;                                   // motors on
  bool held = true;                                       // a hand holds it, as far as the device can tell
  bool calibrated = true;
};

enum class MotionVerdict { good, unsafe, fault };

class MotionWatch {
 public:
  static constexpr double overspeed = 1.5;         // [m/s]
  static constexpr double jump_speed = 2.0;        // faster than a hand: 2 mm in a tick of 1 ms [m/s]
  static constexpr double turn_jump_speed = 60.0;  // [rad/s]
  static constexpr int jumps_to_fault = 3;         // in a row; samples that are not finite count as jumps
  static constexpr double old_sample = 5e-3;       // velocity counts as zero [s]
  static constexpr double too_old_sample = 20e-3;  // [s]
  static constexpr double corner_Hz = 100.0;       // of the low-pass of the velocity

  /// @param period  nominal time between ticks [s]
  explicit MotionWatch(double period) noexcept : period_(period) {}

  MotionVerdict take(const DeviceSample& sample, std::int64_t now_ns) noexcept;
  /// Why take() last said fault.
  FaultCause cause() const noexcept { return cause_; }

  bool ever() const noexcept { return ever_; }
  const Vec3& x() const noexcept { return x_; }  // last believed [m]
  const Vec3& v() const noexcept { return v_; }  // low-passed difference [m/s]
  const Eigen::Quaterniond& q() const noexcept { return q_; }
  HandMotion hand() const noexcept { return {x_, v_, q_}; }
  std::uint64_t rejected() const noexcept { return rejected_; }

 private:
  bool believe(const DeviceSample& sample) noexcept;

  double period_;
  bool ever_ = false;
  std::int64_t t_ns_ = 0;  // of the last believed
  std::int64_t judged_ns_ =
      0;  // of the last looked at that was finite: a hand that jumped for good is not let in later
  Vec3 x_ = Vec3::Zero();
  Vec3 v_ = Vec3::Zero();
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  int jumps_ = 0;
  FaultCause cause_ = FaultCause::none;
  std::uint64_t rejected_ = 0;
};

}  // namespace palpate::haptic
