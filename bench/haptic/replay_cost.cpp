#include "bench/haptic/replay_cost.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "haptic_node/tissue/tissue_touch.h"

namespace palpate::bench {
namespace {

double cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace

ReplayCost measure_replay(int modes, int answers) {
  constexpr std::uint64_t age = 100;
  haptic::TissueAnswer answer;
  answer.model.n_modes = static_cast<std::uint32_t>(modes);
  for (std::uint32_t i = 0; i < answer.model.n_modes; ++i)
    answer.model.modes[i] = {3, 4000.0 * (i + 1) * (i + 1), 20.0 * (i + 1)};
  answer.model.residual = 1e-4;
  haptic::TissueTouch touch({{500, 1}, 1e-3, 3, 0});
  std::vector<double> times;
  for (int n = 0; n < answers + static_cast<int>(age); ++n) {
    touch.tick(2e-3 + 0.5e-3 * std::sin(0.03 * n), 1.0);
    if (touch.history().newest() <= age) continue;
    answer.stamp = touch.history().newest() - age;
    const double begin = cpu_us();
    const bool taken = touch.take(answer);
    const double took = cpu_us() - begin;
    if (taken) times.push_back(took);
  }
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times[times.size() * 99 / 100]};
}

}  // namespace palpate::bench
