#pragma once
// What a step did to the connections of a body. A new kind of event is one more span here.

#include <array>
#include <cstddef>
#include <span>

#include "physics_node/lattice/lattice_types.h"
#include "physics_node/mesh/simplex_net.h"

namespace palpate::physics {

/// An element between two nodes that is no more. No two elements join the same nodes.
struct EdgeGone {
  Index a = 0, b = 0;
  FaceCut cut{};  // where a blade did it, on the way from a to b
};

/// A cell that is no more, of a body whose cells live and break as a whole: its corners. Elements that no other cell held are gone
/// with it, and are listed too.
struct CellGone {
  std::array<Index, 8> corners{};
};

struct TopologyEvents {
  static constexpr std::size_t most = 65536;  // of one kind
  /// In the last step or, behind those, cut at its end, in an order that does not depend on the number of threads; invalidated by
  /// the next step.
  std::span<const EdgeGone> edges_gone;
  std::span<const CellGone> cells_gone;
  std::span<const NodeSplit> nodes_split;  // of tetrahedra; a copy is listed before what splits off from it
  /// The list is not all: anything may have changed. After a reset and a restore at once and still after the next step, and
  /// after a step in which more broke than the list holds. Never where nothing breaks.
  bool overflow = false;

  bool none() const noexcept {
    return edges_gone.empty() && cells_gone.empty() && nodes_split.empty() && !overflow;
  }
};

}  // namespace palpate::physics
