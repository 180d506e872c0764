#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_Command& wire) noexcept {
  if (wire.version != wire_version) return RejectReason::version;
  if (wire.kind >= n_command_kinds) return RejectReason::unknown_id;
  if (!finite(wire.value)) return RejectReason::not_finite;
  if (!ends(wire.name)) return RejectReason::text;
  return {};
}

Verdict from_wire(const palpate_wire_Command& wire, Command& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.id = wire.id;
  message.kind = static_cast<CommandKind>(wire.kind);
  message.value = wire.value;
  copy(wire.name, message.name);
  return {};
}

void to_wire(const Command& message, palpate_wire_Command& wire) noexcept {
  wire.version = wire_version;
  wire.id = message.id;
  wire.kind = static_cast<std::uint32_t>(message.kind);
  wire.value = message.value;
  copy(message.name, wire.name);
}

Verdict judge(const palpate_wire_NodeStatus& wire) noexcept {
  if (wire.version != wire_version) return RejectReason::version;
  if (wire.node >= n_node_kinds) return RejectReason::unknown_id;
  if (wire.phase >= n_node_phases) return RejectReason::out_of_range;
  if (!finite(wire.t) || !finite(wire.rate_Hz) || !finite(wire.real_time_factor) ||
      !finite(wire.loop_age_ms_p50) || !finite(wire.energy_J) || !finite(wire.surplus_J)) {
    return RejectReason::not_finite;
  }
  if (wire.t < 0 || wire.rate_Hz < 0 || wire.real_time_factor < 0 || wire.loop_age_ms_p50 < 0) {
    return RejectReason::out_of_range;
  }
  if (!ends(wire.note)) return RejectReason::text;
  return {};
}

Verdict from_wire(const palpate_wire_NodeStatus& wire, NodeStatus& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.node = static_cast<NodeKind>(wire.node);
  message.phase = static_cast<NodePhase>(wire.phase);
  message.pid = wire.pid;
  message.scene_checksum = wire.scene_checksum;
  message.t = wire.t;
  message.rate_Hz = wire.rate_Hz;
  message.real_time_factor = wire.real_time_factor;
  message.loop_age_ms_p50 = wire.loop_age_ms_p50;
  message.ticks = wire.ticks;
  message.late = wire.late;
  message.samples_received = wire.samples_received;
  message.samples_lost = wire.samples_lost;
  copy(wire.rejected, message.rejected);
  message.warnings = wire.warnings;
  message.energy_J = wire.energy_J;
  message.surplus_J = wire.surplus_J;
  message.stale_events = wire.stale_events;
  message.safe_events = wire.safe_events;
  message.faults = wire.faults;
  copy(wire.lateness, message.lateness);
  copy(wire.note, message.note);
  return {};
}

void to_wire(const NodeStatus& message, palpate_wire_NodeStatus& wire) noexcept {
  wire.version = wire_version;
  wire.node = static_cast<std::uint32_t>(message.node);
  wire.phase = static_cast<std::uint32_t>(message.phase);
  wire.pid = message.pid;
  wire.scene_checksum = message.scene_checksum;
  wire.t = message.t;
  wire.rate_Hz = message.rate_Hz;
  wire.real_time_factor = message.real_time_factor;
  wire.loop_age_ms_p50 = message.loop_age_ms_p50;
  wire.ticks = message.ticks;
  wire.late = message.late;
  wire.samples_received = message.samples_received;
  wire.samples_lost = message.samples_lost;
  copy(message.rejected, wire.rejected);
  wire.warnings = message.warnings;
  wire.energy_J = message.energy_J;
  wire.surplus_J = message.surplus_J;
  wire.stale_events = message.stale_events;
  wire.safe_events = message.safe_events;
  wire.faults = message.faults;
  copy(message.lateness, wire.lateness);
  copy(message.note, wire.note);
}

}  // namespace palpate
