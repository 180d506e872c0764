#pragma once
// What the kernel has booked for the calling thread. Each call is one system call of about 0.3 us.

#include <sys/resource.h>
#include <time.h>

#include <cstdint>

namespace palpate::haptic {

/// CPU time of this thread [ns]: what it computed, however long others kept it waiting.
inline std::int64_t thread_cpu_ns() noexcept {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

struct ThreadUsage {
  std::uint64_t page_faults = 0;  // with and without a disk
  std::uint64_t preempted = 0;    // the kernel took the processor away from it (involuntary context switches)
};

inline ThreadUsage usage_of_this_thread() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return {static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt),
          static_cast<std::uint64_t>(usage.ru_nivcsw)};
}

}  // namespace palpate::haptic
