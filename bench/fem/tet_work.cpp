#include "bench/fem/tet_work.h"

#include <algorithm>

#include "bench/fem/counting.h"
#include "physics_node/step/fem/tet10_element.h"

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

double flops_per_tet(const physics::TetLayout& layout, TetElement element, bool damped) {
  const Counts n = counts_of(layout);
  const physics::TetConstants<double> k;
  const physics::TetSlopes<Counting> b{};
  const std::array<physics::Column<Counting>, 4> u{};
  physics::TetForces<CountingPack> out;
  const double moved = 3 * 7;  // v + dt (f w + g), u + dt v
  double swelling = 0;
  if (element == TetElement::nodal) {
    counted = 0;
    if (damped)
      physics::tet_growth<CountingPack>(b, u, u);
    else
      physics::tet_volume_change<CountingPack>(b, u);
    const double sums = damped ? 2 : 1;  // of volumes, and of their rates
    swelling = counted + 1 +
               sums * (1 + 4 + (n.parts + n.nodes) / n.tets + 4);  // to four corners; and the mean of four
  }
  counted = 0;
  const std::array<physics::Column<Counting>, 10> of_ten_nodes{};
  const auto count = [&](auto& damping, auto& of_ten) {
    physics::Tet10Forces<CountingPack> forces;
    if (element == TetElement::second_order)
      physics::tet10_forces<CountingPack, false>(k, b, Counting{}, of_ten_nodes, of_ten, forces);
    else if (element == TetElement::nodal)
      physics::tet_forces<CountingPack, true, false>(k, b, Counting{}, u, Counting{}, damping, out);
    else
      physics::tet_forces<CountingPack, false, false>(k, b, Counting{}, u, Counting{}, damping, out);
  };
  if (damped) {
    physics::TetDamping<CountingPack, false> damping{.beta = {}, .v = &u};
    physics::Tet10Damping<CountingPack, false> of_ten{.beta = {}, .v = &of_ten_nodes, .f = {}};
    count(damping, of_ten);
    counted += 1;  // powers added up
  } else {
    physics::Undamped none;
    count(none, none);
  }
  const double summed = 3 * static_cast<double>(layout.n_nodes);  // forces added to nodes
  return counted + swelling + summed + (3 * n.parts + moved * n.nodes) / n.tets;
}

double bytes_per_tet(const physics::TetLayout& layout, TetElement element, double real_size, bool damped) {
  const Counts n = counts_of(layout);
  const double of_tet = 10 * real_size + 2 * static_cast<double>(layout.n_nodes);  // slopes, volume, corners
  const double read = (damped ? 2 : 1) * 4 * real_size;  // u of a node, damped v, too
  const double of_part =
      read + 4 + 3 * 4 * real_size;  // node read; its number; force written, and read again
  const double of_node = 4 * 4 * real_size + real_size + 4;  // u, v read and written; inverse mass; its list
  const double of_swelling = of_tet + (read + 4 + (damped ? 2 : 1) * 4 * real_size) * n.parts / n.tets;
  return of_tet + (of_part * n.parts + of_node * n.nodes) / n.tets +
         (element == TetElement::nodal ? of_swelling : 0);
}

}  // namespace palpate::bench
