#include "physics_node/step/lattice/measure.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics_node/body/element_constants.h"
#include "physics_node/step/rigid_fit.h"

namespace palpate::physics {
namespace {

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
};

/// Calls visit(element) for every live element.
template <class Real, class Visit>
void for_each_element(const Body& body, const LatticeState<Real>& s, const Visit& visit) {
  const Lattice& lattice = body.lattice;
  const bool yields = any_yields(body);
  for (const Index i : lattice.masses) {
    const auto c = static_cast<std::size_t>(i);
    const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(i))];
    for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
      if (((s.mask[c] >> d) & 1) == 0) continue;
      const Index j = i + offset[d];
      const ElementConstants e = element_constants(body, i, j, d);
      const double L = lattice.rest_length[d];
      const Vec3 stretch = vector_of(s.u, j) - vector_of(s.u, i);
      const double q = stretch.dot(2 * lattice.rest_vector[d] + stretch);
      const double l = std::sqrt(std::max(L * L + q, 1e-6 * L * L));
      const double longer = q / (l + L);
      ElementNow now{i, j,   (lattice.rest_vector[d] + stretch) / l, l / L, e.k1 * longer, e.k1, e.c, 0,
                     0, e.k1};
      if (yields) {
        const auto l_c = static_cast<double>(s.l_c[d][c]);
        const double s_y = (e.y_p - 1) * L + static_cast<double>(s.hardening[d][c]);
        now.beyond = std::max(0.0, longer - s_y);
        now.f_y = e.k1 * (s_y - l_c);
        now.k2 = e.k2;
        now.f_s = now.beyond > 0 ? now.f_y + e.k2 * now.beyond : e.k1 * (longer - l_c);
      }
      visit(now);
    }
  }
}

/// What dampers and drag do to masses with velocities v, as power on masses that move with w; < 0 where v and w are the same. [W]
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

template <class Real>
double drag_power(const Body& body, Index i, const Three<Real>& v, const Three<Real>& w) {
  return -law_at(body, i).drag * vector_of(v, i).dot(vector_of(w, i));
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

}  // namespace

template <class Real>
Energies measure_energies(const Body& body, const LatticeState<Real>& state, const Vec3& gravity) {
  Energies e;
  const Three<Real>& v = before_the_kick(state);
  double power = 0;  // of all forces on the masses [W]
  for (const Index i : body.lattice.masses) {
    const double w = body.inverse_mass[static_cast<std::size_t>(i)];
    if (w == 0) continue;
    e.kinetic += 0.5 / w * vector_of(state.v, i).squaredNorm();
    e.between += 0.5 / w * vector_of(v, i).squaredNorm();
    e.gravitational -= gravity.dot(vector_of(state.u, i)) / w;
    power += gravity.dot(vector_of(v, i)) / w + drag_power(body, i, state.v, v);
  }
  for_each_element(body, state, [&](const ElementNow& now) {
    e.elastic += now.f_s * now.f_s / (2 * now.k1);
    power += damper_power(body, now, state.v, v) - now.f_s * now.along(v);
  });
  e.between += 0.5 * goes_on_by(state) * power;
  return e;
}

template <class Real>
Losses measure_due(const Body& body, const LatticeState<Real>& state) {
  Losses due;
  const double dt = goes_on_by(state);
  const Three<Real>& v = before_the_kick(state);
  double passed = 0;  // power of dampers over the step before, where it is booked exactly [W]
  for (const Index i : body.lattice.masses) {
    due.viscous -= dt * drag_power(body, i, state.v, state.v);
    if (state.v_seen_known)
      passed -= 0.5 * (drag_power(body, i, state.v, v) + drag_power(body, i, state.v_seen, v));
  }
  for_each_element(body, state, [&](const ElementNow& now) {
    due.viscous -= dt * damper_power(body, now, state.v, state.v);
    if (state.v_seen_known)
      passed -= 0.5 * (damper_power(body, now, state.v, v) + damper_power(body, now, state.v_seen, v));
    due.plastic += 0.5 * (now.f_y + now.f_s) * (1 - now.k2 / now.k1) * now.beyond;
    // As commit_yield() books it: see element_law.inl.
    const double before = std::max(0.0, state.dt_before * now.along(v) - now.beyond);
    due.numerical -= 0.5 * (now.k1 - now.k2) * before * now.beyond;
  });
  if (!state.v_seen_known) return due;
  due.viscous = std::max(0.0, dt * passed);
  due.numerical += std::min(0.0, dt * passed);
  return due;
}

template <class Real>
Losses measure_losses(const LatticeState<Real>& state) {
  Losses sum;
  for (const RowLedger& row : state.ledger) {
    sum.viscous += row.viscous;
    sum.plastic += row.plastic;
    sum.numerical += row.numerical;
    sum.broken += row.broken;
    sum.breaks += row.breaks;
  }
  return sum;
}

template <class Real>
MomentumAccount::Start measure_momenta(const Body& body, const Three<Real>& u,
                                       const Three<Real>& v) noexcept {
  MomentumAccount::Start sum;
  for (const Index i : body.lattice.masses)
    sum.add(node_mass(body, i), body.lattice.rest_position(i) + vector_of(u, i), vector_of(v, i));
  return sum;
}

template <class Real>
BodyCounts measure_counts(const Body& body, const LatticeState<Real>& state) {
  BodyCounts counts;
  counts.elements = body.lattice.n_elements();
  for_each_element(body, state, [&](const ElementNow& now) {
    ++counts.live_elements;
    counts.max_stretch = std::max(counts.max_stretch, now.stretch);
  });
  if (any_yields(body))
    for (const Index i : body.lattice.masses) counts.yielded_masses += has_yielded(body, state, i) ? 1 : 0;
  return counts;
}

template <class Real>
double measure_shape_rms(const Body& body, const LatticeState<Real>& state) {
  Eigen::Matrix3Xd rest(3, body.lattice.n_masses());
  Eigen::Matrix3Xd now(3, body.lattice.n_masses());
  Eigen::Index column = 0;
  for (const Index i : body.lattice.masses) {
    rest.col(column) = body.lattice.rest_position(i);
    now.col(column++) = body.lattice.rest_position(i) + vector_of(state.u, i);
  }
  return rigid_fit_rms(rest, now);
}

template Energies measure_energies(const Body&, const LatticeState<float>&, const Vec3&);
template Energies measure_energies(const Body&, const LatticeState<double>&, const Vec3&);
template Losses measure_due(const Body&, const LatticeState<float>&);
template Losses measure_due(const Body&, const LatticeState<double>&);
template Losses measure_losses(const LatticeState<float>&);
template Losses measure_losses(const LatticeState<double>&);
template MomentumAccount::Start measure_momenta(const Body&, const Three<float>&,
                                                const Three<float>&) noexcept;
template MomentumAccount::Start measure_momenta(const Body&, const Three<double>&,
                                                const Three<double>&) noexcept;
template BodyCounts measure_counts(const Body&, const LatticeState<float>&);
template BodyCounts measure_counts(const Body&, const LatticeState<double>&);
template double measure_shape_rms(const Body&, const LatticeState<float>&);
template double measure_shape_rms(const Body&, const LatticeState<double>&);

}  // namespace palpate::physics
