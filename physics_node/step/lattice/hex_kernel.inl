// The kernel of hexahedra, compiled once per instruction set: hex_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/pack.h"
// after pack.h
#include "physics_node/step/lattice/move_masses.inl"
// after pack.h
#include "physics_node/step/lattice/hex_cells.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// Clears what cells gave to a row that is nobody's business: not all cells around it have given.
template <class Real, bool exact>
void forget_forces(const HexContext<Real>& m, const RowSegment& row) {
  using P = Pack<Real>;
  for (Index i = row.first; i < row.first + row.count; i += P::width)
    for (int a = 0; a < 3; ++a) {
      P::store(m.high[a] + i, typename P::V{});
      P::store(m.masses.f[a] + i, typename P::V{});
      if constexpr (exact) {
        P::store(m.rate_low[a] + i, typename P::V{});
        P::store(m.rate_high[a] + i, typename P::V{});
      }
    }
}

/// Moves the masses of a row with what all cells around them gave, and clears it. Rows at a rim stand.
/// @return of dampers, - (f + f_before) . v; only exact
template <class Real, bool exact, bool stands>
typename Pack<Real>::V move_row(const HexContext<Real>& m, const RowSegment& row, Watched<Real>& watched) {
  using P = Pack<Real>;
  typename P::V lost{};
  for (Index i = row.first; i < row.first + row.count; i += P::width) {
    Masses<Real> p;
    p.i = i;
    for (int a = 0; a < 3; ++a) {
      p.u[a] = P::load(m.masses.u[a] + i);
      p.v[a] = P::load(m.masses.v[a] + i);
      p.f[a] = P::load(m.high[a] + i) + P::load(m.masses.f[a] + i);
      P::store(m.high[a] + i, typename P::V{});
      if (m.pulled[a] != nullptr) P::store(m.pulled[a] + i, p.f[a]);
      if constexpr (exact) {
        const typename P::V f = P::load(m.rate_high[a] + i) + P::load(m.rate_low[a] + i);
        lost = P::fnma(f + P::load(m.rate_seen[a] + i), p.v[a], lost);
        P::store(m.rate_seen[a] + i, f);
        P::store(m.rate_low[a] + i, typename P::V{});
        P::store(m.rate_high[a] + i, typename P::V{});
      }
    }
    if constexpr (stands)
      hold_masses(m.masses, p, watched);
    else
      move_masses<Real, false, false>(m.masses, p, watched);
  }
  return lost;
}

/// Moves the masses of some rows, and books them.
template <class Real, bool damped, bool relaxing, bool exact = false>
void move(const HexContext<Real>& m, Index first_row, Index last_row) {
  for (auto r = static_cast<std::size_t>(first_row); r < static_cast<std::size_t>(last_row); ++r) {
    const RowState state = m.masses.row_state[r];
    if (state == RowState::asleep) continue;
    const RowSegment row = m.masses.rows[r];
    RowLedger& ledger = m.masses.ledger[r];
    Watched<Real> watched;
    if (m.masses.watch || m.masses.begins) watched.clear();
    typename Pack<Real>::V of_rate{};
    if (state == RowState::awake)
      of_rate = move_row<Real, exact, false>(m, row, watched);
    else if (state == RowState::rim)
      of_rate = move_row<Real, exact, true>(m, row, watched);
    else
      forget_forces<Real, exact>(m, row);
    double elastic = 0, lost = 0, lost_after = 0;
    const bool by_nodes = exact && m.rate_known;
    if (by_nodes) lost = 0.5 * m.dt_before * static_cast<double>(Pack<Real>::sum(of_rate));
    for (Index n = m.runs_of_row[r]; n < m.runs_of_row[r + 1]; ++n) {
      elastic += m.elastic[n];
      if constexpr (damped) lost += by_nodes ? 0 : m.damped[n];
      if constexpr (relaxing) lost += m.lost_before[n], lost_after += m.lost_after[n];
    }
    if constexpr (damped || relaxing) {
      if (m.books)
        m.passed[r] += lost;
      else
        m.passed[r] = ledger.viscous;
      if (m.masses.watch) ledger.viscous = m.passed[r];
      m.passed[r] += lost_after;
    }
    if (m.masses.begins) ledger.numerical += static_cast<double>(Pack<Real>::sum(watched.begun));
    if (!m.masses.watch) continue;
    ledger.elastic = elastic;
    if (state != RowState::far_rim) book_watched(watched, state, ledger);
  }
}

template <class Real, template <class> class Law, bool physical>
HexKernel<Real> kernel_of(HexKind kind) {
  if (!kind.damped) return {&forces<Real, Law, physical, false, false>, &move<Real, false, false>};
  if (kind.exact) return {&forces<Real, Law, physical, true, false, true>, &move<Real, true, false, true>};
  return {&forces<Real, Law, physical, true, false>, &move<Real, true, false>};
}

template <class Real>
HexKernel<Real> relaxing_kernel(HexKind kind) {
  if (!kind.damped) return {&forces<Real, StableNeoHookean, true, false, true>, &move<Real, false, true>};
  if (kind.exact)
    return {&forces<Real, StableNeoHookean, true, true, true, true>, &move<Real, true, true, true>};
  return {&forces<Real, StableNeoHookean, true, true, true>, &move<Real, true, true>};
}

}  // namespace

template <class Real>
HexKernel<Real> hex_kernel(HexKind kind) {
  if (kind.relaxing) return relaxing_kernel<Real>(kind);
  if (kind.law == TissueLaw::green)
    return kind.physical ? kernel_of<Real, StVenantKirchhoff, true>(kind)
                         : kernel_of<Real, StVenantKirchhoff, false>(kind);
  return kind.physical ? kernel_of<Real, StableNeoHookean, true>(kind)
                       : kernel_of<Real, StableNeoHookean, false>(kind);
}

template HexKernel<float> hex_kernel<float>(HexKind);
template HexKernel<double> hex_kernel<double>(HexKind);

}  // namespace palpate::physics::PALPATE_KERNEL
