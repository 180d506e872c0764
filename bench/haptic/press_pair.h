#pragma once
// The pair of plots of the method: a handle of 60 g pushed by 1 N onto a static wall of 600 N/m, once with the force
// computed by physics at 50 Hz and held, once with a local plane at 1 kHz.

#include <vector>

#include "bench/haptic/trial.h"

namespace palpate::bench {

struct PressSample {
  double t = 0;      // [s]
  double force = 0;  // [N]
  double z = 0;      // [m]
};

std::vector<PressSample> press_with_60_grams(RenderMode mode);

/// Largest less least force from `since` on [N].
double force_range(const std::vector<PressSample>& samples, double since);

}  // namespace palpate::bench
