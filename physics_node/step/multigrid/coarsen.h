#pragma once
// The next level of a hierarchy: cells of twice the size, and how displacements and forces pass between both.

#include <span>

#include "physics_node/step/multigrid/grid_level.h"

namespace palpate::physics {

struct NodeShare {
  Index node = 0;
  float share = 0;
};

/// Shares of nodes of one level in those of another.
struct ShareTable {
  std::vector<NodeShare> shares;
  std::vector<Index> begin;  // [n] up to [n + 1]  (n_nodes + 1)

  std::span<const NodeShare> of(Index node) const noexcept {
    const auto n = static_cast<std::size_t>(node);
    return {shares.data() + begin[n], shares.data() + begin[n + 1]};
  }
};

/// A level and what leads to it from the finer one.
struct CoarserLevel {
  GridLevel level;
  ShareTable down;  // P, trilinear: coarse nodes of each fine one; none of a held one        (fine nodes)
  ShareTable up;    // P^T: fine nodes of each coarse one                                      (coarse nodes)
  ShareTable
      inject;  // where a coarse node is: at its fine one, or beyond the fine cell nearest to it  (coarse nodes)
};

/// Cells of one place that share no node, not even through others of that place, become several coarse cells, and corners of
/// neighbours are one node only if some fine cell of one shares a node with some fine cell of the other. So a slit stays open on
/// all levels. A coarse cell has the mean modulus of its eight parts, empty ones too. A coarse node that no free node depends on
/// is held. Sets GridCell::parent of the finer level.
/// Source: Dick, Georgii, Westermann 2011 for the copies.
CoarserLevel coarsen(GridLevel& fine);

}  // namespace palpate::physics
