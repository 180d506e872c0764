#pragma once
// For a driver's emergency_stop(): what a signal handler may do while it waits for a thread that is still alive.

#include <time.h>

#include <cstdint>

namespace palpate::haptic::kit {

/// Looks five times a millisecond whether it is done. Safe in a signal handler if `done` is. @return whether it is
template <class Done>
bool comes_true(Done&& done, std::uint32_t within_us) noexcept {
  const auto now_us = [] {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
  };
  const std::int64_t end = now_us() + within_us;
  while (!done()) {
    if (now_us() >= end) return false;
    const timespec rest{0, 200'000};
    nanosleep(&rest, nullptr);
  }
  return true;
}

}  // namespace palpate::haptic::kit
