#pragma once
// Conjugate gradients with one V-cycle as their preconditioner.

#include "physics_node/step/multigrid/hierarchy.h"

namespace palpate::physics {

struct GradientReport {
  int cycles = 0;       // V-cycles, and iterations
  double residual = 0;  // |b - A x|, by its own count
  bool converged = false;
};

/// Solves A x = b, in the directions that nothing holds: b must have no part in the others. Sums are by plane, in double, and planes in order. Where rounding or a bound that is too small makes a direction
/// of it not positive, the bound is doubled and the iteration begins again from where it is; twice at most.
/// Contract: allocates and throws nothing after construction; the same bits on any number of threads.
template <class Real>
class ConjugateGradients {
 public:
  explicit ConjugateGradients(const Hierarchy<Real>& hierarchy);

  Three<Real> b, x;  // by node of the fine level
  /// @param tolerance  of |b - A x| [of b]
  GradientReport solve(Hierarchy<Real>& hierarchy, const Crew& crew, double tolerance,
                       int most_cycles) noexcept;
  /// Sum of p . q over all nodes.
  double dot(const Hierarchy<Real>& hierarchy, const Crew& crew, const Three<Real>& p,
             const Three<Real>& q) noexcept;

 private:
  double total() const noexcept;
  /// z = about A^-1 r, in fine().x. @return r . z
  double precondition(Hierarchy<Real>& hierarchy, const Crew& crew) noexcept;

  Three<Real> r_, p_, q_;
  std::vector<double> by_plane_;
};

}  // namespace palpate::physics
