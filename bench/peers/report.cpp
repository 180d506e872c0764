#include "bench/peers/report.h"

#include <algorithm>
#include <map>

#include "bench/peers/equal_error.h"

namespace palpate::bench {
namespace {

const std::vector<double> errors_asked = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4};

}  // namespace

std::vector<Ratio> ratios_at_equal_error(const DropResult& drop) {
  std::map<std::string, std::vector<TimeOfError>> ours, theirs;
  for (const Point& point : drop.points) {
    const Method& method = point.method;
    const bool our_own = method.peer == "palpate";
    auto& runs = our_own ? ours[method.precision] : theirs[method.peer + " " + method.name];
    runs.push_back({point.error, point.cpu_s});
  }
  const auto single = best_runs(ours["single"]), twice = best_runs(ours["double"]);
  std::vector<Ratio> ratios;
  for (const auto& [peer, runs] : theirs) {
    const auto best = best_runs(runs);
    std::vector<double> errors = errors_asked;
    errors.push_back(best.back().error);
    for (std::size_t n = 0; n < errors.size(); ++n)
      ratios.push_back({peer, errors[n], n + 1 == errors.size(), seconds_for(best, errors[n]),
                        seconds_for(single, errors[n]), seconds_for(twice, errors[n])});
  }
  return ratios;
}

Table table_of(const Results& results) {
  Table table;
  table.heading = {"case",
                   "peer",
                   "method",
                   "precision",
                   "threads",
                   "masses",
                   "springs",
                   "step_ms",
                   "steps",
                   "cpu_s",
                   "wall_s",
                   "cpu_ns_per_mass_step",
                   "wall_ns_per_mass_step",
                   "error"};
  const auto add = [&table](const std::string& what, const Point& point, const std::string& error) {
    const Method& method = point.method;
    std::string name = method.name;
    std::replace(name.begin(), name.end(), ',', ';');
    table.add({what, method.peer, name, method.precision, std::to_string(method.threads),
               std::to_string(point.masses), std::to_string(point.springs), text_of(1e3 * point.dt),
               std::to_string(point.steps), text_of(point.cpu_s), text_of(point.wall_s),
               text_of(point.cpu_ns()), text_of(point.wall_ns()), error});
  };
  for (const Point& point : results.drop.points) add("drop", point, text_of(point.error));
  for (const Point& point : results.steps) add("mass_step", point, "");
  return table;
}

nlohmann::json json_of(const Results& results, const std::vector<Peer>& peers) {
  nlohmann::json json;
  for (const Peer& peer : peers) {
    if (peer.version.empty()) continue;
    json["peers"][peer.name] = {{"version", peer.version}};
    if (!peer.not_equal.empty()) json["peers"][peer.name]["not_equal_work"] = peer.not_equal;
  }
  const DropResult& drop = results.drop;
  json["drop"] = {{"stable_step_s", drop.stable_step},
                  {"reference_step_s", drop.reference_dt},
                  {"reference_error", drop.reference_error},
                  {"unstable", drop.unstable}};
  json["equal_error"] = nlohmann::json::array();
  for (const Ratio& ratio : ratios_at_equal_error(drop)) {
    nlohmann::json row = {
        {"peer", ratio.peer}, {"error", ratio.error}, {"best_error_of_peer", ratio.at_best}};
    if (ratio.peer_s) row["peer_cpu_s"] = *ratio.peer_s;
    if (ratio.single_s) row["palpate_single_cpu_s"] = *ratio.single_s;
    if (ratio.double_s) row["palpate_double_cpu_s"] = *ratio.double_s;
    if (ratio.peer_s && ratio.single_s) row["ratio_single"] = *ratio.peer_s / *ratio.single_s;
    if (ratio.peer_s && ratio.double_s) row["ratio_double"] = *ratio.peer_s / *ratio.double_s;
    json["equal_error"].push_back(row);
  }
  for (const Agreement& one : results.agreement)
    json["difference_at_same_step"][one.method.label()] = one.difference;
  return json;
}

}  // namespace palpate::bench
