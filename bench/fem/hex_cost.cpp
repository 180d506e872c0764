#include "bench/fem/hex_cost.h"

#include <algorithm>
#include <cmath>

#include "bench/problems/median.h"
#include "bench/problems/stopwatch.h"

namespace palpate::bench {
namespace {

constexpr int steps_a_frame = 4;

}  // namespace

double HexCost::median_ns() const { return median(ns); }

double HexCost::least_ns() const { return ns.empty() ? 0 : *std::min_element(ns.begin(), ns.end()); }

double HexCost::cells_at_1_kHz() const {
  const double steps = std::ceil(1e-3 / (0.8 * stable_step) - 1e-9);
  return 1e-3 / (1e-9 * median_ns() * steps);
}

std::vector<HexCost> measure_hex_costs(const std::vector<HexCubeKind>& kinds, int rounds) {
  std::vector<HexCost> costs;
  std::vector<HexCube> cubes;
  int most_threads = 1;
  for (const HexCubeKind& kind : kinds) {
    cubes.push_back(make_hex_cube(kind));
    costs.push_back({.kind = kind, .stable_step = cubes.back().stable_step, .ns = {}});
    most_threads = std::max(most_threads, kind.threads);
  }
  physics::Team team(most_threads);
  for (int round = 0; round <= rounds; ++round)  // the first does not count
    for (std::size_t n = 0; n < kinds.size(); ++n) {
      const double cells = std::pow(kinds[n].cells, 3);
      const int frames = std::max(1, static_cast<int>(1e6 / cells));
      const Stopwatch watch;
      cubes[n].step(frames * steps_a_frame, kinds[n].threads > 1 ? &team : nullptr, kinds[n].threads);
      if (round > 0) costs[n].ns.push_back(1e9 * watch.wall_s() / (frames * steps_a_frame * cells));
    }
  return costs;
}

}  // namespace palpate::bench
