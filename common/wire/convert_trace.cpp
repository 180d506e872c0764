#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_HapticTrace& wire) noexcept {
  const Verdict head = Check(wire.version)
                           .that(wire.tool < max_tools, RejectReason::unknown_id, "tool")
                           .that(wire.n_samples <= max_trace_samples, RejectReason::count, "n_samples")
                           .verdict();
  if (head) return head;
  for (std::uint32_t i = 0; i < wire.n_samples; ++i) {
    const palpate_wire_TraceSample& sample = wire.samples[i];
    const bool in_order = i == 0 || sample.tick > wire.samples[i - 1].tick;
    const Verdict verdict = Check()
                                .positive(sample.t, longest_time, "samples.t")
                                .bounded(sample.p, farthest_hand, "samples.p")
                                .bounded(sample.proxy, farthest_hand, "samples.proxy")
                                .bounded(sample.force, strongest_hand, "samples.force")
                                .bounded(sample.torque, strongest_hand, "samples.torque")
                                .bounded(sample.energy, most_energy, "samples.energy")
                                .that(in_order, RejectReason::other, "samples.tick")
                                .verdict();
    if (verdict) return verdict;
  }
  return {};
}

Verdict from_wire(const palpate_wire_HapticTrace& wire, HapticTrace& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.tool = wire.tool;
  message.batch = wire.batch;
  message.n_samples = wire.n_samples;
  for (std::uint32_t i = 0; i < wire.n_samples; ++i) {
    const palpate_wire_TraceSample& from = wire.samples[i];
    TraceSample& to = message.samples[i];
    to.tick = from.tick;
    to.t = from.t;
    copy(from.p, to.p);
    copy(from.proxy, to.proxy);
    copy(from.force, to.force);
    copy(from.torque, to.torque);
    to.energy = from.energy;
  }
  return {};
}

void to_wire(const HapticTrace& message, palpate_wire_HapticTrace& wire) noexcept {
  wire.version = wire_version;
  wire.tool = message.tool;
  wire.batch = message.batch;
  wire.n_samples = message.n_samples;
  for (std::uint32_t i = 0; i < std::min(message.n_samples, max_trace_samples); ++i) {
    const TraceSample& from = message.samples[i];
    palpate_wire_TraceSample& to = wire.samples[i];
    to.tick = from.tick;
    to.t = from.t;
    copy(from.p, to.p);
    copy(from.proxy, to.proxy);
    copy(from.force, to.force);
    copy(from.torque, to.torque);
    to.energy = from.energy;
  }
}

}  // namespace palpate
