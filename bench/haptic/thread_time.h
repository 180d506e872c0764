#pragma once
// CPU time of this thread: for single calls of microseconds.

#include <ctime>

namespace palpate::bench {

inline double thread_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace palpate::bench
