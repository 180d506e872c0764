#pragma once
// Motors off whichever way the process ends: a signal that kills it, or exit() from anywhere. Only SIGKILL and a power
// cut get past this; then the device's own watchdog is what is left.

#include <memory>
#include <vector>

#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

class CrashStop {
 public:
  /// From now on SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT and exit() stop the motors of these tools first; a signal
  /// then ends the process as it would have. One of these at a time. @param channels  outlive this
  explicit CrashStop(std::vector<std::unique_ptr<ToolChannel>>& channels);
  ~CrashStop();
  CrashStop(const CrashStop&) = delete;
  CrashStop& operator=(const CrashStop&) = delete;

  /// The process is ending: motors must not be switched on again.
  static bool ending() noexcept;
};

}  // namespace palpate::haptic
