#pragma once
// Many falls, side by side.

#include <functional>
#include <vector>

#include "bench/outcomes/fall.h"

namespace palpate::bench {

/// Yield strains and gaps in steps of about sqrt(2) and 2, at each speed.
std::vector<Fall> fall_grid(const std::vector<double>& speeds);

/// Runs them in `jobs` threads at a time. @param done  called from one thread at a time with how many are over
/// @return in the order of `falls`, which the number of threads does not change
std::vector<FallResult> run_falls(const std::vector<Fall>& falls, double seconds, int jobs,
                                  const std::function<void(std::size_t)>& done);

}  // namespace palpate::bench
