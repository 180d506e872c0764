// The element kernel, compiled once per instruction set: element_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL
// and include this.

#include "physics_node/step/lattice/element_context.h"
#include "physics_node/step/lattice/pack.h"
// after pack.h
#include "physics_node/step/lattice/move_masses.inl"
// after move_masses.inl
#include "physics_node/step/lattice/element_law.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

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
  book_watched(watched, state, ledger);
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
