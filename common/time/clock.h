#pragma once
// The one clock of all stamps: CLOCK_MONOTONIC. Only differences on one machine mean anything.

#include <time.h>

#include <cstdint>

namespace palpate {

/// Nanoseconds of CLOCK_MONOTONIC.
inline std::int64_t now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

constexpr double seconds_from_ns(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }
constexpr std::int64_t ns_from_seconds(double s) {
  return static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5));
}

}  // namespace palpate
