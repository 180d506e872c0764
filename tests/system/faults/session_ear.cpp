#include "tests/system/faults/session_ear.h"

namespace palpate::test {

void SessionEar::take(const HapticTrace& trace) {
  for (std::uint32_t n = 0; n < trace.n_samples; ++n) {
    const std::uint64_t tick = trace.samples[n].tick;
    if (last_trace_tick_ > 0 && tick > last_trace_tick_ + 1) trace_gaps_ += tick - last_trace_tick_ - 1;
    last_trace_tick_ = tick;
    ++trace_samples_;
  }
}

void SessionEar::listen() {
  while (patches_.take(patch_)) {
  }
  NodeStatus status;
  while (statuses_.take(status)) {
    if (status.node == NodeKind::render) eye_ = status;
    if (status.node != NodeKind::haptic) continue;
    hand_ = status;
    ++hand_statuses_;
  }
  while (traces_.take(trace_)) take(trace_);
}

std::uint64_t SessionEar::pictures(pid_t render) const {
  return eye_.pid == static_cast<std::uint32_t>(render) ? eye_.ticks : 0;
}

bool SessionEar::draws(pid_t render, std::uint64_t more_than) const { return pictures(render) > more_than; }

}  // namespace palpate::test
