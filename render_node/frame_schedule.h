#pragma once
// When the next picture is due, in simulated time.

#include <cmath>
#include <cstdint>

namespace palpate::render {

class FrameSchedule {
 public:
  /// @param rate_Hz  pictures per simulated second, > 0
  explicit FrameSchedule(double rate_Hz) : period_(1.0 / rate_Hz) {}

  /// True once for every period that begins, and for the first call. Periods that passed unseen are counted, not
  /// made up for. A time before the last one (a reset) starts anew.
  bool due(double t) {
    const auto period = static_cast<std::int64_t>(std::floor(t / period_ + 1e-6));
    if (started_ && period == last_) return false;
    if (started_ && period > last_) skipped_ += static_cast<std::uint64_t>(period - last_ - 1);
    started_ = true;
    last_ = period;
    return true;
  }

  std::uint64_t skipped() const noexcept { return skipped_; }

 private:
  double period_;
  bool started_ = false;
  std::int64_t last_ = 0;
  std::uint64_t skipped_ = 0;
};

}  // namespace palpate::render
