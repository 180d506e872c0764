#pragma once
// A body of hexahedra on levels of twice, four, eight times its cells: what solves most of a system in one V-cycle.

#include "physics_node/step/multigrid/dense_solver.h"
#include "physics_node/step/multigrid/supports.h"

namespace palpate::physics {

/// A = M / dt^2 + scale K(u) of a body, K the positive tangent of hex_tangent.h, on every level at the displacement of the level below
/// it: the tangent turns with the body everywhere. Cells that contain held nodes have the stiffness of their parts at rest, scaled.
///
/// The V-cycle smooths before and after with Chebyshev's polynomials of the fourth kind in D^-1 A, D the 3 x 3 blocks,
///   d_k = (2k - 3)/(2k + 1) d_{k-1} + (8k - 4)/((2k + 1) l) D^-1 r,   x += d_k,   r -= A d_k,
/// l the largest eigenvalue of one cell for its own blocks, which bounds that of any body, and 1.15 of it for what is deformed. It is
/// symmetric, and a good preconditioner of conjugate gradients; on its own it may diverge on ragged bodies.
/// Where planes hold nodes (supports.h) it is one of P A P, P leaving out what they hold, on every level.
/// Source: Lottes 2023 for the polynomials.
/// Cost: bench/fem. Contract: allocates and throws nothing after construction; the same bits on any number of threads.
template <class Real>
class Hierarchy {
 public:
  explicit Hierarchy(const Body& body);

  std::size_t n_levels() const noexcept { return levels_.size(); }
  Level<Real>& fine() noexcept { return levels_.front(); }
  const Level<Real>& fine() const noexcept { return levels_.front(); }
  const Level<Real>& level(std::size_t n) const noexcept { return levels_[n]; }
  /// Of each node of the fine level, that of the body; -1: none.
  const std::vector<Index>& storage() const noexcept { return storage_; }

  /// @param dt  0: statics [s]
  void set_step(double dt) noexcept;
  /// Planes that hold nodes of the fine level from the next linearise() on; without planes it does not look at them.
  Supports& supports() noexcept { return supports_.front(); }
  void set_planes(std::span<const Plane> planes) noexcept { planes_ = planes; }
  /// Takes the tangent at fine().u, and what is held.
  void linearise(const Crew& crew, double scale) noexcept;
  /// Takes from a vector of the fine level what is held of it.
  void take_held(const Crew& crew, Three<Real>& three) const noexcept { take_held(0, crew, three); }
  /// fine().x, about A^-1 of fine().r, which it uses up.
  void v_cycle(const Crew& crew) noexcept;
  /// Where the bound turns out to be too small.
  void double_bound() noexcept { largest_ *= 2; }
  double bound() const noexcept { return largest_; }

 private:
  struct Transfer {
    ShareTable down, up, inject;  // see CoarserLevel
  };
  void smooth(std::size_t n, const Crew& crew, int from) noexcept;
  void cycle(std::size_t n, const Crew& crew) noexcept;
  void solve_coarsest(const Crew& crew) noexcept;
  void take_held(std::size_t n, const Crew& crew, Three<Real>& three) const noexcept;

  std::vector<Level<Real>> levels_;
  std::vector<Transfer> transfers_;  // from level n to n + 1
  std::vector<Supports> supports_;   // by level
  std::span<const Plane> planes_;
  std::vector<Index> storage_;
  DenseSolver coarsest_;
  bool physical_;
  int degree_;
  double largest_;
};

}  // namespace palpate::physics
