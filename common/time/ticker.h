#pragma once
// Wakes its thread at a steady rate by absolute times, so that errors do not add up. Deadlines that were missed are
// skipped, never made up for in a burst.

#include <time.h>

#include <cerrno>
#include <cstdint>

#include "common/time/clock.h"

namespace palpate {

class Ticker {
 public:
  struct Wake {
    std::int64_t due_ns = 0;    // when this tick should have begun
    std::int64_t woke_ns = 0;   // when it did
    std::uint64_t skipped = 0;  // deadlines between the last tick and this one
  };

  explicit Ticker(double rate_Hz) noexcept : period_ns_(ns_from_seconds(1.0 / rate_Hz)), next_ns_(now_ns()) {}

  std::int64_t period_ns() const noexcept { return period_ns_; }

  /// Moves all deadlines to come by so much.
  void shift(std::int64_t by_ns) noexcept { next_ns_ += by_ns; }
  /// From now on deadlines are whole periods after this moment.
  void align(std::int64_t moment_ns) noexcept { next_ns_ = moment_ns; }

  /// Sleeps until the next deadline.
  Wake wait() noexcept {
    next_ns_ += period_ns_;
    Wake wake;
    const std::int64_t behind = now_ns() - next_ns_;
    if (behind >= period_ns_) {
      wake.skipped = static_cast<std::uint64_t>(behind / period_ns_);
      next_ns_ += static_cast<std::int64_t>(wake.skipped) * period_ns_;
    }
    const timespec until{static_cast<time_t>(next_ns_ / 1'000'000'000),
                         static_cast<long>(next_ns_ % 1'000'000'000)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
    wake.due_ns = next_ns_;
    wake.woke_ns = now_ns();
    return wake;
  }

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_;
};

}  // namespace palpate
