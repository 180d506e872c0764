// The element kernel, compiled once per instruction set: element_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL
// and include this.

#include "physics_node/step/element_context.h"
#include "physics_node/step/pack.h"
// after pack.h
#include "physics_node/step/element_law.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// What the ledger is told of a row.
template <class Real>
struct Watched {
  typename Pack<Real>::V speed2{}, acceleration2{}, kinetic{}, fallen{};
};

/// Moves a pack of masses with the force gathered, and clears it for the next step.
///   symplectic Euler:  v := v + dt a,  x := x + dt v
///   velocity Verlet as leapfrog:  v_half := v_half + kick a,  x := x + dt v_half,  v := v_half + dt / 2 a
template <class Real, bool verlet>
inline __attribute__((always_inline)) void move_masses(const ElementContext<Real>& m, Masses<Real>& p,
                                                       Watched<Real>& watched) {
  using P = Pack<Real>;
  using V = typename P::V;
  const V w = P::load(m.inverse_mass + p.i);
  const V b = m.drag_of != nullptr ? P::load(m.drag_of + p.i) : P::all(m.drag);
  V v2{}, a2{}, drag_power{}, fallen{};
  for (int a = 0; a < 3; ++a) {
    // A held mass has inverse mass zero: neither force nor gravity moves it.
    const V gravity = w > V{} ? P::all(m.g[a]) : V{};
    const V force = P::fnma(b, p.v[a], p.f[a]);
    drag_power = P::fma(b * p.v[a], p.v[a], drag_power);
    const V acceleration = P::fma(force, w, gravity);
    V v, u;
    if constexpr (verlet) {
      const V half = P::fma_all(acceleration, m.kick, P::load(m.v_half[a] + p.i));
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
    v2 = P::fma(v, v, v2);
    a2 = P::fma(acceleration, acceleration, a2);
    fallen = P::fma_all(u, m.g[a], fallen);
  }
  p.viscous += drag_power;
  if (!m.watch) return;
  const V mass = w > V{} ? Real(1) / w : V{};
  watched.speed2 = P::larger(watched.speed2, v2);
  watched.acceleration2 = P::larger(watched.acceleration2, a2);
  watched.kinetic = P::fma_all(mass * v2, Real(0.5), watched.kinetic);
  watched.fallen = P::fma(mass, fallen, watched.fallen);
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
  watched.acceleration2 = P::larger(watched.acceleration2, a2);
}

template <class Real, DamperKind damper, bool yields, bool varied, bool verlet>
void step_row(const ElementContext<Real>& m, const RowSegment& row, const SlotList<Real>& slots, Sweep sweep,
              RowState state, RowLedger& ledger) {
  using P = Pack<Real>;
  using V = typename P::V;
  const Streams<Real> at_mass{{m.u[0], m.u[1], m.u[2]}, {m.v[0], m.v[1], m.v[2]}, {m.f[0], m.f[1], m.f[2]}};
  V viscous{}, elastic{};
  Watched<Real> watched;
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
      add_elements<Real, damper, yields, varied>(m, at_mass, slots.slot[n], p, ledger);
    if (sweep == Sweep::up) {
      for (int a = 0; a < 3; ++a) P::store(m.f[a] + i, p.f[a]);
    } else if (state != RowState::awake) {
      hold_masses(m, p, watched);
    } else {
      move_masses<Real, verlet>(m, p, watched);
    }
    viscous += p.viscous;
    elastic += p.elastic;
  }
  ledger.viscous += static_cast<double>(m.dt) * static_cast<double>(P::sum(viscous));
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
  ledger.fallen = static_cast<double>(P::sum(watched.fallen));
}

template <class Real, DamperKind damper, bool yields, bool varied, bool verlet>
void kernel(const ElementContext<Real>& m, Index first_row, Index last_row, Sweep sweep) {
  const SlotList<Real>* lists = sweep == Sweep::all ? m.all : sweep == Sweep::up ? m.up : m.level;
  for (Index r = first_row; r < last_row; ++r) {
    if (m.row_state[r] == RowState::asleep) continue;
    const RowSegment row = m.rows[r];
    step_row<Real, damper, yields, varied, verlet>(m, row, lists[row.kind], sweep, m.row_state[r], m.ledger[r]);
  }
}

template <class Real, DamperKind damper, bool yields, bool varied>
ElementKernel<Real> by_integrator(KernelKind kind) {
  return kind.verlet ? &kernel<Real, damper, yields, varied, true> : &kernel<Real, damper, yields, varied, false>;
}

template <class Real, DamperKind damper>
ElementKernel<Real> by_law(KernelKind kind) {
  if (kind.varied)
    return kind.yields ? by_integrator<Real, damper, true, true>(kind) : by_integrator<Real, damper, false, true>(kind);
  return kind.yields ? by_integrator<Real, damper, true, false>(kind) : by_integrator<Real, damper, false, false>(kind);
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
