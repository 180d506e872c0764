#include "bench/team/measure_team.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "bench/problems/cube.h"
#include "bench/problems/median.h"
#include "bench/team/crowd.h"
#include "physics_node/step/team_choice.h"

namespace palpate::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t ns_since(Clock::time_point begin) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin).count();
}

/// @return wall time of a step [us]
double run(Cube& cube, physics::TeamChoice& choice, double seconds) {
  const auto begin = Clock::now();
  std::int64_t steps = 0;
  while (static_cast<double>(ns_since(begin)) < 1e9 * seconds) {
    const auto start = Clock::now();
    step(cube, choice.threads());
    choice.took(ns_since(start));
    ++steps;
  }
  return 1e-3 * static_cast<double>(ns_since(begin)) / static_cast<double>(steps);
}

}  // namespace

TeamCost measure_team(double masses, int threads, int busy, double seconds, int rounds) {
  const CubeKind kind{.work = Work::damped, .masses = masses};
  Cube cube = make_cube(kind);
  set_moving(kind, cube, threads);
  TeamCost cost{.masses = cube.body->body().lattice.n_masses(), .busy = busy, .threads = threads};
  const Crowd crowd(busy);
  physics::TeamChoice one = physics::TeamChoice::always(1), team = physics::TeamChoice::always(threads),
                      chosen = physics::TeamChoice::up_to(threads);
  std::vector<double> one_us, team_us, chosen_us, team_ratio, chosen_ratio;
  for (int round = 0; round < rounds; ++round) {
    one_us.push_back(run(cube, one, seconds));
    team_us.push_back(run(cube, team, seconds));
    chosen_us.push_back(run(cube, chosen, seconds));
    team_ratio.push_back(team_us.back() / one_us.back());
    chosen_ratio.push_back(chosen_us.back() / one_us.back());
  }
  cost.one_us = median(one_us);
  cost.team_us = median(team_us);
  cost.chosen_us = median(chosen_us);
  cost.team_ratio = median(team_ratio);
  cost.chosen_ratio = median(chosen_ratio);
  cost.mean_threads = chosen.mean_threads();
  return cost;
}

Handover measure_handover(int threads) {
  physics::Team team(threads);
  const auto call_us = [&team](int used) {
    const auto start = Clock::now();
    team.each(2, used, [](std::size_t) { asm volatile("" ::: "memory"); });
    return 1e-3 * static_cast<double>(ns_since(start));
  };
  std::vector<double> spinning, sleeping, alone;
  for (int n = 0; n < 5000; ++n) spinning.push_back(call_us(threads));
  for (int n = 0; n < 5000; ++n) alone.push_back(call_us(1));
  for (int n = 0; n < 300; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    sleeping.push_back(call_us(threads));
  }
  return {median(spinning), median(sleeping), median(alone)};
}

}  // namespace palpate::bench
