#pragma once
// The hot kernel: forces of all elements, and the step of every mass, in one pass over memory.

#include "physics_node/step/state.h"
#include "physics_node/step/team.h"

namespace palpate::physics {

struct ExplicitStep {
  double dt = 0;               // [s]
  Vec3 gravity = Vec3::Zero(); // [m/s^2]
  Team* team = nullptr;        // null: no team
  int threads = 1;             // of the team that this step may use
  bool verlet = false;         // velocity_verlet; else symplectic Euler
  bool watch = false;          // note the speeds and accelerations of rows in state.ledger
};

/// One step of every mass of a body, in place:
///
///   f_i = sum over live elements (i, j) of f(l, l') u_ij,   u_ij = (x_j - x_i) / l,   l' = (v_j - v_i) . u_ij
///   symplectic Euler:  v_i := v_i + dt (f_i / m_i + g),   x_i := x_i + dt v_i
///   velocity Verlet:   v_i(t + dt/2) = v_i(t - dt/2) + dt (f_i / m_i + g),  x_i := x_i + dt v_i(t + dt/2);
///                      dampers use v_i(t) ~ v_i(t - dt/2) + dt/2 (f_i / m_i + g)(t - dt), which keeps the second order
///
/// Yield and break are committed where the force is computed, from the static force, once per step.
/// An element is computed once, from the end that comes first in storage; when the sweep reaches a mass, all elements
/// before it have added their share, so it moves at once and no second copy of the state is needed. Chunks are swept
/// by whichever thread comes first; the elements between chunks are computed before, so every sum has one order whatever the
/// number of threads. Displacements, not positions, are stored, so that in single precision the stretch of an element
/// is as exact as the displacements are.
/// Source: Wakamatsu & Honma 2011, eqs. (1), (2); Takada & Abe, "Euler method".
/// Deviation: semi-implicit where the papers' Euler is explicit, which gains energy (EQUATIONS C-32).
/// Cost: bench/kernel. Contract: allocates, locks and throws nothing.
/// @return elements broken in this step
template <class Real>
std::int64_t element_step(const Body& body, LatticeState<Real>& state, const ExplicitStep& step) noexcept;

}  // namespace palpate::physics
