#include "bench/error/sweep.h"

#include <algorithm>
#include <cmath>

namespace palpate::bench {
namespace {

constexpr Integrator integrators[] = {Integrator::symplectic_euler, Integrator::velocity_verlet,
                                      Integrator::backward_euler};

/// Steps to try: the longest halved again and again; backward Euler, which needs no bound, from eight times that on.
std::vector<double> steps(const Problem& problem, Integrator integrator, bool quick) {
  const int halvings = quick ? std::min(problem.halvings, 3) : problem.halvings;
  const double longest = problem.longest_step * (integrator == Integrator::backward_euler ? 8 : 1);
  std::vector<double> all;
  for (int n = 0; n <= halvings; ++n) all.push_back(longest * std::pow(0.5, n));
  return all;
}

}  // namespace

std::vector<SweepRow> sweep(const SweepChoice& choice, const std::function<void(const SweepRow&)>& done) {
  std::vector<SweepRow> rows;
  for (const Problem& problem : problems()) {
    if (!choice.only.empty() && problem.name != choice.only) continue;
    for (const Integrator integrator : integrators)
      for (const Precision precision : {Precision::double_, Precision::single_})
        for (const int threads : {1, 2}) {
          // Threads change the time, not the bits: one look at the transients of many masses is enough.
          const bool wanted = threads == 1 || (problem.many_masses && precision == Precision::double_);
          if (!wanted || (choice.quick && (threads > 1 || precision == Precision::single_))) continue;
          for (const double step : steps(problem, integrator, choice.quick)) {
            const Settings settings{integrator, precision, step, threads};
            rows.push_back({problem.name, settings, problem.solve(settings)});
            done(rows.back());
          }
        }
  }
  return rows;
}

std::vector<ObservedOrder> observed_orders(const std::vector<SweepRow>& rows) {
  std::vector<ObservedOrder> orders;
  for (const Problem& problem : problems()) {
    if (!problem.smooth) continue;
    for (const Integrator integrator : integrators) {
      std::vector<std::pair<double, double>> points;  // step relative to the whole time, error
      for (const auto& row : rows)
        if (row.problem == problem.name && row.settings.integrator == integrator &&
            row.settings.precision == Precision::double_ && row.settings.threads == 1 &&
            row.outcome.error > 1e-11)
          points.emplace_back(1.0 / static_cast<double>(row.outcome.steps), row.outcome.error);
      std::sort(points.begin(), points.end());
      if (points.size() < 2 || points[1].first <= points[0].first) continue;
      orders.push_back(
          {problem.name, integrator,
           std::log(points[1].second / points[0].second) / std::log(points[1].first / points[0].first)});
    }
  }
  return orders;
}

}  // namespace palpate::bench
