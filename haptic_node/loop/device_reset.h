#pragma once
// Ends the latched fault of one tool when a person asks for it: its session is taken from the real-time thread, closed,
// and opened anew in a thread of its own, since calibration may take seconds. The new session begins as any other:
// forces come only once the tool is outside the tissue. A device whose vendor's side is dead is closed without being asked:
// nobody else is left who hears that its motors are to stop.

#include <functional>
#include <future>
#include <memory>

#include "common/math/vec3.h"
#include "haptic_node/loop/tool_channel.h"

namespace palpate::haptic {

class DeviceReset {
 public:
  /// Opens the device; may block and throw InputError. Called from a thread of its own.
  using Open = std::function<std::unique_ptr<HapticSession>()>;

  DeviceReset(ToolChannel& channel, Open open) : channel_(channel), open_(std::move(open)) {}

  /// The slow thread that owns the session, every few milliseconds. Never blocks for longer than Device::close_within.
  /// @param state  of the tool now: a tool without a fault is left alone
  /// @param cause  of its fault
  void step(HapticState state, FaultCause cause);

  bool busy() const noexcept { return reopening_ || opening_.valid(); }
  /// The session is here and closed, or as closed as its driver lets it be.
  bool has_session() const noexcept { return old_ != nullptr; }
  /// A driver does not come back from closing or opening.
  bool hangs() const noexcept { return hangs_ || opening_.valid(); }

 private:
  bool close_old();
  void take_new();

  ToolChannel& channel_;
  Open open_;
  bool reopening_ = false;  // the session is to be taken, closed, and opened anew
  bool hangs_ = false;
  bool fresh_ = false;                  // a new session has been handed over, and has not been heard of yet
  std::unique_ptr<HapticSession> old_;  // closed; what it has counted goes on
  std::future<std::unique_ptr<HapticSession>> opening_;
};

}  // namespace palpate::haptic
