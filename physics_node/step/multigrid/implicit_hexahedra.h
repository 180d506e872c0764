#pragma once
// backward_euler for finite elements: Newton's method on conjugate gradients with one V-cycle.

#include "physics_node/step/lattice/implicit_solver.h"
#include "physics_node/step/multigrid/newton.h"

namespace palpate::physics {

/// Solves, with D the displacement during the step,
///
///   M (D / dt - v_n) / dt = f(u_n + D) + f_v(u_n, D) + M g + F
///
/// from D = dt v_n, to a thousandth of the forces in play. First order in dt; damps what it does not resolve, and the ledger says how
/// much. The damper f_v is that of explicit steps over the whole step (see Lagging), and what it took is its work.
/// Cost: about 500 ns a cell, bench/fem. Contract: allocates and throws nothing after construction; the same bits on any number
/// of threads.
template <class Real>
class ImplicitHexahedra final : public ImplicitSolver<Real> {
 public:
  explicit ImplicitHexahedra(const Body& body);
  void solve(const Body& body, const LatticeState<Real>& state, const ExplicitStep& how,
             const StepForces& forces, bool again) noexcept override;
  Vec3 velocity(Index cell, double dt) const noexcept override;
  ImplicitReport finish(const Body& body, LatticeState<Real>& state, const ExplicitStep& how,
                        const StepForces& forces, MomentumAccount& momentum) noexcept override;

 private:
  void take(const LatticeState<Real>& state, const Crew& crew) noexcept;
  void push(const Crew& crew, const Vec3& gravity, const StepForces& forces) noexcept;
  double work_of(std::span<const NodalForce> forces) const noexcept;
  void give(LatticeState<Real>& state, const Crew& crew, double dt) noexcept;
  /// What the step took: viscous and numerical [J].
  void book(LatticeState<Real>& state, const Crew& crew, const NewtonTask& task, double before) noexcept;
  /// What planes did: their impulses, and the velocities with which masses leave them. After give().
  void bounce(LatticeState<Real>& state, const ExplicitStep& how, MomentumAccount& momentum) noexcept;
  double work_of_elements(const Crew& crew) noexcept;

  Newton<Real> newton_;
  std::vector<Index> node_of_;  // of the level, by node of the body; -1: no cell has it  (n_cells)
  ZeroedArray<double> mass_;    // 0: held [kg]                                     (n_nodes of the level)
  ImplicitReport report_;
  double before_ = 0;  // elastic energy when the step began [J]
};

}  // namespace palpate::physics
