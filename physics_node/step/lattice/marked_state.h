#pragma once
// A state of a body to come back to, for who undoes a cut: to the bit, with what hangs together.

#include <span>
#include <vector>

#include "physics_node/step/lattice/saved_state.h"

namespace palpate::physics {

template <class Real>
class MarkedState {
 public:
  /// Makes room.
  MarkedState(const Body& body, const LatticeState<Real>& state);

  void take(const Body& body, const LatticeState<Real>& state) noexcept;
  /// Faces that were open, in the order in which they were opened.
  std::span<const EdgeGone> open() const noexcept { return open_; }
  /// Puts back what was taken. Contract: these faces are open, and no others.
  void bring_back(const Body& body, LatticeState<Real>& state) const noexcept;

 private:
  SavedState<Real> saved_;
  Three<Real> v_, v_half_;
  std::vector<EdgeGone> open_;
};

}  // namespace palpate::physics
