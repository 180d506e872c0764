#include "physics_node/step/lattice/fast_nodes.h"

#include "physics_node/step/lattice/hex_grid.h"

namespace palpate::physics {

template <class Real>
FastNodes<Real>::FastNodes(const Body& body) {
  if (!body.solid || body.solid->fast.cells.empty()) return;
  number.assign(static_cast<std::size_t>(body.capacity()), -1);
  cell.assign(number.size(), 0);
  for (const Index lowest : body.solid->fast.cells) {
    cell[static_cast<std::size_t>(lowest)] = 1;
    for (const Index corner : corners_of_cell(body.lattice, lowest))
      number[static_cast<std::size_t>(corner)] = 0;
  }
  for (const Index mass : body.lattice.masses) {
    std::int32_t& n = number[static_cast<std::size_t>(mass)];
    if (n < 0) continue;
    n = static_cast<std::int32_t>(node.size());
    node.push_back(mass);
  }
  for (ByNode* three : {&ahead, &held, &given}) three->resize(node.size());
}

template struct FastNodes<float>;
template struct FastNodes<double>;

}  // namespace palpate::physics
