#pragma once
// The hot kernel: forces of all elements of every mass, gathered, and the step of the mass, in one pass.

#include "physics_node/step/state.h"

namespace palpate::physics {

/// One step of symplectic Euler of every mass of a body:
///
///   f_i = sum over live elements (i, j) of f(l, l') u_ij,   u_ij = (x_j - x_i) / l,   l' = (v_j - v_i) . u_ij
///   v_i := v_i + dt (f_i / m_i + g),   x_i := x_i + dt v_i
///
/// Reads state.u, v, mask, l_c, y_p; writes state.next_u, next_v, then swaps. Every mass sums its own elements in
/// the order of the stencil, so the bits do not depend on the number of threads. An element is computed twice,
/// once from each end: that needs no scatter and no colours. Displacements, not positions, are stored, so that in
/// single precision the stretch of an element is as exact as the displacements are.
/// Source: Wakamatsu & Honma 2011, eqs. (1), (2); Takada & Abe, "Euler method".
/// Deviation: semi-implicit where the papers' Euler is explicit, which gains energy (EQUATIONS C-32).
/// @param threads  1: no team
template <class Real>
void element_step(const Body& body, LatticeState<Real>& state, double dt, const Vec3& gravity,
                  int threads) noexcept;

/// Commits yield and break once per step, from the static force at the positions reached. Only for bodies that
/// yield. @return how many elements broke in this step
template <class Real>
std::int64_t yield_and_break(const Body& body, LatticeState<Real>& state, int threads) noexcept;

}  // namespace palpate::physics
