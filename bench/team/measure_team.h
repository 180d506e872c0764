#pragma once
// One thread, a team, and what the measuring choice takes of it, in turns.

#include <cstdint>

namespace palpate::bench {

struct TeamCost {
  std::int64_t masses = 0;
  int busy = 0;     // other processes, of this priority
  int threads = 1;  // of the team
  // Wall time of a step [us], median of the rounds:
  double one_us = 0, team_us = 0, chosen_us = 0;
  // Time over that of one thread in the same round, median:
  double team_ratio = 1, chosen_ratio = 1;
  double mean_threads = 1;  // that the choice took
};

/// @param seconds  of stepping, each way and round
TeamCost measure_team(double masses, int threads, int busy, double seconds, int rounds);

struct Handover {
  double spinning_us = 0;  // a call of two empty pieces after another
  double sleeping_us = 0;  // the same 1 ms after the last, when the worker sleeps
  double alone_us = 0;     // the same without a worker
};
/// Medians.
Handover measure_handover(int threads);

}  // namespace palpate::bench
