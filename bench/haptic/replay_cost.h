#pragma once
// CPU time of an answer's replay: what the copy of tissue adds to a tick that an answer has come in.

namespace palpate::bench {

struct ReplayCost {
  double median_us = 0, p99_us = 0;  // CPU time of the thread; the clock's own time included
};

/// An answer 100 ticks old, of `modes` modes, taken by a hand in contact.
ReplayCost measure_replay(int modes, int answers);

}  // namespace palpate::bench
