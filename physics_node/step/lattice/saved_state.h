#pragma once
// A state of a body to go back to, for the guard.

#include <vector>

#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

template <class Real>
class SavedState {
 public:
  SavedState(const Body& body, const LatticeState<Real>& state);

  /// Copies displacements and the ledger, and what has yielded and broken if anything has since the last call.
  void take(const Body& body, const LatticeState<Real>& state) noexcept;
  /// Puts back what was taken, at rest.
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
