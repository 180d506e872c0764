#pragma once
// How large an explicit step may be.

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Bound of the stable step of symplectic Euler, from the stiffness and mass actually present [s].
///
///   Every row of the dynamical matrix is at most  omega^2 = 2 sum k / m  and  gamma = 2 sum c / m  (Gershgorin, sums
///   over the elements of a mass). One oscillator v := v - dt (omega^2 x + gamma v), x := x + dt v  is stable for
///   dt < (sqrt(gamma^2 + 4 omega^2) - gamma) / omega^2.
///
/// Infinite where nothing can move.
double stable_step(const Body& body);

}  // namespace palpate::physics
