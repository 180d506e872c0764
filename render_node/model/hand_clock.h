#pragma once
// One clock for the live plots: that of the hand's loop. A wrench does not carry it, but says which tick of the hand it
// answers, and the trace says when that was. So curves of tissue and hand lie above each other however slow physics is.

#include <cmath>
#include <cstdint>
#include <optional>

#include "common/message/messages.h"

namespace palpate::render {

class HandClock {
 public:
  /// @param rate_Hz  of the hand's loop, until it has shown its own
  explicit HandClock(double rate_Hz) : period_(1 / rate_Hz) {}

  /// A sample of the hand. One that lies before the last begins anew: another hand, or the same from the start.
  void note(const TraceSample& sample) {
    if (heard_ && sample.tick > newest_.tick && sample.t > newest_.t) {
      const auto ticks = static_cast<double>(sample.tick - newest_.tick);
      // Why: a loop that wakes late has uneven ticks; a tenth of each is their mean over some ten samples.
      if (ticks <= most_ticks) period_ += 0.1 * ((sample.t - newest_.t) / ticks - period_);
    }
    newest_ = {sample.tick, sample.t};
    heard_ = true;
  }

  /// Time of the hand at one of its ticks [s]; nothing before it has spoken, for tick 0 (no hand was answered), and for ticks
  /// that are too far from its newest one to be of the same hand.
  std::optional<double> at(std::uint64_t tick) const {
    if (!heard_ || tick == 0) return std::nullopt;
    const double ahead = tick >= newest_.tick ? static_cast<double>(tick - newest_.tick)
                                              : -static_cast<double>(newest_.tick - tick);
    if (std::abs(ahead) > most_ticks) return std::nullopt;
    return newest_.t + ahead * period_;
  }

 private:
  static constexpr double most_ticks = 5000;
  struct Sample {
    std::uint64_t tick = 0;
    double t = 0;
  };
  Sample newest_;
  bool heard_ = false;
  double period_;  // of a tick [s]
};

}  // namespace palpate::render
