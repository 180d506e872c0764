#pragma once
// The coarsest level, solved at once.

#include <vector>

#include "physics_node/step/multigrid/supports.h"

namespace palpate::physics {

/// Most unknowns of it: a cube of five cells. Why: with a coarser one a slit or a stiff lump takes half as many V-cycles more; and its
/// factors, made at every Newton iteration, take a millisecond.
inline constexpr Index most_dense_unknowns = 648;

/// Cholesky factors in double, with 1 + 1e-6 on the diagonal: a body that nothing holds has motions that nothing resists.
class DenseSolver {
 public:
  DenseSolver() = default;
  /// @param free  nodes of the level that may move
  DenseSolver(std::vector<Index> free, const GridLevel& level);

  bool any() const noexcept { return !free_.empty(); }
  /// The matrix of the level, as it was linearised last. What planes hold it holds by springs, a thousand times stiffer.
  template <class Real>
  void factor(const LevelContext<Real>& m, bool physical, const Supports& supports,
              std::span<const Plane> planes) noexcept;
  /// x = A^-1 r; r must have, and of x counts, only what is not held
  template <class Real>
  void solve(const LevelContext<Real>& m) noexcept;

 private:
  double& at(std::size_t row, std::size_t column) noexcept { return factor_[column * n_ + row]; }
  template <class Real, bool physical>
  void add_cells(const LevelContext<Real>& m) noexcept;
  void add(const Index* corners, std::size_t row, std::size_t column, double entry) noexcept;
  void hold(const Supports& supports, std::span<const Plane> planes) noexcept;
  void decompose() noexcept;

  std::size_t n_ = 0;
  std::vector<Index> free_;       // nodes
  std::vector<Index> unknown_;    // first of each node; -1: none
  std::vector<std::size_t> end_;  // of each column: rows from there on are zero, and stay so
  std::vector<double> factor_;    // lower triangle, by column  (n, n)
  std::vector<double> y_;
};

}  // namespace palpate::physics
