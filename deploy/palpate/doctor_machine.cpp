#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "deploy/palpate/doctor.h"

namespace palpate::deploy {
namespace {

constexpr int trial_priority = 90;  // of the watchdog of the hand, the highest of all
constexpr rlim_t enough_locked_bytes = 64U << 20U;
constexpr int trial_ticks = 100;
constexpr long tick_ns = 1000000;
constexpr double good_lateness_us = 500;  // p90; half a tick

std::string processor_field(const std::string& name) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(':');
    if (line.rfind(name, 0) == 0 && colon != std::string::npos && colon + 2 <= line.size())
      return line.substr(colon + 2);
  }
  return {};
}

/// The file is deploy/limits.d/95-palpate.conf; the package palpate-base brings it and makes the group.
std::string mend_limits() {
  std::error_code error;
  if (std::filesystem::exists("/etc/security/limits.d/95-palpate.conf", error))
    return "join the group palpate (sudo adduser YOU palpate) and log in again";
  return "install the package palpate-base, or copy deploy/limits.d/95-palpate.conf to "
         "/etc/security/limits.d and make "
         "the group palpate; then join it (sudo adduser YOU palpate) and log in again";
}

bool has_word(const std::string& text, const std::string& word) {
  return (" " + text + " ").find(" " + word + " ") != std::string::npos;
}

/// Wake-up lateness of a thread that sleeps to absolute times 1 ms apart [us], sorted.
std::vector<double> measured_lateness() {
  std::vector<double> lateness;
  timespec due = {};
  clock_gettime(CLOCK_MONOTONIC, &due);
  for (int i = 0; i < trial_ticks; ++i) {
    due.tv_nsec += tick_ns;
    if (due.tv_nsec >= 1000000000L) due.tv_nsec -= 1000000000L, ++due.tv_sec;
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) != 0) {
    }
    timespec now = {};
    clock_gettime(CLOCK_MONOTONIC, &now);
    lateness.push_back(static_cast<double>(now.tv_sec - due.tv_sec) * 1e6 +
                       static_cast<double>(now.tv_nsec - due.tv_nsec) * 1e-3);
  }
  std::sort(lateness.begin(), lateness.end());
  return lateness;
}

}  // namespace

Finding check_processor() {
  const std::string flags = processor_field("flags");
  const char* width = has_word(flags, "avx512f") ? "AVX-512"
                      : has_word(flags, "avx2")  ? "AVX2"
                      : has_word(flags, "avx")   ? "AVX"
                                                 : "no AVX";
  const unsigned cores = std::thread::hardware_concurrency();
  const std::string what =
      fmt::format("{}, {}, {} core{}", processor_field("model name"), width, cores, cores == 1 ? "" : "s");
  if (cores >= 3) return {"processor", Finding::State::ok, what};
  return {"processor", Finding::State::lacks,
          what + "; the three nodes share them: prefer a machine with four or more"};
}

Finding check_real_time() {
  int failed = 0;
  std::thread([&failed] {
    sched_param parameter = {};
    parameter.sched_priority = trial_priority;
    failed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
  }).join();
  if (failed == 0)
    return {"real time", Finding::State::ok, fmt::format("SCHED_FIFO {} is allowed", trial_priority)};
  return {"real time", Finding::State::lacks,
          "no right to SCHED_FIFO, so the 1 kHz loop may stutter; " + mend_limits()};
}

Finding check_memory_lock() {
  rlimit limit = {};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return {"memory lock", Finding::State::ok, "unlimited"};
  const std::string what = fmt::format("{} kB", limit.rlim_cur / 1024);
  if (limit.rlim_cur >= enough_locked_bytes) return {"memory lock", Finding::State::ok, what};
  return {"memory lock", Finding::State::lacks,
          what + " may be locked, so the 1 kHz loop may wait for a page; " + mend_limits()};
}

Finding check_timer() {
  const auto lateness = measured_lateness();
  const auto at = [&](double fraction) {
    return lateness[static_cast<std::size_t>(fraction * static_cast<double>(lateness.size() - 1))];
  };
  const std::string what =
      fmt::format("{} ticks at 1 kHz came {:.0f} us late at the median, {:.0f} us at worst", lateness.size(),
                  at(0.5), lateness.back());
  if (at(0.9) < good_lateness_us) return {"timer", Finding::State::ok, what};
  return {"timer", Finding::State::lacks, what + "; close other programs, or use a kernel with PREEMPT_RT"};
}

}  // namespace palpate::deploy
