#pragma once
// backward_euler: steps as long as a frame, however stiff the tissue is.

#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/lattice/implicit_solver.h"
#include "physics_node/step/lattice/linearised_elements.h"

namespace palpate::physics {

/// Solves, with D the displacement during the step,
///
///   r(D) = M (D / dt - v_n) / dt - f(u_n + D, D / dt) - M g - F + b D / dt = 0,   then u := u_n + D, v := D / dt
///
/// by Newton's method, at most 30 iterations with a line search; the linear systems by conjugate gradients without a matrix,
/// preconditioned with the inverse 3 x 3 block of each mass, and left where compressed tissue buckles. Yield and break are
/// committed at the end, once. First order in dt; damps what it does not resolve, and the ledger says how much.
/// Source: Baraff & Witkin 1998; Nocedal & Wright, line search Newton-CG; Matthies & Strang 1979 for the line search.
/// Cost: about 30 ns per mass and conjugate-gradient iteration, one thread. Contract: allocates and throws nothing
/// after construction.
template <class Real>
class ImplicitStep final : public ImplicitSolver<Real> {
 public:
  explicit ImplicitStep(const Body& body);
  ImplicitReport step(const Body& body, LatticeState<Real>& state, const ExplicitStep& how,
                      std::span<const NodalForce> forces) noexcept override;

 private:
  /// Where the dampers of the elements are drag, adds up the drag of every mass; elements break, so once a step.
  void find_drag(const Body& body, const LatticeState<Real>& state) noexcept;
  /// r of D_; its norm. Linearises the elements there.
  double residual(const Body& body, const LatticeState<Real>& state, double dt, const Vec3& gravity,
                  std::span<const NodalForce> forces) noexcept;
  void make_preconditioner(const Body& body, double dt) noexcept;
  /// y := (M / dt^2 + b / dt + A) x
  void apply(const Body& body, double dt, const Field& x, Field& y) const noexcept;
  /// Solves for the Newton step, into x_. @return iterations
  int conjugate_gradients(const Body& body, double dt, double tolerance) noexcept;
  void finish(const Body& body, LatticeState<Real>& state, const ExplicitStep& how) noexcept;

  LinearisedElements<Real> elements_;
  Field D_, trial_, r_, r_start_, x_, p_, z_, q_;
  std::array<ZeroedArray<double>, 6> inverse_;  // of the diagonal blocks: xx yy zz yz xz xy
  ZeroedArray<double> mass_, drag_;             // 0 where held  (n_cells)
};

}  // namespace palpate::physics
