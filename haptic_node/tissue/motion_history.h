#pragma once
// The hand's last samples, by number, one tick h apart: where the handle is, and how fast. Velocities are low-passed differences, with the pole
// where it belongs, since the damper's share of the force is its error:
//
//   v := v + (1 - e^(-2 pi f h)) ((x - x_before) / h - v)

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "haptic_node/contact/hand_motion.h"

namespace palpate::haptic {

/// A point that moves with the handle.
struct TipSample {
  Vec3 x = Vec3::Zero();  // [m]
  Vec3 v = Vec3::Zero();  // smoothed [m/s]
};

/// The tip, and the handle that it belongs to.
struct HandleSample : TipSample {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Vec3 turning = Vec3::Zero();  // smoothed [rad/s]

  /// @param arm  from the tip, in the frame of the handle [m]
  TipSample point(const Vec3& arm) const noexcept {
    const Vec3 a = q * arm;
    return {x + a, v + turning.cross(a)};
  }
};

class TipHistory {
 public:
  /// Why: 128 ms cover frames at 20 Hz, 50 ms of way and three lost messages in a row; as much again for the way back.
  static constexpr std::uint64_t told = 128, kept = 256;

  static constexpr double corner_Hz = 100.0;

  explicit TipHistory(double h) noexcept
      : h_(h), share_(-std::expm1(-2 * std::numbers::pi * corner_Hz * h)) {}

  /// The next sample; the first has number 1 and stands still. @param x  tip [m]  @param q  of the handle, unit
  void add(const Vec3& x, const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) noexcept {
    HandleSample next;
    next.x = x;
    next.q = q;
    if (newest_ > 0) {
      const HandleSample& last = at(newest_);
      next.v = last.v + share_ * ((x - last.x) / h_ - last.v);
      next.turning = last.turning + share_ * (turn_between(last.q, q) / h_ - last.turning);
    }
    samples_[++newest_ % kept] = next;
  }

  std::uint64_t newest() const noexcept { return newest_; }  // 0: none yet
  bool has(std::uint64_t number) const noexcept {
    return number >= 1 && number <= newest_ && newest_ - number < kept;
  }
  /// @param number  one that it has
  const HandleSample& at(std::uint64_t number) const noexcept { return samples_[number % kept]; }

 private:
  double h_, share_;
  std::array<HandleSample, kept> samples_{};
  std::uint64_t newest_ = 0;
};

}  // namespace palpate::haptic
