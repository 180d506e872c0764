#pragma once
// One tool between the real-time thread and the slow threads: its session, and lock-free ways in and out.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "common/exchange/handover.h"
#include "common/exchange/spsc_ring.h"
#include "common/exchange/triple_buffer.h"
#include "common/message/messages.h"
#include "common/scene/scene_fwd.h"
#include "haptic_node/loop/flight_recorder.h"
#include "haptic_node/session.h"

namespace palpate::haptic {

struct SessionReport {
  HapticState state = HapticState::off;
  ArmRefusal refusal = ArmRefusal::none;
  SessionCounts counts;
  std::int64_t first_run_ns = 0;
  FaultCause cause = FaultCause::none;  // of state fault
  double temperature = -1;              // of the motors, 1 = their limit; below 0: unknown
  double thermal_gain = 1;              // what that leaves of the force
  double sample_age = 0;                // of the newest sample [s]
  ForceModelChoice force_model;
};

/// A session in real time whose motors are switched on by a slow thread. @throws InputError as HapticSession does
std::unique_ptr<HapticSession> open_session(const Scene& scene, std::uint32_t tool, const std::string& driver,
                                            int domain = -1);

struct ToolChannel {
  enum User : std::size_t { loop, watchdog, n_users };

  /// @throws InputError as open_session() does
  ToolChannel(const Scene& scene, std::uint32_t tool, const std::string& driver, int domain = -1);

  std::string name;
  Handover<HapticSession, n_users> session;  // the node's slow thread owns it, the real-time thread ticks it
  TripleBuffer<ContactPatch> patches;        // receive thread -> real-time thread
  TripleBuffer<ToolWrench> wrenches;         // likewise
  TripleBuffer<ToolState> states;            // real-time thread -> publisher
  SpscRing<TraceSample, 8192> trace;         // real-time thread -> slow thread: eight seconds at 1 kHz
  TripleBuffer<SessionReport> reports;       // real-time thread -> slow thread
  FlightRecorder flight;                     // real-time thread -> slow thread
  std::atomic<std::uint64_t> trace_lost{0};
  // Which physics speaks; receive thread -> real-time thread, set before the first that it says.
  std::atomic<std::uint64_t> physics{0};
  std::uint64_t physics_heard = 0;       // the real-time thread's
  std::atomic<bool> reset_asked{false};  // by a person, to end a fault
  std::uint64_t attached = 0;            // generation of the session that the real-time thread has attached
};

}  // namespace palpate::haptic
