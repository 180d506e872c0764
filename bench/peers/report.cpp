#include "bench/peers/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/peers/equal_error.h"

namespace palpate::bench {
namespace {

const std::vector<double> errors_asked = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4};

std::string seconds_text(const std::optional<double>& seconds) {
  return seconds ? fmt::format("{:.3g}", *seconds) : "never";
}

/// Palpate's step of the same size, precision and threads that takes least CPU time.
const Point* fastest_palpate(const std::vector<Point>& points, std::size_t masses,
                             const std::string& precision) {
  const Point* fastest = nullptr;
  for (const Point& point : points) {
    const Method& method = point.method;
    if (method.peer != "palpate" || method.threads != 1 || method.precision != precision ||
        point.masses != masses)
      continue;
    if (fastest == nullptr || point.cpu_s / point.steps < fastest->cpu_s / fastest->steps) fastest = &point;
  }
  return fastest;
}

void print_drop(const DropResult& drop) {
  fmt::print("\nThe drop: CPU time and error at the end, one thread\n  {:<46}{:>10}{:>11}{:>12}\n", "",
             "step ms", "CPU s", "error");
  for (const Point& point : drop.points)
    fmt::print("  {:<46}{:>10.4g}{:>11.4g}{:>12.3g}\n", point.method.label(), 1e3 * point.dt, point.cpu_s,
               point.error);
  for (const std::string& line : drop.unstable) fmt::print("  unstable: {}\n", line);
  fmt::print(
      "  stable step by palpate's bound {:.4g} ms; reference: double, step {:.3g} ms, own error {:.2g}\n",
      1e3 * drop.stable_step, 1e3 * drop.reference_dt, drop.reference_error);
}

void print_ratios(const std::vector<Ratio>& ratios) {
  fmt::print("\nCPU time at equal error, peer over palpate\n  {:<34}{:>10}{:>9}{:>10}{:>12}{:>8}\n", "",
             "error", "peer s", "palpate", "palpate s", "ratio");
  for (const Ratio& ratio : ratios) {
    const bool both = ratio.peer_s && ratio.palpate_s;
    fmt::print("  {:<34}{:>10.2g}{:>9}{:>10}{:>12}{:>8}{}\n", ratio.peer, ratio.error,
               seconds_text(ratio.peer_s), ratio.precision, seconds_text(ratio.palpate_s),
               both ? fmt::format("{:.1f}", *ratio.peer_s / *ratio.palpate_s) : "-",
               ratio.at_best ? "  its best error" : "");
  }
}

void print_steps(const std::vector<Point>& points) {
  fmt::print(
      "\nTime of a step, ns per mass; ratio of CPU time to palpate's fastest of one thread\n"
      "  {:<46}{:>8}{:>10}{:>10}{:>10}{:>10}\n",
      "", "masses", "CPU ns", "wall ns", "to float", "to double");
  for (const Point& point : points) {
    const Point* single = fastest_palpate(points, point.masses, "single");
    const Point* twice = fastest_palpate(points, point.masses, "double");
    fmt::print("  {:<46}{:>8}{:>10.4g}{:>10.4g}{:>10.3g}{:>10.3g}\n", point.method.label(), point.masses,
               point.cpu_ns(), point.wall_ns(), point.cpu_ns() / single->cpu_ns(),
               point.cpu_ns() / twice->cpu_ns());
  }
}

}  // namespace

std::vector<Ratio> ratios_at_equal_error(const DropResult& drop) {
  std::map<std::string, std::vector<TimeOfError>> ours, theirs;
  for (const Point& point : drop.points) {
    const Method& method = point.method;
    const bool our_own = method.peer == "palpate";
    auto& runs = our_own ? ours[method.precision] : theirs[method.peer + " " + method.name];
    runs.push_back({point.error, point.cpu_s});
  }
  std::vector<Ratio> ratios;
  for (const auto& [peer, runs] : theirs) {
    const auto best = best_runs(runs);
    std::vector<std::pair<double, bool>> errors;
    for (const double error : errors_asked) errors.emplace_back(error, false);
    errors.emplace_back(best.back().error, true);
    for (const auto& [precision, our_runs] : ours) {
      const auto our_best = best_runs(our_runs);
      for (const auto& [error, at_best] : errors)
        ratios.push_back(
            {peer, precision, error, at_best, seconds_for(best, error), seconds_for(our_best, error)});
    }
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
        {"peer", ratio.peer}, {"palpate_precision", ratio.precision}, {"error", ratio.error}};
    row["best_error_of_peer"] = ratio.at_best;
    if (ratio.peer_s) row["peer_cpu_s"] = *ratio.peer_s;
    if (ratio.palpate_s) row["palpate_cpu_s"] = *ratio.palpate_s;
    if (ratio.peer_s && ratio.palpate_s) row["ratio"] = *ratio.peer_s / *ratio.palpate_s;
    json["equal_error"].push_back(row);
  }
  for (const Agreement& one : results.agreement)
    json["difference_at_same_step"][one.method.label()] = one.difference;
  return json;
}

void print(const Results& results, const std::vector<Peer>& peers) {
  fmt::print(
      "\nSame equations? Difference to palpate in double after 50 ms at the same step, scheme by scheme\n");
  for (const Agreement& one : results.agreement)
    fmt::print("  {:<46}{:>10.2g}\n", one.method.label(), one.difference);
  print_drop(results.drop);
  print_ratios(ratios_at_equal_error(results.drop));
  print_steps(results.steps);
  fmt::print(
      "\nNot equal work\n  palpate: stores no spring, steps whole frames, checks for numbers that are not "
      "finite.\n");
  for (const Peer& peer : peers)
    if (!peer.not_equal.empty()) fmt::print("  {} {}: {}\n", peer.name, peer.version, peer.not_equal);
  fmt::print("  No damper anywhere: LAMMPS has none along a bond, and Bullet's links damp otherwise.\n");
}

}  // namespace palpate::bench
