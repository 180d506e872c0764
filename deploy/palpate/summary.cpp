#include "deploy/palpate/summary.h"

#include <fmt/format.h>

#include <cstdio>

#include "common/error/error.h"
#include "common/report/commit.h"
#include "common/report/json_file.h"
#include "common/report/warnings.h"
#include "common/scene/scene.h"
#include "deploy/palpate/hand_warnings.h"
#include "deploy/palpate/nodes.h"

namespace palpate::deploy {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

json part_of(const fs::path& path) {
  if (!fs::exists(path)) return json::object();
  try {
    const json part = read_json(path.string());
    if (part.is_object()) return part;
    std::fprintf(stderr, "palpate: %s: is not an object; it is left out of the summary\n", path.c_str());
  } catch (const InputError& error) {
    std::fprintf(stderr, "palpate: %s; it is left out of the summary\n", error.what());
  }
  return json::object();
}

json node_report(const NodeOutcome& outcome) {
  json report = {{"seen", outcome.seen}};
  if (outcome.ending) report[outcome.ending->by_signal ? "signal" : "exit_code"] = outcome.ending->code;
  if (outcome.killed) report["killed"] = true;
  if (outcome.mean_rate_Hz > 0) report["rate_Hz"] = outcome.mean_rate_Hz;
  if (outcome.mean_real_time_factor > 0) report["real_time_factor"] = outcome.mean_real_time_factor;
  return report;
}

}  // namespace

json merged_summary(const fs::path& out, const Scene& scene, const SessionResult& result) {
  json summary = json::object();
  std::vector<std::string> warnings;  // update() would keep those of the last node only
  for (const NodeKind node : all_nodes) {
    const json part = part_of(out / "parts" / fmt::format("{}.json", name_of(node)));
    summary.update(part, true);
    for (std::string& text : warnings_of(part)) warnings.push_back(std::move(text));
  }
  summary["warnings"] = json::array();
  add_warnings(summary, warnings);
  add_warnings(summary, hand_warnings(summary, Faults::counted));
  count_warnings(summary);
  const json ours = {
      {"scene", scene.path}, {"commit", commit()}, {"seed", scene.seed}, {"wall_s", result.wall_s}};
  for (const auto& [key, value] : ours.items()) {
    if (!summary.contains(key)) summary[key] = value;
  }
  for (const NodeOutcome& outcome : result.nodes) {
    summary["nodes"][std::string(name_of(outcome.node))] = node_report(outcome);
  }
  return summary;
}

fs::path write_summary(const fs::path& out, const Scene& scene, const SessionResult& result) {
  const fs::path path = out / "summary.json";
  write_json(path.string(), merged_summary(out, scene, result));
  std::error_code error;
  fs::remove_all(out / "parts", error);
  return path;
}

}  // namespace palpate::deploy
