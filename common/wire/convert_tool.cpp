#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_ToolState& wire) noexcept {
  return Check(wire.version)
      .that(wire.tool < max_tools, RejectReason::unknown_id, "tool")
      .stamp(wire.stamp_ns, "stamp_ns")
      .bounded(wire.p_WT, farthest_hand, "p_WT")
      .unit(wire.q_WT, "q_WT")
      .bounded(wire.v_WT, farthest_hand, "v_WT")
      .bounded(wire.w_WT, fastest_turn, "w_WT")
      .bounded(wire.proxy, farthest_hand, "proxy")
      .bounded(wire.force_on_hand, strongest_hand, "force_on_hand")
      .bounded(wire.force_now, strongest_hand, "force_now")
      .bounded(wire.torque_now, strongest_hand, "torque_now")
      .that(wire.engaged <= 1, RejectReason::out_of_range, "engaged")
      .verdict();
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
  Check check(wire.version);
  check.that(wire.tool < max_tools, RejectReason::unknown_id, "tool")
      .stamp(wire.stamp_ns, "stamp_ns")
      .stamp(wire.answers_ns, "answers_ns")
      .positive(wire.t, longest_time, "t")
      .bounded(wire.p_WT, farthest_hand, "p_WT")
      .unit(wire.q_WT, "q_WT")
      .bounded(wire.force, strongest_tissue, "force")
      .bounded(wire.moment, strongest_tissue, "moment")
      .bounded(wire.set_point, farthest_hand, "set_point")
      .bounded(wire.tip, farthest_hand, "tip")
      .bounded(wire.stiffness, rigid_stiffness, "stiffness")
      .bounded(wire.stretch, farthest_hand, "stretch");
  if (!zero(wire.normal)) check.unit(wire.normal, "normal");
  return check.verdict();
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
