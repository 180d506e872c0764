#pragma once
// A step of backward_euler, whatever elements a body has.

#include "physics_node/step/explicit_step.h"
#include "physics_node/step/lattice/state.h"
#include "physics_node/step/pending_step.h"

namespace palpate::physics {

class MomentumAccount;

struct ImplicitReport {
  int newton_iterations = 0;
  int cg_iterations = 0;
  bool converged = false;
  double work = 0;          // of the forces of tools [J]
  double contact_lost = 0;  // to planes and other bodies [J]
};

template <class Real>
class ImplicitSolver {
 public:
  virtual ~ImplicitSolver() = default;
  /// Finds D. No mass passes a plane of the step: planes hold with forces R >= 0 along their normals, which are part of the solution.
  /// Contract, of all three: allocates and throws nothing.
  /// @param again  from the last D, and the same beginning, with other forces of contact
  virtual void solve(const Body& body, const LatticeState<Real>& state, const ExplicitStep& how,
                     const StepForces& forces, bool again) noexcept = 0;
  /// D / dt of a mass, as solved last. [m/s]
  virtual Vec3 velocity(Index cell, double dt) const noexcept = 0;
  /// u := u_n + D, v := D / dt; what was lost goes to the ledger of the first row, and `momentum` is told of planes and contact. What
  /// arrives at a plane leaves it as impact_of() has it.
  virtual ImplicitReport finish(const Body& body, LatticeState<Real>& state, const ExplicitStep& how,
                                const StepForces& forces, MomentumAccount& momentum) noexcept = 0;
  ImplicitReport step(const Body& body, LatticeState<Real>& state, const ExplicitStep& how,
                      const StepForces& forces, MomentumAccount& momentum) noexcept {
    solve(body, state, how, forces, false);
    return finish(body, state, how, forces, momentum);
  }
};

}  // namespace palpate::physics
