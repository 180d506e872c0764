#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_Pointer& wire) noexcept {
  if (wire.version != wire_version) return RejectReason::version;
  if (wire.tool >= max_tools) return RejectReason::unknown_id;
  if (!finite(wire.p_W) || !finite(wire.q_W)) return RejectReason::not_finite;
  if (!unit(wire.q_W)) return RejectReason::not_unit;
  if (wire.held > 1) return RejectReason::out_of_range;
  return {};
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
