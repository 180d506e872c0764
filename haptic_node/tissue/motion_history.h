#pragma once
// The hand's last samples along the normal, by number, one tick h apart. Their velocity is the low-passed difference,
// with the pole where it belongs, since the damper's share of the force is its error:
//
//   v := v + (1 - e^(-2 pi f h)) ((x - x_before) / h - v)

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace palpate::haptic {

struct HandSample {
  double x = 0;  // depth into the tissue [m]
  double v = 0;  // smoothed [m/s]
};

class MotionHistory {
 public:
  /// Why: 128 ms cover frames at 20 Hz, 50 ms of way and three lost messages in a row; as much again for the way back.
  static constexpr std::uint64_t told = 128, kept = 256;

  static constexpr double corner_Hz = 100.0;

  explicit MotionHistory(double h) noexcept
      : h_(h), share_(-std::expm1(-2 * std::numbers::pi * corner_Hz * h)) {}

  /// The next sample at depth x [m]; the first has number 1 and stands still.
  void add(double x) noexcept {
    HandSample next{x, 0};
    if (newest_ > 0) {
      const HandSample& last = at(newest_);
      next.v = last.v + share_ * ((x - last.x) / h_ - last.v);
    }
    samples_[++newest_ % kept] = next;
  }

  std::uint64_t newest() const noexcept { return newest_; }  // 0: none yet
  bool has(std::uint64_t number) const noexcept {
    return number >= 1 && number <= newest_ && newest_ - number < kept;
  }
  /// @param number  one that it has
  const HandSample& at(std::uint64_t number) const noexcept { return samples_[number % kept]; }

 private:
  double h_, share_;
  std::array<HandSample, kept> samples_{};
  std::uint64_t newest_ = 0;
};

}  // namespace palpate::haptic
