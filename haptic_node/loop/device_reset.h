#pragma once
// Ends the latched fault of one tool when a person asks for it: its session is taken from the real-time thread, closed,
// and opened anew in a thread of its own, since calibration may take seconds. The new session begins as any other:
// forces come only once the tool is outside the tissue.

#include <functional>
#include <future>
#include <memory>

#include "common/scene/scene.h"
#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

class DeviceReset {
 public:
  /// Opens the device; may block and throw InputError. Called from a thread of its own.
  using Open = std::function<std::unique_ptr<HapticSession>()>;

  DeviceReset(ToolChannel& channel, Open open) : channel_(channel), open_(std::move(open)) {}

  /// The slow thread that owns the session, every few milliseconds. Never blocks, but for the driver's own close().
  /// @param state  of the tool now: a tool without a fault is left alone
  void step(HapticState state);

  bool busy() const noexcept { return closing_ || opening_.valid(); }

 private:
  void close_old();
  void take_new();

  ToolChannel& channel_;
  Open open_;
  bool closing_ = false;
  std::unique_ptr<HapticSession> old_;  // closed; what it has counted goes on
  std::future<std::unique_ptr<HapticSession>> opening_;
};

}  // namespace palpate::haptic
