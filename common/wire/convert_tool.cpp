#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_ToolState& wire) noexcept {
  if (wire.version != wire_version) return RejectReason::version;
  if (wire.tool >= max_tools) return RejectReason::unknown_id;
  if (!finite(wire.p_WT) || !finite(wire.q_WT) || !finite(wire.v_WT) || !finite(wire.w_WT) ||
      !finite(wire.proxy) || !finite(wire.force_on_hand) || !finite(wire.force_now) ||
      !finite(wire.torque_now)) {
    return RejectReason::not_finite;
  }
  if (!unit(wire.q_WT)) return RejectReason::not_unit;
  if (!within(wire.p_WT, farthest) || !within(wire.proxy, farthest) || !within(wire.v_WT, farthest) ||
      !within(wire.w_WT, fastest_turn) || !within(wire.force_on_hand, strongest) ||
      !within(wire.force_now, strongest) || !within(wire.torque_now, strongest) || wire.engaged > 1)
    return RejectReason::out_of_range;
  return {};
}

Verdict from_wire(const palpate_wire_ToolState& wire, ToolState& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.tool = wire.tool;
  message.tick = wire.tick;
  message.stamp_ns = wire.stamp_ns;
  copy(wire.p_WT, message.p_WT);
  copy(wire.q_WT, message.q_WT);
  copy(wire.v_WT, message.v_WT);
  copy(wire.w_WT, message.w_WT);
  copy(wire.proxy, message.proxy);
  copy(wire.force_on_hand, message.force_on_hand);
  copy(wire.force_now, message.force_now);
  copy(wire.torque_now, message.torque_now);
  message.contact_set = wire.contact_set;
  message.buttons = wire.buttons;
  message.engaged = wire.engaged;
  return {};
}

void to_wire(const ToolState& message, palpate_wire_ToolState& wire) noexcept {
  wire.version = wire_version;
  wire.tool = message.tool;
  wire.tick = message.tick;
  wire.stamp_ns = message.stamp_ns;
  copy(message.p_WT, wire.p_WT);
  copy(message.q_WT, wire.q_WT);
  copy(message.v_WT, wire.v_WT);
  copy(message.w_WT, wire.w_WT);
  copy(message.proxy, wire.proxy);
  copy(message.force_on_hand, wire.force_on_hand);
  copy(message.force_now, wire.force_now);
  copy(message.torque_now, wire.torque_now);
  wire.contact_set = message.contact_set;
  wire.buttons = message.buttons;
  wire.engaged = message.engaged;
}

Verdict judge(const palpate_wire_ToolWrench& wire) noexcept {
  if (wire.version != wire_version) return RejectReason::version;
  if (wire.tool >= max_tools) return RejectReason::unknown_id;
  if (!finite(wire.t) || !finite(wire.force) || !finite(wire.moment) || !finite(wire.set_point) ||
      !finite(wire.stiffness) || !finite(wire.p_WT) || !finite(wire.q_WT) || !finite(wire.tip) ||
      !finite(wire.normal) || !finite(wire.stretch)) {
    return RejectReason::not_finite;
  }
  if (!unit(wire.q_WT) || !(zero(wire.normal) || unit(wire.normal))) return RejectReason::not_unit;
  return {};
}

Verdict from_wire(const palpate_wire_ToolWrench& wire, ToolWrench& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.tool = wire.tool;
  message.tick = wire.tick;
  message.stamp_ns = wire.stamp_ns;
  message.answers = wire.answers;
  message.answers_ns = wire.answers_ns;
  message.t = wire.t;
  copy(wire.p_WT, message.p_WT);
  copy(wire.q_WT, message.q_WT);
  copy(wire.force, message.force);
  copy(wire.moment, message.moment);
  copy(wire.set_point, message.set_point);
  copy(wire.tip, message.tip);
  copy(wire.stiffness, message.stiffness);
  copy(wire.normal, message.normal);
  message.stretch = wire.stretch;
  message.n_contacts = wire.n_contacts;
  return {};
}

void to_wire(const ToolWrench& message, palpate_wire_ToolWrench& wire) noexcept {
  wire.version = wire_version;
  wire.tool = message.tool;
  wire.tick = message.tick;
  wire.stamp_ns = message.stamp_ns;
  wire.answers = message.answers;
  wire.answers_ns = message.answers_ns;
  wire.t = message.t;
  copy(message.p_WT, wire.p_WT);
  copy(message.q_WT, wire.q_WT);
  copy(message.force, wire.force);
  copy(message.moment, wire.moment);
  copy(message.set_point, wire.set_point);
  copy(message.tip, wire.tip);
  copy(message.stiffness, wire.stiffness);
  copy(message.normal, wire.normal);
  wire.stretch = message.stretch;
  wire.n_contacts = message.n_contacts;
}

}  // namespace palpate
