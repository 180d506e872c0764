#pragma once
// What the real-time thread measured of itself. Copied as a whole to the slow threads.

#include <array>
#include <cstdint>

#include "common/message/messages.h"
#include "common/time/histogram.h"

namespace palpate::haptic {

struct LoopStats {
  Histogram<2048> period{1.0};   // between ticks [us]
  Histogram<2048> compute{1.0};  // from waking to the last write, by the clock on the wall [us]
  Histogram<2048> compute_cpu{
      0.25};  // the same in CPU time of the thread, whoever else wanted the processor [us]
  Histogram<2048> loop_age{0.05};  // from a hand tick to the first use of the patch that answers it [ms]
  std::array<std::uint64_t, histogram_bins> lateness{};  // of waking, octaves of us
  std::uint64_t ticks = 0;
  std::uint64_t skipped = 0;      // deadlines missed and not made up for
  std::uint64_t page_faults = 0;  // of the thread, after its first second
  std::uint64_t preempted = 0;    // times the processor was taken from it, after its first second
  std::uint64_t watchdog_stops = 0;
  std::int64_t start_ns = 0;
  std::int64_t last_ns = 0;
};

}  // namespace palpate::haptic
