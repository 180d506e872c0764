#pragma once
// The hand's last samples, along a normal or in space, by number, one tick h apart. Their velocity is the low-passed difference,
// with the pole where it belongs, since the damper's share of the force is its error:
//
//   v := v + (1 - e^(-2 pi f h)) ((x - x_before) / h - v)

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/math/vec3.h"

namespace palpate::haptic {

struct HandSample {
  double x = 0;  // depth into the tissue [m]
  double v = 0;  // smoothed [m/s]
};

struct TipSample {
  Vec3 x = Vec3::Zero();  // [m]
  Vec3 v = Vec3::Zero();  // smoothed [m/s]
};

template <class Sample>
class History {
 public:
  using Place = decltype(Sample::x);

  /// Why: 128 ms cover frames at 20 Hz, 50 ms of way and three lost messages in a row; as much again for the way back.
  static constexpr std::uint64_t told = 128, kept = 256;

  static constexpr double corner_Hz = 100.0;

  explicit History(double h) noexcept : h_(h), share_(-std::expm1(-2 * std::numbers::pi * corner_Hz * h)) {}

  /// The next sample at x [m]; the first has number 1 and stands still.
  void add(const Place& x) noexcept {
    Sample next;
    next.x = x;
    if (newest_ > 0) {
      const Sample& last = at(newest_);
      next.v = last.v + share_ * ((x - last.x) / h_ - last.v);
    }
    samples_[++newest_ % kept] = next;
  }

  /// Becomes what another one is along something. @param along  its sample -> one of these
  template <class Other, class Along>
  void follow(const History<Other>& other, const Along& along) noexcept {
    newest_ = other.newest();
    for (std::uint64_t number = newest_; other.has(number); --number)
      samples_[number % kept] = along(other.at(number));
  }

  std::uint64_t newest() const noexcept { return newest_; }  // 0: none yet
  bool has(std::uint64_t number) const noexcept {
    return number >= 1 && number <= newest_ && newest_ - number < kept;
  }
  /// @param number  one that it has
  const Sample& at(std::uint64_t number) const noexcept { return samples_[number % kept]; }

 private:
  double h_, share_;
  std::array<Sample, kept> samples_{};
  std::uint64_t newest_ = 0;
};

using MotionHistory = History<HandSample>;
using TipHistory = History<TipSample>;

}  // namespace palpate::haptic
