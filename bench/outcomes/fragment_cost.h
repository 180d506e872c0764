#pragma once
// What it costs to know the fragments: following the breaks of a step, against a flood over all masses.

#include <cstdint>
#include <vector>

namespace palpate::bench {

struct FragmentCost {
  int torn = 0;                // masses pulled out of place in each step
  std::int64_t masses = 0;     // of the body
  double breaks = 0;           // elements a step, mean
  double follow_us = 0;        // CPU time of an update, median
  double flood_us = 0;         // of a recount, median
  std::int64_t fragments = 0;  // at the end; both agree, or std::runtime_error
};

/// A cube of 10^5 masses from which single masses are torn, `steps` times.
std::vector<FragmentCost> measure_fragment_cost(int steps);

}  // namespace palpate::bench
