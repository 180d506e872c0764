#pragma once
// The hot kernel: forces of all elements, and the step of every mass, in one pass over memory.

#include "physics_node/step/explicit_step.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

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
/// Energy. Both integrators are leapfrog, v(-) the velocity that moved the masses to x and v(+) the one after the kick there. Over a
/// step every force F works by the trapezoid (F + F') / 2 . dx on K = sum of m v(-) . v(+) / 2, and for a linear spring the
/// trapezoid is what it stores: so K + elastic + gravitational at one x changes by what is booked and by nothing else. Booked are
///   dissipated   c w^2 dt of each element, w the rate that its damper sees; where something may strike, `exact`: its trapezoid
///                c (w + w_before) / 2 . w_moved dt_before, by row, where that is a loss
///   numerical    where it is none; what the trapezoid differs from the path of yielding and breaking, see element_law.inl;
///                with another dt than before what K differs by, since v(+) is then another
/// What comes after the sweep, tools, contact and floor, works by J . (v(-) + v(+)) / 2.
/// Without `exact` dampers are booked c (w' - w)^2 dt / 4 of each element and step too much: little, unless something strikes.
/// Source: Hairer, Lubich & Wanner 2003 (leapfrog and its energy).
/// Source: Wakamatsu & Honma 2011, eqs. (1), (2); Takada & Abe, "Euler method".
/// Deviation: semi-implicit where the papers' Euler is explicit, which gains energy (EQUATIONS C-32).
/// Cost: bench/kernel. Contract: allocates, locks and throws nothing.
/// @return elements broken in this step
template <class Real>
std::int64_t element_step(const Body& body, LatticeState<Real>& state, const ExplicitStep& step) noexcept;

}  // namespace palpate::physics
