#pragma once
// Hexahedra that have a copy of a node at a corner, since a cut parted them from others: see lattice/cell_net.h.
//
// The sweep knows the nodes of a cell by where they are in storage, and leaves these out. Their corners are laid out side by
// side instead, as those of one run of cells are that share no corner, so that the same kernel does the same there:
//
//   gather u, v of all corners;   forces of the run;   add those to the nodes
//
// before the sweep, since it moves nodes as soon as it has their forces. Copies are a row of masses behind all others.
// Where the body is awake in parts, those that rest are left out.
// Cost: of the cells that are parted and act, about four times that of as many in a sweep; none before anything is cut.

#include <vector>

#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

template <class Real>
class PartedCells {
 public:
  /// @param body  with a net
  explicit PartedCells(const Body& body);

  /// Takes cells that have been parted since out of the sweep, and after a reset puts all back. Allocates nothing.
  /// @param stiffness  of the sweep, by lowest corner  (n_cells)
  void follow(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
              ZeroedArray<Real>& stiffness) noexcept;
  /// Adds their forces to state.f, and of exact steps those of their dampers to what the sweep adds its own to.
  /// @param sweep  what the kernel is told of the step
  void forces(const Body& body, LatticeState<Real>& state, const HexContext<Real>& sweep,
              const HexKernel<Real>& kernel) noexcept;
  /// Moves the copies, and books them and these cells in the last ledger of the state.
  void move(const Body& body, LatticeState<Real>& state, const HexContext<Real>& sweep,
            const HexKernel<Real>& kernel) noexcept;

  bool any() const noexcept { return known_ > 0; }        // acting or not
  double stiffest() const noexcept { return stiffest_; }  // as of a run [Pa]
  double least_J() const noexcept { return least_J_; }
  double power() const noexcept { return power_; }  // that their dampers take [W]

 private:
  void leave(const Body& body, ZeroedArray<Real>& stiffness) noexcept;
  void list_acting(const Body& body, const HexGrid& grid, const LatticeState<Real>& state) noexcept;

  Index stride_ = 0;
  std::size_t known_ = 0;                         // of the net's parted(), so many are out of the sweep
  std::uint64_t row_changes_ = 0, n_resets_ = 0;  // of the state and of the net, when last followed
  std::vector<std::size_t> acting_;               // which of them act, in their order
  Three<Real> u_, v_, low_, high_, rate_low_,
      rate_high_;                // of corner a of the n-th: a stride + n  (8 stride)
  ZeroedArray<Real> stiffness_;  // of those that act  (stride)
  double elastic_ = 0, power_ = 0, damped_ = 0, passed_ = 0, least_J_ = 1, stiffest_ = 0;
};

}  // namespace palpate::physics
