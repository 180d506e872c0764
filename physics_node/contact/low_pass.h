#pragma once
// First-order low passes, one and two in a row, that do not mind how long a frame is:
//
//   y := y + a (x - y),   a = 1 - e^(-2 pi f dt)

#include <cmath>
#include <numbers>

namespace palpate::physics {

/// a of a low pass at `cutoff_Hz` over `seconds`.
inline double low_pass_part(double cutoff_Hz, double seconds) noexcept {
  return 1 - std::exp(-2 * std::numbers::pi * cutoff_Hz * seconds);
}

/// Two in a row over a vector. Begins at zero.
template <class Vector>
class TwiceLowPassed {
 public:
  void pass(const Vector& now, double part) noexcept {
    once_ += part * (now - once_);
    twice_ += part * (once_ - twice_);
  }
  const Vector& value() const noexcept { return twice_; }

 private:
  Vector once_ = Vector::Zero(), twice_ = Vector::Zero();
};

}  // namespace palpate::physics
