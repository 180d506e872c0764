#pragma once
// What physics is told by a hand whose motion presses tissue: its last samples, and the spring that they press through.

#include "common/message/messages.h"
#include "haptic_node/control/controller.h"

namespace palpate::haptic {

/// Writes place, force and history of the newest sample; nothing where the hand feels in another way. Contract: real time.
void tell_motion(const Controller& controller, ToolState& state) noexcept;

}  // namespace palpate::haptic
