#pragma once
// CPU time of all threads of this process, and wall time.

#include <chrono>
#include <ctime>

namespace palpate::bench {

class Stopwatch {
 public:
  double cpu_s() const { return cpu_now() - cpu_; }
  double wall_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }

 private:
  static double cpu_now() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  double cpu_ = cpu_now();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

}  // namespace palpate::bench
