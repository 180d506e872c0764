#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

Verdict judge(const palpate_wire_HapticTrace& wire) noexcept {
  if (wire.version != wire_version) return RejectReason::version;
  if (wire.tool >= max_tools) return RejectReason::unknown_id;
  if (wire.n_samples > max_trace_samples) return RejectReason::count;
  for (std::uint32_t i = 0; i < wire.n_samples; ++i) {
    const palpate_wire_TraceSample& sample = wire.samples[i];
    if (!finite(sample.t) || !finite(sample.p) || !finite(sample.proxy) || !finite(sample.force) ||
        !finite(sample.torque) || !finite(sample.energy)) {
      return RejectReason::not_finite;
    }
    if (i > 0 && sample.tick <= wire.samples[i - 1].tick) return RejectReason::other;  // out of order
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
