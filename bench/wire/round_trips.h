#pragma once
// There and back again: samples of 128 B to 4 MB between two processes, over UDP loopback and through shared memory.

#include <cstddef>
#include <optional>
#include <vector>

#include "bench/wire/two_ends.h"

namespace palpate::bench {

struct RoundTrips {
  bool shared = false;  // both ends used shared memory
  int answered = 0;     // of the rounds asked for; the rest got lost
  double p50_us = 0, p99_us = 0, max_us = 0;
  double write_p50_us = 0;  // of the call that sends
  double cpu_us = 0;        // of the asking end a round; the other does the same
};

/// Sizes that can be asked for [B].
const std::vector<std::size_t>& payload_sizes();

/// @param loaned  samples are written and read where they lie, in memory lent by DDS; else copied in and out
/// @return nothing if the ends did not meet
std::optional<RoundTrips> measure_round_trips(std::size_t size, Path path, bool loaned, int rounds);

}  // namespace palpate::bench
