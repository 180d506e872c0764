#pragma once
// Time against error as a curve, and what it costs to be as exact as somebody else.

#include <optional>
#include <vector>

namespace palpate::bench {

struct TimeOfError {
  double error = 0;
  double seconds = 0;
};

/// The runs that no other run beats in both time and error, from coarse and fast to exact and slow.
std::vector<TimeOfError> best_runs(std::vector<TimeOfError> runs);

/// Time to reach `error`, between best runs on straight lines of log time over log error. A coarser answer than the
/// fastest run gives costs what that run costs. @return nothing where no run is that exact
std::optional<double> seconds_for(const std::vector<TimeOfError>& best, double error);

}  // namespace palpate::bench
