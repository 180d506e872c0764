#pragma once
// What lags behind something that goes straight from d to d+ within a step: f' = (d - f) / tau,
//
//   f+ = keep f + first d + last d+,   u = dt / tau
//   keep = e^-u,   mean = (1 - e^-u) / u,   first = mean - keep,   last = 1 - mean
//
// since a d that is held leaves 1 - e^-u, and one that grows from 0 to 1 leaves 1 - mean.

#include <cmath>

namespace palpate {

struct LagStep {
  double keep = 1, mean = 1;

  /// @param dt, tau  > 0 [s]
  static LagStep over(double dt, double tau) noexcept {
    const double u = dt / tau;
    return {std::exp(-u), -std::expm1(-u) / u};
  }
  double first() const noexcept { return mean - keep; }
  double last() const noexcept { return 1 - mean; }
  /// f+ where d+ = 0
  double begun(double f, double d) const noexcept { return keep * f + first() * d; }
  /// f+
  double passed(double f, double d, double d_end) const noexcept { return begun(f, d) + last() * d_end; }
};

}  // namespace palpate
