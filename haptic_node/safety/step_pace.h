#pragma once
// How far a hand goes in a tick along a direction, by the steps of its encoder: a step of q in n ticks says q / n, where
// the low-passed difference of positions springs to several times that at each step and sinks to nothing between two.
// Source: the period measurement of pulse encoders.

#include <algorithm>
#include <cmath>

namespace palpate::haptic {

class StepPace {
 public:
  /// Once a tick. @param way  between this sample and the last, with its sign [m]; 0: no step
  void pass(double way) noexcept {
    ++since_;
    if (way == 0) return;
    turned_ = way * step_ < 0;
    step_ = way;
    apart_ = since_;
    since_ = 0;
  }

  /// Ticks that a step takes: between the last two, or longer if the next one is late. At least 1.
  double ticks() const noexcept { return std::max({1.0, apart_, since_}); }
  /// Way in a tick [m].
  double way() const noexcept { return std::abs(step_) / ticks(); }
  /// The last step went back on the one before it: between the two the hand stood still.
  bool turned() const noexcept { return turned_; }

 private:
  double step_ = 0;  // [m]
  bool turned_ = false;
  double apart_ = 1, since_ = 0;  // [ticks]
};

}  // namespace palpate::haptic
