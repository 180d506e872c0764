#include "bench/peers/equal_error.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace palpate::bench {

std::vector<TimeOfError> best_runs(std::vector<TimeOfError> runs) {
  std::sort(runs.begin(), runs.end(), [](const TimeOfError& a, const TimeOfError& b) {
    return std::tie(a.seconds, a.error) < std::tie(b.seconds, b.error);
  });
  std::vector<TimeOfError> best;
  for (const TimeOfError& run : runs)
    if (best.empty() || run.error < best.back().error) best.push_back(run);
  return best;
}

std::optional<double> seconds_for(const std::vector<TimeOfError>& best, double error) {
  if (best.empty() || error < best.back().error) return std::nullopt;
  if (error >= best.front().error) return best.front().seconds;
  const auto exact =
      std::find_if(best.begin(), best.end(), [error](const TimeOfError& run) { return run.error <= error; });
  const auto coarse = exact - 1;
  const double share = std::log(coarse->error / error) / std::log(coarse->error / exact->error);
  return coarse->seconds * std::pow(exact->seconds / coarse->seconds, share);
}

}  // namespace palpate::bench
