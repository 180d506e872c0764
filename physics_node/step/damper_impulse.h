#pragma once
// What an impulse changes in the books of the dampers.

#include "physics_node/step/state.h"

namespace palpate::physics {

/// What dampers lose less than the kernel books because a mass takes an impulse, which changes its velocity by dv, at the
/// beginning of a step of dt. [J]
///
/// An element's damper does work F_d dt . (w + w') / 2, w and w' its rate before and after the step, but the kernel books
/// F_d dt w. With symplectic Euler F_d = c w, and the sum over steps of w (w' - w) / 2 is that of -(w' - w)^2 / 4: small in
/// smooth motion, but not where an impulse makes w jump. So for each element of the mass, with u along it,
///   symplectic Euler:  c dt (dv . u)^2 / 4        velocity Verlet:  c dt w (dv . u) / 2, with its sign
/// An element whose other end takes an impulse in the same step is counted as if each came alone.
/// Only for dampers along elements.
template <class Real>
double booked_too_much(const Body& body, const LatticeState<Real>& state, Index cell, const Vec3& dv,
                       double dt, bool verlet) noexcept;

}  // namespace palpate::physics
