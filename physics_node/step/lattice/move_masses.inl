// How masses move when all forces on them are gathered, whatever elements gave them; compiled once per instruction set, as part of
// a kernel that defines PALPATE_KERNEL.

#include "physics_node/step/lattice/element_context.h"
#include "physics_node/step/lattice/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// A pack of masses at the first end of their elements.
template <class Real>
struct Masses {
  using V = typename Pack<Real>::V;
  Index i;  // first cell
  typename Pack<Real>::I mask;
  V u[3], v[3], f[3];
  V viscous{};  // power lost in dampers so far [W]
  V passed{};   // the same as the step before did it: mean force then and now times motion; only exact [W]
  V elastic{};  // energy so far, only where it is watched [J]
};

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

/// What was seen of a row that stands or moves. @param state  of the row
template <class Real>
void book_watched(const Watched<Real>& watched, RowState state, RowLedger& ledger) {
  using P = Pack<Real>;
  ledger.acceleration2 = static_cast<double>(P::largest(watched.acceleration2));
  if (state != RowState::awake) return;
  ledger.speed2 = static_cast<double>(P::largest(watched.speed2));
  ledger.kinetic = static_cast<double>(P::sum(watched.kinetic));
  ledger.between = static_cast<double>(P::sum(watched.between));
  ledger.fallen = static_cast<double>(P::sum(watched.fallen));
  ledger.fallen_before = static_cast<double>(P::sum(watched.fallen_before));
}

}  // namespace
}  // namespace palpate::physics::PALPATE_KERNEL
