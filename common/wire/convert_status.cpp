#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_Command& wire) noexcept {
  return Check(wire.version)
      .that(wire.kind < n_command_kinds, RejectReason::unknown_id, "kind")
      .bounded(wire.value, largest_value, "value")
      .that(ends(wire.name), RejectReason::text, "name")
      .verdict();
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
  return Check(wire.version)
      .that(wire.node < n_node_kinds, RejectReason::unknown_id, "node")
      .that(wire.phase < n_node_phases, RejectReason::out_of_range, "phase")
      .positive(wire.t, longest_time, "t")
      .positive(wire.rate_Hz, largest_value, "rate_Hz")
      .positive(wire.real_time_factor, largest_value, "real_time_factor")
      .positive(wire.loop_age_ms_p50, largest_value, "loop_age_ms_p50")
      .bounded(wire.energy_J, most_energy, "energy_J")
      .bounded(wire.surplus_J, most_energy, "surplus_J")
      .that(ends(wire.note), RejectReason::text, "note")
      .that(ends(wire.refused), RejectReason::text, "refused")
      .verdict();
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
  message.foreign = wire.foreign;
  message.warnings = wire.warnings;
  message.energy_J = wire.energy_J;
  message.surplus_J = wire.surplus_J;
  message.stale_events = wire.stale_events;
  message.safe_events = wire.safe_events;
  message.faults = wire.faults;
  copy(wire.lateness, message.lateness);
  copy(wire.note, message.note);
  copy(wire.refused, message.refused);
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
  wire.foreign = message.foreign;
  wire.warnings = message.warnings;
  wire.energy_J = message.energy_J;
  wire.surplus_J = message.surplus_J;
  wire.stale_events = message.stale_events;
  wire.safe_events = message.safe_events;
  wire.faults = message.faults;
  copy(message.lateness, wire.lateness);
  copy(message.note, wire.note);
  copy(message.refused, wire.refused);
}

}  // namespace palpate
