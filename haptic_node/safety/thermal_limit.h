#pragma once
// Less force for warm motors. A device whose motors reach their limit takes its force away from one tick to the next; so it
// is taken away gently before:
//
//   g = 1 up to T = warm,   (hot - T) / (hot - warm),   0 from hot on        T the temperature, 1 = the limit
//
// g falls as fast as a fade. It rises in free space only, where no spring is stretched that it would stretch further.

#include <algorithm>

namespace palpate::haptic {

class ThermalLimit {
 public:
  static constexpr double warm =
      0.8;  // Why: heat goes with the square of the force, so that at 0.875 a quarter is left of it
  static constexpr double hot = 0.95;  // Why: coils are hotter than what a sensor or a model beside them says
  static constexpr double fall = 20e-3;  // from 1 to 0 at most as fast [s]
  static constexpr double rise = 0.5;    // from 0 to 1 [s]

  /// @param temperature  1 = the limit; below 0 or not a number: unknown, g stays as it is
  /// @param touches      a spring is stretched
  /// @param period       of ticks [s]
  /// @return g
  double step(double temperature, bool touches, double period) noexcept {
    if (!(temperature >= 0)) return gain_;
    const double wanted = std::clamp((hot - temperature) / (hot - warm), 0.0, 1.0);
    if (wanted < gain_)
      gain_ = std::max(wanted, gain_ - period / fall);
    else if (!touches)
      gain_ = std::min(wanted, gain_ + period / rise);
    return gain_;
  }
  double gain() const noexcept { return gain_; }

 private:
  double gain_ = 1;
};

}  // namespace palpate::haptic
