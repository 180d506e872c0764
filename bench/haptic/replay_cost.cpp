#include "bench/haptic/replay_cost.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/haptic/thread_time.h"
#include "haptic_node/tissue/tissue_touch.h"

namespace palpate::bench {

ReplayCost measure_replay(int modes, int answers) {
  constexpr std::uint64_t age = 100;
  haptic::TissueAnswer answer;
  answer.model.n_modes = static_cast<std::uint32_t>(modes);
  for (std::uint32_t i = 0; i < answer.model.n_modes; ++i)
    answer.model.modes[i] = {Vec3(0.5, 0.2, -3), 4000.0 * (i + 1) * (i + 1), 20.0 * (i + 1)};
  answer.model.residual = 7e-3, answer.model.growth = 15;  // a ball of 5 mm on 30 kPa
  answer.model.residual_across = 5e-3;
  answer.model.friction = 0.3;
  haptic::TissueTouch touch({{500, 1}, 1e-3, 3, 0});
  std::vector<double> times;
  for (int n = 0; n < answers + static_cast<int>(age); ++n) {
    touch.tick(Vec3(1e-3 * std::sin(0.02 * n), 0, -2e-3 - 0.5e-3 * std::sin(0.03 * n)), 1.0);
    if (touch.history().newest() <= age) continue;
    answer.stamp = touch.history().newest() - age;
    const double begin = thread_us();
    const bool taken = touch.take(answer);
    const double took = thread_us() - begin;
    if (taken) times.push_back(took);
  }
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times[times.size() * 99 / 100]};
}

}  // namespace palpate::bench
