#pragma once
// CPU time of the proxy solver.

namespace palpate::bench {

struct SolverCost {
  double median_us = 0, p99_us = 0;  // of one solution, CPU time of the thread; the clock's own time included
};

/// Random sets of 8 planes, as in S9.
SolverCost measure_solver(int sets);

}  // namespace palpate::bench
