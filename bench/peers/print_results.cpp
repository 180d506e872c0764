#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bench/peers/report.h"

namespace palpate::bench {
namespace {

/// palpate's time and the ratio to it.
std::string against(double peer_s, const std::optional<double>& palpate_s) {
  return palpate_s ? fmt::format("{:>9.3g}{:>8.1f}", *palpate_s, peer_s / *palpate_s)
                   : fmt::format("{:>9}{:>8}", "never", "-");
}

/// palpate's step that takes least CPU time on one thread.
double fastest_ns(const std::vector<Point>& points, std::size_t masses, const std::string& precision) {
  double fastest = std::numeric_limits<double>::infinity();
  for (const Point& point : points) {
    const Method& method = point.method;
    if (method.peer == "palpate" && method.threads == 1 && method.precision == precision &&
        point.masses == masses)
      fastest = std::min(fastest, point.cpu_ns());
  }
  return fastest;
}

void print_agreement(const std::vector<Agreement>& agreement) {
  fmt::print(
      "\nSame equations? Difference to palpate in double after 50 ms at the same step, scheme by scheme\n");
  for (const Agreement& one : agreement)
    fmt::print("  {:<54}{:>10.2g}\n", one.method.label(), one.difference);
}

void print_drop(const DropResult& drop) {
  fmt::print("\nThe drop: CPU time and error at the end, one thread\n  {:<54}{:>10}{:>10}{:>10}\n", "",
             "step ms", "CPU s", "error");
  for (const Point& point : drop.points)
    fmt::print("  {:<54}{:>10.4g}{:>10.3g}{:>10.3g}\n", point.method.label(), 1e3 * point.dt, point.cpu_s,
               point.error);
  for (const std::string& line : drop.unstable)
    fmt::print("  not stable, or off by more than all: {}\n", line);
  fmt::print(
      "  stable step by palpate's bound {:.4g} ms; reference: double, step {:.3g} ms, own error {:.2g}\n",
      1e3 * drop.stable_step, 1e3 * drop.reference_dt, drop.reference_error);
}

/// One line per error that the peer reaches.
void print_ratios(const std::vector<Ratio>& ratios) {
  fmt::print(
      "\nCPU time at equal error, one thread; ratio: peer over palpate\n"
      "  {:<30}{:>9}{:>9}{:>9}{:>8}{:>9}{:>8}\n",
      "", "error", "peer s", "float s", "ratio", "double s", "ratio");
  for (const Ratio& ratio : ratios) {
    if (!ratio.peer_s) continue;
    fmt::print("  {:<30}{:>9.2g}{:>9.3g}{}{}{}\n", ratio.peer, ratio.error, *ratio.peer_s,
               against(*ratio.peer_s, ratio.single_s), against(*ratio.peer_s, ratio.double_s),
               ratio.at_best ? "  the least it reaches" : "");
  }
}

void print_steps(const std::vector<Point>& points) {
  fmt::print(
      "\nTime of a step per mass; ratios of CPU time to palpate's fastest of one thread in float and in "
      "double\n"
      "  {:<54}{:>8}{:>9}{:>9}{:>9}{:>10}\n",
      "", "masses", "CPU ns", "wall ns", "to float", "to double");
  for (const Point& point : points)
    fmt::print("  {:<54}{:>8}{:>9.4g}{:>9.4g}{:>9.2f}{:>10.2f}\n", point.method.label(), point.masses,
               point.cpu_ns(), point.wall_ns(), point.cpu_ns() / fastest_ns(points, point.masses, "single"),
               point.cpu_ns() / fastest_ns(points, point.masses, "double"));
}

}  // namespace

void print(const Results& results, const std::vector<Peer>& peers) {
  print_agreement(results.agreement);
  print_drop(results.drop);
  print_ratios(ratios_at_equal_error(results.drop));
  print_steps(results.steps);
  fmt::print("\nNot equal work\n");
  for (const Peer& peer : peers)
    if (!peer.version.empty()) fmt::print("  {} {}: {}\n", peer.name, peer.version, peer.not_equal);
  fmt::print("  No damper anywhere: LAMMPS has none along a bond, and Bullet's links damp by another law.\n");
}

}  // namespace palpate::bench
