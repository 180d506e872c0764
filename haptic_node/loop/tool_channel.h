#pragma once
// One tool between the real-time thread and the slow threads: its session, and lock-free ways in and out.

#include <atomic>
#include <cstdint>

#include "common/exchange/spsc_ring.h"
#include "common/exchange/triple_buffer.h"
#include "common/message/messages.h"
#include "common/time/clock.h"
#include "haptic_node/session.h"

namespace palpate::haptic {

struct SessionReport {
  HapticState state = HapticState::off;
  SessionCounts counts;
  std::int64_t first_run_ns = 0;
};

struct ToolChannel {
  ToolChannel(const Scene& scene, std::uint32_t tool, const std::string& driver, int domain = -1)
      : session(
            scene, tool, driver, [](void*) { return now_ns(); }, nullptr, HapticSession::Power::by_service,
            domain) {}

  HapticSession session;                // ticked by the real-time thread only
  TripleBuffer<ContactPatch> patches;   // receive thread -> real-time thread
  TripleBuffer<ToolWrench> wrenches;    // likewise
  TripleBuffer<ToolState> states;       // real-time thread -> publisher
  SpscRing<TraceSample, 8192> trace;    // real-time thread -> slow thread: eight seconds at 1 kHz
  TripleBuffer<SessionReport> reports;  // real-time thread -> slow thread
  std::atomic<std::uint64_t> trace_lost{0};
};

}  // namespace palpate::haptic
