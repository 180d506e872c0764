#pragma once
// Ticks truly done in a second of wall clock, over the last second: a loop that stands still counts as one.

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/time/clock.h"

namespace palpate::haptic {

class RateMeter {
 public:
  /// Asked some times a second. @param ticks  done so far
  /// @return per second, over the last second or as long as it has been asked; 0 the first time
  double take(std::uint64_t ticks, std::int64_t now) noexcept {
    // The newest mark that is a second old, or else the oldest one.
    while (n_ > 1 && now - marks_[(first_ + 1) % marks_.size()].t_ns >= 1'000'000'000) drop();
    const Mark from = n_ > 0 ? marks_[first_] : Mark{ticks, now};
    if (n_ == marks_.size()) drop();
    marks_[(first_ + n_++) % marks_.size()] = {ticks, now};
    const double seconds = seconds_from_ns(now - from.t_ns);
    return seconds > 0 ? static_cast<double>(ticks - from.ticks) / seconds : 0.0;
  }

 private:
  struct Mark {
    std::uint64_t ticks = 0;
    std::int64_t t_ns = 0;
  };
  void drop() noexcept {
    first_ = (first_ + 1) % marks_.size();
    --n_;
  }

  std::array<Mark, 16> marks_{};
  std::size_t first_ = 0, n_ = 0;
};

}  // namespace palpate::haptic
