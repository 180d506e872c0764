#include "bench/fem/tet_work.h"

#include <algorithm>

#include "bench/fem/counting.h"
#include "physics_node/step/fem/tet_element.h"

namespace palpate::bench {
namespace {

struct Counts {
  double tets, nodes, parts;
};

Counts counts_of(const physics::TetLayout& layout) {
  return {static_cast<double>(std::ranges::count_if(layout.tet, [](auto t) { return t >= 0; })),
          static_cast<double>(layout.of_node.begin.size() - 1), static_cast<double>(layout.node.size())};
}

}  // namespace

double flops_per_tet(const physics::TetLayout& layout, bool nodal_pressure) {
  const Counts n = counts_of(layout);
  physics::TetForces<CountingPack> out;
  const physics::TetConstants<double> k;
  const physics::TetSlopes<Counting> b{};
  const std::array<physics::Column<Counting>, 4> u{};
  const double moved = 3 * 7, summed = 12;  // v + dt (f w + g), u + dt v; forces added to four corners
  double swelling = 0;
  counted = 0;
  if (nodal_pressure) {
    physics::tet_forces<CountingPack, true, false>(k, b, Counting{}, u, Counting{}, out);
    counted += 4;  // mean of four nodes
    const double of_forces = counted;
    counted = 0;
    physics::tet_volume_change<CountingPack>(b, u);
    swelling = counted + 2 + 4 + (n.parts + n.nodes) / n.tets;
    counted = of_forces;
  } else {
    physics::tet_forces<CountingPack, false, false>(k, b, Counting{}, u, Counting{}, out);
  }
  return counted + swelling + summed + (3 * n.parts + moved * n.nodes) / n.tets;
}

double bytes_per_tet(const physics::TetLayout& layout, bool nodal_pressure, double real_size) {
  const Counts n = counts_of(layout);
  const double element = 10 * real_size + 8;  // slopes, volume, corners
  const double of_part =
      4 * real_size + 4 + 3 * 4 * real_size;  // node read; its number; force written, and read again
  const double of_node = 4 * 4 * real_size + real_size + 4;  // u, v read and written; inverse mass; its list
  const double of_swelling = element + (4 * real_size + 4 + 4 * real_size) * n.parts / n.tets;
  return element + (of_part * n.parts + of_node * n.nodes) / n.tets + (nodal_pressure ? of_swelling : 0);
}

}  // namespace palpate::bench
