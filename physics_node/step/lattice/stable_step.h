#pragma once
// How large an explicit step may be.

#include "common/scene/kinds.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

/// Largest squared frequency and damping rate of a body that only axial forces act in [1/s^2, 1/s].
struct StiffestMode {
  double omega2 = 0;
  double gamma = 0;
};

/// Near rest: the smaller of two upper bounds,
///   Bloch       largest_eigenvalue of the lattice with the stiffest constants present, over the lightest mass;
///   Gershgorin  2 sum k / m, 2 sum c / m over the live elements of a mass (EQUATIONS C-32).
/// The first is sharp for one material, the second does without the lattice's order where many meet. Finite elements have bounds of their
/// own: hex_spectrum.h, fem/tet_spectrum.h.
StiffestMode stiffest_mode(const Body& body);

/// However the body is stretched, compressed or folded: Gershgorin's bound alone, since an element is nowhere stiffer than k1,
/// k1 [n n^T + (1 - L / l) (I - n n^T)] <= k1 I. Folding can turn elements into one direction, and so a step near the bound
/// at rest can become too long; the guard then halves it.
StiffestMode stiffest_mode_anyhow(const Body& body);

/// Bound of the stable step [s]; infinite where nothing can move.
///   symplectic_euler  dt < (sqrt(gamma^2 + 4 omega^2) - gamma) / omega^2
///   velocity_verlet   the same with 2 gamma, since its dampers see a predicted velocity
///   backward_euler    none: infinite
double stable_step(const StiffestMode& mode, Integrator integrator);

}  // namespace palpate::physics
