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

double flops_per_tet(const physics::TetLayout& layout, TetElement element) {
  const Counts n = counts_of(layout);
  const physics::TetConstants<double> k;
  const physics::TetSlopes<Counting> b{};
  const std::array<physics::Column<Counting>, 4> u{};
  physics::TetForces<CountingPack> out;
  const double moved = 3 * 7;  // v + dt (f w + g), u + dt v
  double swelling = 0;
  if (element == TetElement::nodal) {
    counted = 0;
    physics::tet_volume_change<CountingPack>(b, u);
    swelling = counted + 2 + 4 + (n.parts + n.nodes) / n.tets + 4;  // to four corners; and the mean of four
  }
  counted = 0;
  physics::Undamped none;
  if (element == TetElement::second_order) {
    physics::Tet10Forces<CountingPack> of_ten;
    physics::tet10_forces<CountingPack, false>(k, b, Counting{}, std::array<physics::Column<Counting>, 10>{},
                                               none, of_ten);
  } else if (element == TetElement::nodal) {
    physics::tet_forces<CountingPack, true, false>(k, b, Counting{}, u, Counting{}, none, out);
  } else {
    physics::tet_forces<CountingPack, false, false>(k, b, Counting{}, u, Counting{}, none, out);
  }
  const double summed = 3 * static_cast<double>(layout.n_nodes);  // forces added to nodes
  return counted + swelling + summed + (3 * n.parts + moved * n.nodes) / n.tets;
}

double bytes_per_tet(const physics::TetLayout& layout, TetElement element, double real_size) {
  const Counts n = counts_of(layout);
  const double of_tet = 10 * real_size + 2 * static_cast<double>(layout.n_nodes);  // slopes, volume, corners
  const double of_part =
      4 * real_size + 4 + 3 * 4 * real_size;  // node read; its number; force written, and read again
  const double of_node = 4 * 4 * real_size + real_size + 4;  // u, v read and written; inverse mass; its list
  const double of_swelling = of_tet + (4 * real_size + 4 + 4 * real_size) * n.parts / n.tets;
  return of_tet + (of_part * n.parts + of_node * n.nodes) / n.tets +
         (element == TetElement::nodal ? of_swelling : 0);
}

}  // namespace palpate::bench
