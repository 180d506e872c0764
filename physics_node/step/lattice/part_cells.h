#pragma once
// A cut parts cells of finite elements: their nodes split, and nothing else changes. A copy has the displacement and velocity
// of the node that it splits off from, and both have the eighths of the masses of their own cells: mass, momentum and angular momentum
// stay as they are but for rounding, and the energy of every cell to the bit.

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// Gives a copy place and velocity of its node, and both their masses.
template <class Real>
void share_node(Body& body, LatticeState<Real>& state, const NodeSplit& split) noexcept;

/// What is known of a node is known of its copy; where there is nothing, nothing.
template <class Real>
void copy_value(Three<Real>& of_nodes, const NodeSplit& split) noexcept {
  for (auto& axis : of_nodes)
    if (axis.size() > 0)
      axis[static_cast<std::size_t>(split.copy)] = axis[static_cast<std::size_t>(split.node)];
}

/// Opens the faces between cells that are joined. Contract: allocates and throws nothing.
/// @param on_split  void(NodeSplit), for what else is known of nodes
/// @return how many were opened
template <class Real, class OnSplit>
std::int64_t part_cells(Body& body, LatticeState<Real>& state, std::span<const EdgeGone> between,
                        const OnSplit& on_split) noexcept {
  CellNet& net = *body.solid->net;
  const std::size_t known = net.splits().size();
  std::int64_t opened = 0;
  for (const EdgeGone& gone : between) opened += net.open(gone.a, gone.b, gone.cut) ? 1 : 0;
  for (const NodeSplit& split : net.splits().subspan(known)) {
    share_node(body, state, split);
    on_split(split);
  }
  return opened;
}

/// Joins all cells again, with masses as loaded. Places and velocities of nodes as loaded stay.
template <class Real>
void rejoin_cells(Body& body, LatticeState<Real>& state) noexcept;

}  // namespace palpate::physics
