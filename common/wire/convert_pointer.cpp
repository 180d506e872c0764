#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_Pointer& wire) noexcept {
  return Check(wire.version)
      .that(wire.tool < max_tools, RejectReason::unknown_id, "tool")
      .stamp(wire.stamp_ns, "stamp_ns")
      .bounded(wire.p_W, farthest_hand, "p_W")
      .unit(wire.q_W, "q_W")
      .that(wire.held <= 1, RejectReason::out_of_range, "held")
      .verdict();
}

Verdict from_wire(const palpate_wire_Pointer& wire, Pointer& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.tool = wire.tool;
  message.tick = wire.tick;
  message.stamp_ns = wire.stamp_ns;
  copy(wire.p_W, message.p_W);
  copy(wire.q_W, message.q_W);
  message.buttons = wire.buttons;
  message.held = wire.held;
  return {};
}

void to_wire(const Pointer& message, palpate_wire_Pointer& wire) noexcept {
  wire.version = wire_version;
  wire.tool = message.tool;
  wire.tick = message.tick;
  wire.stamp_ns = message.stamp_ns;
  copy(message.p_W, wire.p_W);
  copy(message.q_W, wire.q_W);
  wire.buttons = message.buttons;
  wire.held = message.held;
}

}  // namespace palpate
