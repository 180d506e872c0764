#include "physics_node/step/lattice/part_cells.h"

namespace palpate::physics {
namespace {

/// In the order in which they were summed up when the body was loaded, so that a node that joins again weighs what it did.
double mass_of(const Body& body, Index node) noexcept {
  double sum = 0;
  body.solid->net->each_corner(
      node, [&](Index cell, std::size_t) { sum += body.solid->eighth[static_cast<std::size_t>(cell)]; });
  return sum;
}

template <class Real>
void weigh(Body& body, LatticeState<Real>& state, Index node) noexcept {
  const auto n = static_cast<std::size_t>(node);
  const bool held = body.inverse_mass[static_cast<std::size_t>(body.origin(node))] == 0;
  body.solid->mass[n] = mass_of(body, node);
  body.inverse_mass[n] = held ? 0 : 1 / body.solid->mass[n];
  state.inverse_mass[n] = static_cast<Real>(body.inverse_mass[n]);
}

}  // namespace

template <class Real>
void share_node(Body& body, LatticeState<Real>& state, const NodeSplit& split) noexcept {
  for (auto* three : {&state.u, &state.v}) copy_value(*three, split);
  for (const Index node : {split.node, split.copy}) weigh(body, state, node);
}

template <class Real>
void rejoin_cells(Body& body, LatticeState<Real>& state) noexcept {
  CellNet& net = *body.solid->net;
  for (Index copy = net.n_loaded(); copy < net.n_nodes(); ++copy)
    body.inverse_mass[static_cast<std::size_t>(copy)] = 0,
    state.inverse_mass[static_cast<std::size_t>(copy)] = 0;
  net.reset([&](Index node) { weigh(body, state, node); });
}

#define PALPATE_PART_CELLS(Real)                                                   \
  template void share_node(Body&, LatticeState<Real>&, const NodeSplit&) noexcept; \
  template void rejoin_cells(Body&, LatticeState<Real>&) noexcept;

PALPATE_PART_CELLS(float)
PALPATE_PART_CELLS(double)
#undef PALPATE_PART_CELLS

}  // namespace palpate::physics
