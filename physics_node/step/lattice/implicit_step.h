#pragma once
// backward_euler: steps as long as a frame, however stiff the tissue is.

#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/lattice/implicit_solver.h"
#include "physics_node/step/lattice/linearised_elements.h"
#include "physics_node/step/plane_contact.h"

namespace palpate::physics {

/// Solves, with D the displacement during the step,
///
///   r(D) = M (D / dt - v_n) / dt - f(u_n + D, D / dt) - M g - F + b D / dt = 0,   then u := u_n + D, v := D / dt
///
/// by Newton's method, at most 30 iterations with a line search; the linear systems by conjugate gradients without a matrix,
/// preconditioned with the inverse 3 x 3 block of each mass, and left where compressed tissue buckles. Yield and break are
/// committed at the end, once. First order in dt; damps what it does not resolve, and the ledger says how much.
/// D stays where no plane is passed, by projection; a mass on a plane that r would drive into it is solved for in the other
/// directions only, and r there is the force of the plane (Bertsekas 1982: projected Newton).
/// Source: Baraff & Witkin 1998; Nocedal & Wright, line search Newton-CG; Matthies & Strang 1979 for the line search.
/// Cost: about 30 ns per mass and conjugate-gradient iteration, one thread. Contract: allocates and throws nothing
/// after construction.
template <class Real>
class ImplicitStep final : public ImplicitSolver<Real> {
 public:
  explicit ImplicitStep(const Body& body);
  void solve(const Body& body, const LatticeState<Real>& state, const ExplicitStep& how,
             const StepForces& forces, bool again) noexcept override;
  Vec3 velocity(Index cell, double dt) const noexcept override { return vector_at(D_, cell) / dt; }
  ImplicitReport finish(const Body& body, LatticeState<Real>& state, const ExplicitStep& how,
                        const StepForces& forces, MomentumAccount& momentum) noexcept override;

 private:
  /// Where the dampers of the elements are drag, adds up the drag of every mass; elements break, so once a step.
  void find_drag(const Body& body, const LatticeState<Real>& state) noexcept;
  /// r of D_, which is kept out of the planes before, without their forces; its norm. Linearises the elements there.
  double residual(const Body& body, const LatticeState<Real>& state, const ExplicitStep& how,
                  const StepForces& forces) noexcept;
  /// Moves D_ out of the planes. @return how far at most [m]
  double keep_out_of(const Body& body, const LatticeState<Real>& state,
                     std::span<const Plane> planes) noexcept;
  /// Takes from r_ what planes hold, into reaction_, and remembers in held_ which masses and where.
  void find_reactions(const Body& body, std::span<const Plane> planes) noexcept;
  /// Takes from a field what planes hold of it.
  void take_held(Field& field) const noexcept;
  void make_preconditioner(const Body& body, double dt) noexcept;
  /// y := (M / dt^2 + b / dt + A) x
  void apply(const Body& body, double dt, const Field& x, Field& y) const noexcept;
  /// Solves for the Newton step, into x_. @return iterations
  int conjugate_gradients(const Body& body, double dt, double tolerance) noexcept;
  /// Before the state moves on: tells of the planes' impulses and what they took, and finds what masses leave them with.
  /// @return what the step took there [J]
  double meet_planes(const Body& body, const LatticeState<Real>& state, const ExplicitStep& how,
                     MomentumAccount& momentum) noexcept;

  LinearisedElements<Real> elements_;
  Field D_, trial_, r_, r_start_, x_, p_, z_, q_;
  std::array<ZeroedArray<double>, 6> inverse_;  // of the diagonal blocks: xx yy zz yz xz xy
  ZeroedArray<double> mass_, drag_;             // 0 where held  (n_cells)
  std::vector<PlaneSet> at_;                    // planes that a mass lies on; none without planes  (n_cells)
  struct Held {
    Index cell = 0;
    HeldDirections directions;
    Vec3 R = Vec3::Zero();   // force of the planes [N]
    Vec3 dv = Vec3::Zero();  // with which they throw it back [m/s]
  };
  std::vector<Held> held_;  // by planes, in storage order
  ImplicitReport report_;
  double enough_ = 0;  // of r [N]
};

}  // namespace palpate::physics
