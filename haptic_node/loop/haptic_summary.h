#pragma once
// The "haptic" part of summary.json.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "haptic_node/loop/loop_stats.h"
#include "haptic_node/loop/tool_channel.h"
#include "haptic_node/loop/tool_watch.h"
#include "haptic_node/loop/wire.h"

namespace palpate::haptic {

/// {"haptic": {rate_Hz, period_us, compute_us, compute_cpu_us, loop_age_ms, page_faults, energy_max_J, surplus_max_J,
/// force_max_N, torque_max_N_m, stale_events, faults, ...}}. Counts are summed over tools, of energies, forces and torques it is
/// the largest. loop_age_ms is absent if no patch answered. fault_causes is absent without a fault, else a list of
/// {tool, t_s, cause, text, driver}, the first ones.
nlohmann::json haptic_summary(const LoopStats& stats, const std::vector<SessionReport>& tools,
                              std::uint64_t trace_lost, const std::vector<FaultRecord>& faults = {});

/// Writes it, what was said of trouble, and what went over the wire, to OUT/parts/haptic.json. @throws InputError as write_json does
void write_haptic_summary(const std::string& out, const LoopStats& stats, const std::vector<ToolWatch>& tools,
                          const std::vector<std::string>& warnings, const Wire& wire);

}  // namespace palpate::haptic
