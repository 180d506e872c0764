#include "physics_node/step/lattice/measure.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/element_now.h"
#include "physics_node/step/rigid_fit.h"

namespace palpate::physics {
namespace {

/// Calls visit(element) for every live element.
template <class Real, class Visit>
void for_each_element(const Body& body, const LatticeState<Real>& s, const Visit& visit) {
  const bool yields = any_yields(body);
  for (const Index i : body.lattice.masses) {
    const auto& offset = body.lattice.offset[static_cast<std::size_t>(body.lattice.row_kind(i))];
    for (std::size_t d = 0; d < static_cast<std::size_t>(body.lattice.n_half); ++d)
      if ((s.mask[static_cast<std::size_t>(i)] >> d & 1) != 0)
        visit(element_now(body, s, i, i + offset[d], d, yields));
  }
}

template <class Real>
double drag_power(const Body& body, Index i, const Three<Real>& v, const Three<Real>& w) {
  return -law_at(body, i).drag * vector_of(v, i).dot(vector_of(w, i));
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
    e.elastic += now.elastic();
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
    if (state.v_seen_known) passed += passed_power(body, state, now);
    const Losses yielding = due_of_yield(state, now);
    due.plastic += yielding.plastic;
    due.numerical += yielding.numerical;
  });
  if (!state.v_seen_known) return due;
  due.viscous = std::max(0.0, dt * passed);
  due.numerical += std::min(0.0, dt * passed);
  return due;
}

template <class Real>
Losses measure_losses(const LatticeState<Real>& state) {
  Losses sum;
  for (const RowLedger& row : state.ledger) add_losses(row, sum);
  return sum;
}

template <class Real>
MomentumAccount::Start measure_momenta(const Body& body, const Three<Real>& u,
                                       const Three<Real>& v) noexcept {
  MomentumAccount::Start sum;
  body.each_node([&](Index i) {
    sum.add(node_mass(body, i), body.rest_position(i) + vector_of(u, i), vector_of(v, i));
  });
  return sum;
}

template <class Real>
MomentumAccount::Start measure_momenta(const Body& body, const LatticeState<Real>& state,
                                       const Three<Real>& v) noexcept {
  MomentumAccount::Start sum = measure_momenta(body, state.u, v);
  if (state.dt_before > 0)
    for (const Index node : state.fast.node) {
      const Vec3 mv = node_mass(body, node) * state.fast.lead(node);
      sum.momenta.linear += mv;
      sum.momenta.angular += (body.rest_position(node) + vector_of(state.u, node)).cross(mv);
    }
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
  return rigid_fit_rms([&](const auto& visit) {
    for (const Index i : body.lattice.masses) {
      const Vec3 rest = body.lattice.rest_position(i);
      visit(rest, rest + vector_of(state.u, i));
    }
  });
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
template MomentumAccount::Start measure_momenta(const Body&, const LatticeState<float>&,
                                                const Three<float>&) noexcept;
template MomentumAccount::Start measure_momenta(const Body&, const LatticeState<double>&,
                                                const Three<double>&) noexcept;
template BodyCounts measure_counts(const Body&, const LatticeState<float>&);
template BodyCounts measure_counts(const Body&, const LatticeState<double>&);
template double measure_shape_rms(const Body&, const LatticeState<float>&);
template double measure_shape_rms(const Body&, const LatticeState<double>&);

}  // namespace palpate::physics
