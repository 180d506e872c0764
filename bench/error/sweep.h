#pragma once
// Reference problems swept over integrator, step, precision and threads, and the spacing where it matters.

#include <string>
#include <vector>

#include "bench/problems/problems.h"

namespace palpate::bench {

struct SweepRow {
  std::string problem;
  Settings settings;
  Outcome outcome;
};

struct ObservedOrder {
  std::string problem;
  Integrator integrator = Integrator::symplectic_euler;
  double order = 0;
};

struct SweepChoice {
  std::string only;    // a problem's name; empty: all
  bool quick = false;  // fewer halvings of the step, one thread, double only
};

/// Solves all; calls `done` after each row.
std::vector<SweepRow> sweep(const SweepChoice& choice, const std::function<void(const SweepRow&)>& done);

/// Slope of log error over log step between the two smallest steps in double precision whose errors are above
/// rounding (1e-11), of the problems in which it can be seen.
std::vector<ObservedOrder> observed_orders(const std::vector<SweepRow>& rows);

}  // namespace palpate::bench
