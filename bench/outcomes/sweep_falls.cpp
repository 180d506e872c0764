#include "bench/outcomes/sweep_falls.h"

#include <atomic>
#include <mutex>
#include <thread>

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
  std::atomic<std::size_t> next{0};
  std::size_t over = 0;
  std::mutex saying;
  const auto work = [&] {
    for (std::size_t n = next++; n < falls.size(); n = next++) {
      results[n] = run_fall(falls[n], seconds);
      const std::lock_guard lock(saying);
      done(++over);
    }
  };
  std::vector<std::jthread> team;
  for (int n = 0; n < jobs; ++n) team.emplace_back(work);
  team.clear();  // waits
  return results;
}

}  // namespace palpate::bench
