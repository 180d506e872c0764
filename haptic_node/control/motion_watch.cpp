#include "haptic_node/control/motion_watch.h"

#include <algorithm>
#include <numbers>

#include "common/time/clock.h"

namespace palpate::haptic {

/// @return false for a sample that cannot be: not finite, no rotation, or too far from the last one
bool MotionWatch::believe(const DeviceSample& sample) noexcept {
  if (!sample.x.allFinite() || !sample.is_rotation || !sample.q.coeffs().allFinite()) return false;
  if (!ever_) {
    ever_ = true;
    x_ = sample.x;
    q_ = sample.q;
    t_ns_ = judged_ns_ = sample.t_ns;
    return true;
  }
  const double dt = seconds_from_ns(sample.t_ns - t_ns_);
  if (dt <= 0) return true;  // the same sample again
  const Vec3 moved = sample.x - x_;
  const double since = seconds_from_ns(sample.t_ns - judged_ns_);
  judged_ns_ = sample.t_ns;
  if (moved.norm() > jump_speed * std::max(since, period_)) return false;
  if (turn_between(q_, sample.q).norm() > turn_jump_speed * std::max(since, period_)) return false;

  // v += a (dx / dt - v), a = dt / (dt + 1 / (2 pi f)); after more than two missed ticks it begins anew
  if (dt > 3.5 * period_) v_.setZero();
  const double a = dt / (dt + 1.0 / (2.0 * std::numbers::pi * corner_Hz));
  v_ += a * (moved / dt - v_);
  x_ = sample.x;
  q_ = sample.q;
  t_ns_ = sample.t_ns;
  return true;
}

MotionVerdict MotionWatch::take(const DeviceSample& sample, std::int64_t now_ns) noexcept {
  cause_ = sample.lost ? FaultCause::lost : sample.fault != 0 ? cause_of(sample.fault) : sample.trouble;
  if (cause_ != FaultCause::none) return MotionVerdict::fault;
  if (sample.has_new) {
    if (believe(sample)) {
      jumps_ = 0;
    } else {
      ++rejected_;
      if (++jumps_ >= jumps_to_fault) {
        cause_ = FaultCause::impossible;
        return MotionVerdict::fault;
      }
    }
  }
  if (!ever_) return MotionVerdict::good;
  const double age = seconds_from_ns(now_ns - t_ns_);
  if (age > old_sample) v_.setZero();
  if (age > too_old_sample || v_.norm() > overspeed) return MotionVerdict::unsafe;
  return MotionVerdict::good;
}

}  // namespace palpate::haptic
