#include "haptic_node/loop/haptic_summary.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/report/json_file.h"
#include "common/report/warnings.h"
#include "common/time/clock.h"
#include "common/wire/heard_report.h"
#include "common/wire/refusals.h"
#include "common/wire/wire_report.h"

namespace palpate::haptic {
namespace {

template <std::size_t Bins>
nlohmann::json percentiles(const Histogram<Bins>& histogram) {
  return {{"p50", histogram.percentile(0.5)},
          {"p99", histogram.percentile(0.99)},
          {"p999", histogram.percentile(0.999)},
          {"max", histogram.max()}};
}

}  // namespace

nlohmann::json haptic_summary(const LoopStats& stats, const std::vector<SessionReport>& tools,
                              std::uint64_t trace_lost, const std::vector<FaultRecord>& faults) {
  SessionCounts sum;
  for (const auto& tool : tools) {
    sum.stale_events += tool.counts.stale_events;
    sum.safe_events += tool.counts.safe_events;
    sum.faults += tool.counts.faults;
    sum.patches_taken += tool.counts.patches_taken;
    sum.patches_rejected += tool.counts.patches_rejected;
    sum.samples_rejected += tool.counts.samples_rejected;
    sum.outran += tool.counts.outran;
    sum.late_calls += tool.counts.late_calls;
    sum.longest_call = std::max(sum.longest_call, tool.counts.longest_call);
    sum.temperature_max = std::max(sum.temperature_max, tool.counts.temperature_max);
    sum.energy_max = std::max(sum.energy_max, tool.counts.energy_max);
    sum.surplus_max = std::max(sum.surplus_max, tool.counts.surplus_max);
    sum.model_error = std::max(sum.model_error, tool.counts.model_error);
    sum.force_max = std::max(sum.force_max, tool.counts.force_max);
    sum.torque_max = std::max(sum.torque_max, tool.counts.torque_max);
  }
  nlohmann::json haptic = {{"ticks", stats.ticks},
                           {"missed_deadlines", stats.skipped},
                           {"watchdog_stops", stats.watchdog_stops},
                           {"page_faults", stats.page_faults},
                           {"preempted", stats.preempted},
                           {"energy_max_J", sum.energy_max},
                           {"surplus_max_J", sum.surplus_max},
                           {"force_max_N", sum.force_max},
                           {"torque_max_N_m", sum.torque_max},
                           {"stale_events", sum.stale_events},
                           {"safe_events", sum.safe_events},
                           {"faults", sum.faults},
                           {"patches", sum.patches_taken},
                           {"patches_rejected", sum.patches_rejected},
                           {"samples_rejected", sum.samples_rejected},
                           {"outran_ticks", sum.outran},
                           {"late_calls", sum.late_calls},
                           {"longest_call_ms", 1e3 * sum.longest_call},
                           {"trace_samples_lost", trace_lost}};
  const double seconds = seconds_from_ns(stats.last_ns - stats.start_ns);
  if (sum.model_error >= 0) haptic["model_error"] = sum.model_error;
  if (sum.temperature_max >= 0) haptic["motor_temperature_max"] = sum.temperature_max;
  for (const auto& fault : faults)
    haptic["fault_causes"].push_back({{"tool", fault.tool},
                                      {"t_s", fault.t},
                                      {"cause", name_of(fault.cause)},
                                      {"text", text_of(fault.cause)},
                                      {"driver", fault.words},
                                      {"motors_off", !fault.may_force}});
  if (seconds > 0) haptic["rate_Hz"] = static_cast<double>(stats.ticks) / seconds;
  if (stats.period.total() > 0) haptic["period_us"] = percentiles(stats.period);
  if (stats.compute.total() > 0) haptic["compute_us"] = percentiles(stats.compute);
  if (stats.compute_cpu.total() > 0) haptic["compute_cpu_us"] = percentiles(stats.compute_cpu);
  if (stats.loop_age.total() > 0) haptic["loop_age_ms"] = percentiles(stats.loop_age);
  return {{"haptic", haptic}};
}

void write_haptic_summary(const std::string& out, const LoopStats& stats, const std::vector<ToolWatch>& tools,
                          const std::vector<std::string>& warnings, const Wire& wire) {
  std::error_code already;  // write_json says what is wrong with the folder
  std::filesystem::create_directories(out + "/parts", already);
  std::vector<SessionReport> reports;
  std::vector<FaultRecord> faults;
  for (const auto& tool : tools) {
    reports.push_back(tool.report());
    faults.insert(faults.end(), tool.records().begin(), tool.records().end());
  }
  auto part = haptic_summary(stats, reports, wire.trace_lost(), faults);
  for (const auto& tool : tools)  // one that has not ticked has said nothing yet
    if (tool.report().counts.ticks > 0)
      part["haptic"]["force_models"][tool.tool()] = word_of(tool.report().force_model.model);
  add_warnings(part, warnings);
  part.update(wire_report("haptic", wire.participant(), wire.states(), wire.traces(), wire.status()));
  const Wire::HeardCounts heard = wire.heard();
  part["haptic"]["foreign_patches"] = heard.patches.foreign;
  part["haptic"]["patches_rejected"] = part["haptic"]["patches_rejected"].get<std::uint64_t>() +
                                       rejected(heard.patches) + rejected(heard.wrenches);
  std::vector<Heard> topics = {{"ContactPatch", heard.patches}, {"Command", wire.commands_heard()}};
  if (wire.feels_wrenches()) topics.push_back({"ToolWrench", heard.wrenches});
  add_heard(part, "haptic", topics);
  write_json(out + "/parts/haptic.json", part);
}

}  // namespace palpate::haptic
