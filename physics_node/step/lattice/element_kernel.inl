// The element kernel, compiled once per instruction set: element_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL
// and include this.

#include "physics_node/step/lattice/element_context.h"
#include "physics_node/step/lattice/pack.h"
// after pack.h
#include "physics_node/step/lattice/element_law.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// What the ledger is told of a row when it is watched.
template <class Real>
struct Watched {
  typename Pack<Real>::V speed2, acceleration2, kinetic, between, fallen, fallen_before;
  typename Pack<Real>::V begun;  // energy that a step of another dt takes [J]

  void clear() {
    speed2 = acceleration2 = kinetic = between = fallen = fallen_before = begun = typename Pack<Real>::V{};
  }
};

template <class Real>
inline __attribute__((always_inline)) typename Pack<Real>::V drag_of(const ElementContext<Real>& m, Index i) {
  return m.drag_of != nullptr ? Pack<Real>::load(m.drag_of + i) : Pack<Real>::all(m.drag);
}

/// Held masses have inverse mass w zero: neither force nor gravity moves them. @param b  their drag
template <class Real, class V>
inline __attribute__((always_inline)) V acceleration_of(const ElementContext<Real>& m, const Masses<Real>& p,
                                                        V w, V b, int a) {
  using P = Pack<Real>;
  const V gravity = w > V{} ? P::all(m.g[a]) : V{};
  return P::fma(P::fnma(b, p.v[a], p.f[a]), w, gravity);
}

/// Before a first step, or one of another dt: what K = m v(-) . v(+) / 2 becomes less, as v(+) becomes another. Velocity Verlet
/// begins anew with v, and v(-) = 2 v - v(+); without a step before K is m v^2 / 2.
template <class Real, bool verlet>
__attribute__((noinline)) void watch_begin(const ElementContext<Real>& m, const Masses<Real>& p,
                                           Watched<Real>& watched) {
  using P = Pack<Real>;
  using V = typename P::V;
  const V w = P::load(m.inverse_mass + p.i), b = drag_of(m, p.i);
  V less{};
  for (int a = 0; a < 3; ++a) {
    const V acceleration = acceleration_of(m, p, w, b, a);
    if constexpr (verlet) {
      const V half = P::load(m.v_half[a] + p.i), quarter = acceleration * P::all(Real(0.5) * m.dt);
      if (m.dt_before > 0) less += half * P::fma_all(acceleration, m.dt_before, half) - p.v[a] * p.v[a];
      less = P::fma(quarter, quarter, less);
    } else {
      less += p.v[a] * acceleration * P::all(m.dt_before - m.dt);
    }
  }
  watched.begun += P::where(w > V{}, less / (w + w));
}

/// What the ledger is told of masses that have moved.
template <class Real, bool verlet>
__attribute__((noinline)) void watch_masses(const ElementContext<Real>& m, const Masses<Real>& p,
                                            Watched<Real>& watched) {
  using P = Pack<Real>;
  using V = typename P::V;
  const V w = P::load(m.inverse_mass + p.i), b = drag_of(m, p.i);
  V v2{}, a2{}, vv{}, fallen{}, fallen_before{};
  for (int a = 0; a < 3; ++a) {
    const V acceleration = acceleration_of(m, p, w, b, a), v = P::load(m.v[a] + p.i);
    v2 = P::fma(v, v, v2);
    a2 = P::fma(acceleration, acceleration, a2);
    const V after = verlet ? P::load(m.v_half[a] + p.i) : v;
    const V before = !verlet    ? p.v[a]
                     : m.begins ? p.v[a] + p.v[a] - after
                                : after - acceleration * P::all(m.dt);
    vv = P::fma(before, after, vv);
    fallen = P::fma_all(P::load(m.u[a] + p.i), m.g[a], fallen);
    fallen_before = P::fma_all(p.u[a], m.g[a], fallen_before);
  }
  const V mass = w > V{} ? Real(1) / w : V{};
  watched.speed2 = P::larger(watched.speed2, v2);
  watched.acceleration2 = P::larger(watched.acceleration2, a2);
  watched.kinetic = P::fma_all(mass * v2, Real(0.5), watched.kinetic);
  watched.between = P::fma_all(mass * vv, Real(0.5), watched.between);
  watched.fallen = P::fma(mass, fallen, watched.fallen);
  watched.fallen_before = P::fma(mass, fallen_before, watched.fallen_before);
}

/// Moves a pack of masses with the force gathered, and clears it for the next step.
///   symplectic Euler:  v := v + dt a,  x := x + dt v
///   velocity Verlet as leapfrog:  v_half := v_half + kick a,  x := x + dt v_half,  v := v_half + dt / 2 a
template <class Real, bool verlet, bool exact>
inline __attribute__((always_inline)) void move_masses(const ElementContext<Real>& m, Masses<Real>& p,
                                                       Watched<Real>& watched) {
  using P = Pack<Real>;
  using V = typename P::V;
  // Copies are shown to the functions that watch, so that p itself stays in registers.
  if (__builtin_expect(m.begins, false)) {
    const Masses<Real> before = p;
    watch_begin<Real, verlet>(m, before, watched);
  }
  const V w = P::load(m.inverse_mass + p.i), b = drag_of(m, p.i);
  V drag_power{};
  for (int a = 0; a < 3; ++a) {
    const V acceleration = acceleration_of(m, p, w, b, a);
    drag_power = P::fma(b * p.v[a], p.v[a], drag_power);
    if constexpr (exact) {
      const V seen = P::load(m.v_seen[a] + p.i);
      p.passed += Real(0.5) * b * (p.v[a] + seen) * P::load(m.moved[a] + p.i);
      P::store(m.v_seen[a] + p.i, p.v[a]);
    }
    V v, u;
    if constexpr (verlet) {
      const V half = P::fma_all(acceleration, m.kick, P::load(m.kicked[a] + p.i));
      P::store(m.v_half[a] + p.i, half);
      u = P::fma_all(half, m.dt, p.u[a]);
      v = P::fma_all(acceleration, Real(0.5) * m.dt, half);
    } else {
      v = P::fma_all(acceleration, m.dt, p.v[a]);
      u = P::fma_all(v, m.dt, p.u[a]);
    }
    P::store(m.u[a] + p.i, u);
    P::store(m.v[a] + p.i, v);
    P::store(m.f[a] + p.i, V{});
  }
  p.viscous += drag_power;
  if (__builtin_expect(m.watch, false)) {
    const Masses<Real> before = p;
    watch_masses<Real, verlet>(m, before, watched);
  }
}

/// A rim row stands still; whether it should wake is told by the acceleration that it would have.
template <class Real>
void hold_masses(const ElementContext<Real>& m, const Masses<Real>& p, Watched<Real>& watched) {
  using P = Pack<Real>;
  using V = typename P::V;
  const V w = P::load(m.inverse_mass + p.i);
  V a2{};
  for (int a = 0; a < 3; ++a) {
    const V acceleration = P::fma(p.f[a], w, w > V{} ? P::all(m.g[a]) : V{});
    a2 = P::fma(acceleration, acceleration, a2);
    P::store(m.f[a] + p.i, V{});
  }
  if (m.watch) watched.acceleration2 = P::larger(watched.acceleration2, a2);
}

template <class Real, DamperKind damper, bool yields, bool varied, bool verlet, bool exact>
void step_row(const ElementContext<Real>& m, const RowSegment& row, const SlotList<Real>& slots, Sweep sweep,
              RowState state, RowLedger& ledger) {
  using P = Pack<Real>;
  using V = typename P::V;
  const Streams<Real> at_mass{{m.u[0], m.u[1], m.u[2]},
                              {m.v[0], m.v[1], m.v[2]},
                              {m.f[0], m.f[1], m.f[2]},
                              {m.moved[0], m.moved[1], m.moved[2]},
                              {m.v_seen[0], m.v_seen[1], m.v_seen[2]}};
  V viscous{}, passed{}, elastic{};
  Watched<Real> watched;
  if (m.watch || m.begins) watched.clear();
  // Whole packs only: the cells beyond a row's end are empty, and stepping an empty cell leaves it as it is.
  for (Index i = row.first; i < row.first + row.count; i += P::width) {
    Masses<Real> p;
    p.i = i;
    p.mask = P::load_masks(m.mask + i);
    for (int a = 0; a < 3; ++a) {
      p.u[a] = P::load(at_mass.u[a] + i);
      p.v[a] = P::load(at_mass.v[a] + i);
      p.f[a] = P::load(at_mass.f[a] + i);
    }
#pragma GCC unroll 2
    for (int n = 0; n < slots.n; ++n)
      add_elements<Real, damper, yields, varied, verlet, exact>(m, at_mass, slots.slot[n], p, ledger);
    if (sweep == Sweep::up) {
      for (int a = 0; a < 3; ++a) P::store(m.f[a] + i, p.f[a]);
    } else if (state != RowState::awake) {
      hold_masses(m, p, watched);
    } else {
      move_masses<Real, verlet, exact>(m, p, watched);
    }
    viscous += p.viscous;
    if constexpr (exact) passed += p.passed;
    elastic += p.elastic;
  }
  [[maybe_unused]] const auto power = static_cast<double>(P::sum(viscous)), dt = static_cast<double>(m.dt);
  if constexpr (exact) {
    // A damper that lags behind a bounce gives energy for a step; what it loses never falls.
    const double work = static_cast<double>(m.dt_before) * static_cast<double>(P::sum(passed));
    (work > 0 ? ledger.viscous : ledger.numerical) += work;
  } else {
    ledger.viscous += dt * power;
    if (__builtin_expect(m.begins, false))
      ledger.numerical += (static_cast<double>(m.dt_before) - dt) * power;
  }
  if (__builtin_expect(m.begins, false)) ledger.numerical += static_cast<double>(P::sum(watched.begun));
  if (!m.watch) return;
  if (sweep == Sweep::up) {
    ledger.elastic_up = static_cast<double>(P::sum(elastic));
    return;
  }
  ledger.elastic = static_cast<double>(P::sum(elastic)) + ledger.elastic_up;
  ledger.acceleration2 = static_cast<double>(P::largest(watched.acceleration2));
  if (state != RowState::awake) return;
  ledger.speed2 = static_cast<double>(P::largest(watched.speed2));
  ledger.kinetic = static_cast<double>(P::sum(watched.kinetic));
  ledger.between = static_cast<double>(P::sum(watched.between));
  ledger.fallen = static_cast<double>(P::sum(watched.fallen));
  ledger.fallen_before = static_cast<double>(P::sum(watched.fallen_before));
}

template <class Real, DamperKind damper, bool yields, bool varied, bool verlet, bool exact>
void kernel(const ElementContext<Real>& m, Index first_row, Index last_row, Sweep sweep) {
  const SlotList<Real>* lists = sweep == Sweep::all ? m.all : sweep == Sweep::up ? m.up : m.level;
  for (Index r = first_row; r < last_row; ++r) {
    if (m.row_state[r] == RowState::asleep) continue;
    const RowSegment row = m.rows[r];
    step_row<Real, damper, yields, varied, verlet, exact>(m, row, lists[row.kind], sweep, m.row_state[r],
                                                          m.ledger[r]);
  }
}

template <class Real, DamperKind damper, bool yields, bool varied>
ElementKernel<Real> by_integrator(KernelKind kind) {
  if (kind.exact)
    return kind.verlet ? &kernel<Real, damper, yields, varied, true, true>
                       : &kernel<Real, damper, yields, varied, false, true>;
  return kind.verlet ? &kernel<Real, damper, yields, varied, true, false>
                     : &kernel<Real, damper, yields, varied, false, false>;
}

template <class Real, DamperKind damper>
ElementKernel<Real> by_law(KernelKind kind) {
  if (kind.varied)
    return kind.yields ? by_integrator<Real, damper, true, true>(kind)
                       : by_integrator<Real, damper, false, true>(kind);
  return kind.yields ? by_integrator<Real, damper, true, false>(kind)
                     : by_integrator<Real, damper, false, false>(kind);
}

}  // namespace

template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind) {
  switch (kind.damper) {
    case DamperKind::none:
      return by_law<Real, DamperKind::none>(kind);
    case DamperKind::axial:
      return by_law<Real, DamperKind::axial>(kind);
    case DamperKind::other:
      break;
  }
  return by_law<Real, DamperKind::other>(kind);
}

template ElementKernel<float> element_kernel<float>(KernelKind);
template ElementKernel<double> element_kernel<double>(KernelKind);

}  // namespace palpate::physics::PALPATE_KERNEL
