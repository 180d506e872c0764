#pragma once
// A step of backward_euler, whatever elements a body has.

#include <span>

#include "physics_node/step/explicit_step.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

struct NodalForce;

struct ImplicitReport {
  int newton_iterations = 0;
  int cg_iterations = 0;
  bool converged = false;
  double work = 0;  // of the nodal forces [J]
};

template <class Real>
class ImplicitSolver {
 public:
  virtual ~ImplicitSolver() = default;
  /// u := u_n + D, v := D / dt, with D solved for; what was lost goes to the ledger of the first row. Contract: allocates and throws
  /// nothing.
  virtual ImplicitReport step(const Body& body, LatticeState<Real>& state, const ExplicitStep& how,
                              std::span<const NodalForce> forces) noexcept = 0;
};

}  // namespace palpate::physics
