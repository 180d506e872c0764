#include "bench/haptic/solver_cost.h"

#include <algorithm>
#include <random>
#include <vector>

#include "bench/haptic/thread_time.h"
#include "haptic_node/contact/plane_projection.h"

namespace palpate::bench {

SolverCost measure_solver(int sets) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> g;
  const auto vector = [&] { return Vec3(g(random), g(random), g(random)); };
  std::vector<double> times;
  for (int i = 0; i < sets; ++i) {
    std::array<haptic::HalfSpace, haptic::max_planes> planes;
    for (auto& plane : planes) plane = {vector().normalized(), 0.01 * vector()};
    const Vec3 x = 0.01 * vector();
    const double begin = thread_us();
    const bool feasible = haptic::project_out(planes, x).feasible;
    const double took = thread_us() - begin;
    if (feasible) times.push_back(took);
  }
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times[times.size() * 99 / 100]};
}

}  // namespace palpate::bench
