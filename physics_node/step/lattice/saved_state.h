#pragma once
// A state of a body to go back to, for the guard.

#include <algorithm>
#include <vector>

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// Of all masses as loaded.
template <class T>
void copy_rows(const Body& body, const ZeroedArray<T>& from, ZeroedArray<T>& to) noexcept {
  for (const RowSegment& row : body.lattice.rows)
    std::copy_n(from.data() + row.first, row.count, to.data() + row.first);
}

/// Of all nodes, copies too.
template <class T>
void copy_nodes(const Body& body, const ZeroedArray<T>& from, ZeroedArray<T>& to) noexcept {
  copy_rows(body, from, to);
  if (const CellNet* net = body.cell_net())
    std::copy_n(from.data() + net->n_loaded(), net->n_copies(), to.data() + net->n_loaded());
}

template <class Real>
class SavedState {
 public:
  SavedState(const Body& body, const LatticeState<Real>& state);

  /// Copies displacements and the ledger, and what has yielded and broken if anything has since the last call.
  void take(const Body& body, const LatticeState<Real>& state) noexcept;
  /// A copy of a node was where that was.
  void split(const NodeSplit& split) noexcept;
  /// Puts back what was taken, at rest. What has been cut since stays so.
  void bring_back(const Body& body, LatticeState<Real>& state) const noexcept;

 private:
  Three<Real> u_;
  ByHalf<Real> l_c_, hardening_;
  std::vector<ZeroedArray<Real>> remembered_;
  ZeroedArray<Mask> mask_;
  FailedCells<Real> failed_;
  YieldedCells<Real> plastic_;
  std::vector<RowLedger> ledger_;
  std::int64_t yields_ = -1;  // how often elements had yielded when the memory was last copied
  std::int64_t breaks_ = 0;
};

}  // namespace palpate::physics
