#include "bench/outcomes/sweep_falls.h"

#include "bench/problems/side_by_side.h"

namespace palpate::bench {

std::vector<Fall> fall_grid(const std::vector<double>& speeds) {
  std::vector<Fall> falls;
  for (const double speed : speeds)
    for (const double yield_strain : {0.005, 0.01, 0.02, 0.035, 0.05, 0.075, 0.1, 0.15, 0.25, 0.5})
      for (const double gap : {0.005, 0.01, 0.02, 0.035, 0.05, 0.1, 0.15, 0.25, 0.5, 1.0})
        falls.push_back({1 + yield_strain, gap, speed});
  return falls;
}

std::vector<FallResult> run_falls(const std::vector<Fall>& falls, double seconds, int jobs,
                                  const std::function<void(std::size_t)>& done) {
  std::vector<FallResult> results(falls.size());
  side_by_side(
      falls.size(), jobs, [&](std::size_t n) { results[n] = run_fall(falls[n], seconds); }, done);
  return results;
}

}  // namespace palpate::bench
