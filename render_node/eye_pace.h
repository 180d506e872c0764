#pragma once
// How many pictures a second a window draws: what the machine has left, never what tissue needs.

#include <algorithm>

#include "common/message/node_messages.h"

namespace palpate::render {

class EyePace {
 public:
  static constexpr double shortest_s = 1.0 / 60, first_s = 1.0 / 30,
                          longest_s = 1.0 / 15;  // between two pictures

  /// @param software  the processor does the drawing, and others want it
  explicit EyePace(bool software) : software_(software), period_s_(software ? first_s : shortest_s) {}

  /// Physics tells how it fares some times a second: where it does not keep real time pictures become fewer, where it does slowly
  /// more again. A report that was heard before, or of a world that stands still, changes nothing.
  void hear(const NodeStatus& physics) noexcept {
    if (!software_ || physics.phase != NodePhase::running || physics.t == heard_t_) return;
    heard_t_ = physics.t;
    constexpr double keeps_up =
        0.97;  // Why: it waits for its clock, so that a frame more or less in a report is nothing
    period_s_ = physics.real_time_factor < keeps_up ? std::min(1.25 * period_s_, longest_s)
                                                    : std::max(period_s_ / 1.05, shortest_s);
  }

  /// How long the processor is left to others after a picture: where it does the drawing at least as long as that took, at most a
  /// tenth of a second.
  double rest_s(double drew_s) const noexcept {
    const double rest = period_s_ - drew_s;
    return std::clamp(software_ ? std::max(rest, drew_s) : rest, 0.0, 0.1);
  }

 private:
  bool software_;
  double period_s_;
  double heard_t_ = -1;
};

}  // namespace palpate::render
