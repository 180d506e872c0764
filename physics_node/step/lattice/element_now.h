#pragma once
// One spring as it is now, in double precision: what the books of a lattice measure, and what a cut takes out of them.

#include <algorithm>
#include <cmath>

#include "physics_node/body/element_constants.h"
#include "physics_node/step/books.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

struct ElementNow {
  Index i, j;
  Vec3 n;                  // direction
  double stretch;          // l / L
  double f_s, k1, c;       // static force [N], spring constant [N/m], damper [N s/m]
  double beyond, f_y, k2;  // of the yield stretch that stands [m]; force there [N]; the slope behind it [N/m]

  /// Of the rate at which it grows.
  template <class Real>
  double along(const Three<Real>& v) const {
    return n.dot(vector_of(v, j) - vector_of(v, i));
  }
  /// What unloading gives back [J].
  double elastic() const { return f_s * f_s / (2 * k1); }
};

/// Of the element of mass i in the half direction d, which leads to j, live or not. @param yields  any_yields(body)
template <class Real>
ElementNow element_now(const Body& body, const LatticeState<Real>& s, Index i, Index j, std::size_t d,
                       bool yields) {
  const Lattice& lattice = body.lattice;
  const auto c = static_cast<std::size_t>(i);
  const ElementConstants e = element_constants(body, i, j, d);
  const double L = lattice.rest_length[d];
  const Vec3 stretch = vector_of(s.u, j) - vector_of(s.u, i);
  const double q = stretch.dot(2 * lattice.rest_vector[d] + stretch);
  const double l = std::sqrt(std::max(L * L + q, 1e-6 * L * L));
  const double longer = q / (l + L);
  ElementNow now{i, j, (lattice.rest_vector[d] + stretch) / l, l / L, e.k1 * longer, e.k1, e.c, 0, 0, e.k1};
  if (yields) {
    const auto l_c = static_cast<double>(s.l_c[d][c]);
    const double s_y = (e.y_p - 1) * L + static_cast<double>(s.hardening[d][c]);
    now.beyond = std::max(0.0, longer - s_y);
    now.f_y = e.k1 * (s_y - l_c);
    now.k2 = e.k2;
    now.f_s = now.beyond > 0 ? now.f_y + e.k2 * now.beyond : e.k1 * (longer - l_c);
  }
  return now;
}

/// What its damper does to masses with velocities v, as power on masses that move with w; < 0 where v and w are the same. [W]
template <class Real>
double damper_power(const Body& body, const ElementNow& now, const Three<Real>& v, const Three<Real>& w) {
  switch (body.law.damper) {
    case Damper::axial:
      return -now.c * now.along(v) * now.along(w);
    case Damper::relative:
      return -now.c *
             (vector_of(v, now.j) - vector_of(v, now.i)).dot(vector_of(w, now.j) - vector_of(w, now.i));
    case Damper::drag:
      return -now.c *
             (vector_of(v, now.j).dot(vector_of(w, now.j)) + vector_of(v, now.i).dot(vector_of(w, now.i)));
  }
  return 0;
}

/// The velocity with which the last step moved the masses, if there was one: with velocity_verlet else that of now.
template <class Real>
const Three<Real>& before_the_kick(const LatticeState<Real>& state) {
  return state.v_half_known ? moving_velocity(state) : state.v;
}

/// dt of the next step where it goes on from the last, 0 where it begins anew. [s]
template <class Real>
double goes_on_by(const LatticeState<Real>& state) {
  return state.v_half[0].size() > 0 && !state.v_half_known ? 0 : state.dt_before;
}

/// Of its yielding since the last step, as commit_yield() books it with the next: see element_law.inl.
template <class Real>
Losses due_of_yield(const LatticeState<Real>& state, const ElementNow& now) {
  Losses due;
  // Why: of one that never yields, beside those that do, the force there is infinite.
  if (!(now.beyond > 0)) return due;
  due.plastic = 0.5 * (now.f_y + now.f_s) * (1 - now.k2 / now.k1) * now.beyond;
  const double before = std::max(0.0, state.dt_before * now.along(before_the_kick(state)) - now.beyond);
  due.numerical = -0.5 * (now.k1 - now.k2) * before * now.beyond;
  return due;
}

/// Power of its damper over the step before, where that is booked exactly (LatticeState::v_seen_known) [W]
template <class Real>
double passed_power(const Body& body, const LatticeState<Real>& state, const ElementNow& now) {
  const Three<Real>& v = before_the_kick(state);
  return -0.5 * (damper_power(body, now, state.v, v) + damper_power(body, now, state.v_seen, v));
}

}  // namespace palpate::physics
