#pragma once
// Motors off whichever way the process ends: a signal that kills it, or exit() from anywhere. Only SIGKILL and a power
// cut get past this; then the guardian (guardian/guardian.h) and the device's own watchdog are what is left.

#include <memory>
#include <vector>

#include "haptic_node/guardian/guardian.h"
#include "haptic_node/loop/alternate_stack.h"
#include "haptic_node/loop/last_moment.h"
#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

class CrashStop {
 public:
  /// What all drivers together may take, and after what the process ends whatever they do. Between the two nothing is left
  /// to do but a driver that hangs.
  static constexpr std::int64_t stop_ns = 24'000'000, patience_ns = 30'000'000;

  /// From now on the signals of ending_signals.h and exit() stop the motors of these tools first; a signal then ends the
  /// process as it would have, exit status and core dump included. One of these at a time.
  /// @param channels, guardian  outlive this
  CrashStop(std::vector<std::unique_ptr<ToolChannel>>& channels, Guardian& guardian);
  ~CrashStop();
  CrashStop(const CrashStop&) = delete;
  CrashStop& operator=(const CrashStop&) = delete;

  /// The process is ending: motors must not be switched on again.
  static bool ending() noexcept;

 private:
  AlternateStack stack_;  // of the thread that made this
  LastMoment last_moment_{patience_ns};
};

}  // namespace palpate::haptic
