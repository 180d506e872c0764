// The kernel of hexahedra, compiled once per instruction set: hex_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL and
// include this.

#include <type_traits>

#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/pack.h"
// after pack.h
#include "physics_node/step/lattice/move_masses.inl"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// What the cells from i on remember, term by term.
template <class Real, class V = typename Pack<Real>::V>
struct RememberedHere {
  std::array<Remembered<V>, most_relaxations> terms;

  void load(const HexContext<Real>& m, Index i) {
    for (std::size_t t = 0; t < m.n_terms; ++t)
      for (std::size_t n = 0; n < n_remembered; ++n) terms[t][n] = Pack<Real>::load(m.remembered[t][n] + i);
  }
  /// Only of cells that are there: other lanes may be of another run.
  void store(const HexContext<Real>& m, Index i, V stiffness) const {
    for (std::size_t t = 0; t < m.n_terms; ++t)
      for (std::size_t n = 0; n < n_remembered; ++n) {
        Real* at = m.remembered[t][n] + i;
        Pack<Real>::store(at, stiffness > V{} ? terms[t][n] : Pack<Real>::load(at));
      }
  }
};

/// A body that does not relax: nothing to load, nothing to store.
struct NothingRemembered {};

template <class V>
struct LostByTerms {
  V before{}, after{};
};

/// What the corners of some cells have, loaded one component after the other: all three at once would not fit into the registers.
template <class Real, bool torn, class P = Pack<Real>, class V = typename P::V>
struct CornersAt {
  const Real* const* of;  // by component
  const Index* at;        // of the corners, from the cell on
  Index i;
  V stiffness;

  inline __attribute__((always_inline)) std::array<V, 8> operator[](std::size_t c) const {
    std::array<V, 8> w;
    for (std::size_t a = 0; a < 8; ++a) {
      w[a] = P::load(of[c] + i + at[a]);
      // Corners of what is gone may be anywhere; no strain of theirs may become infinite.
      if constexpr (torn) w[a] = P::where(stiffness > V{}, w[a]);
    }
    return w;
  }
  Corners<P> all() const { return {(*this)[0], (*this)[1], (*this)[2]}; }
};

template <class Real, class Moves>
Damping<Pack<Real>, Real, Moves> damping_of(const HexContext<Real>& m, const Moves& v) {
  return {.beta = m.beta, .v = &v, .weight = m.damper_weight};
}

/// Forces and energy of some cells; with a memory that moves on. @param w  displacements of the corners; @param v  velocities
/// @param of_rate  the damper's part; only exact
template <class Real, template <class> class Law, bool physical, bool damped, bool with_energy, bool exact,
          class Here, class Moved, class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void cell_forces(const HexContext<Real>& m, const Moved& w,
                                                       const Moved& v, Here& here, HexForces<P>& out,
                                                       Corners<P>& of_rate, LostByTerms<V>& lost, V& power) {
  if constexpr (std::is_same_v<Here, NothingRemembered> && !damped) {
    Lasting lasting;
    hex_centre_forces<P, Law, physical, with_energy>(m.k, w, out, lasting);
  } else if constexpr (std::is_same_v<Here, NothingRemembered>) {
    Damping<P, Real, Moved> damping = damping_of(m, v);
    hex_centre_forces<P, Law, physical, with_energy>(m.k, w, out, damping);
    power = damping.power;
    if constexpr (exact) damping.forces(m.k, of_rate);
  } else if constexpr (damped) {
    RelaxingAndDamped<P, Real, Moved> both{{{m.terms, m.n_terms}, here.terms}, damping_of(m, v)};
    hex_centre_forces<P, Law, physical, with_energy>(m.k, w, out, both);
    lost = {both.relaxing.lost_before, both.relaxing.lost_after};
    power = both.damping.power;
    if constexpr (exact) both.damping.forces(m.k, of_rate);
  } else {
    Relaxing<P, Real> memory{{m.terms, m.n_terms}, here.terms};
    hex_centre_forces<P, Law, physical, with_energy>(m.k, w, out, memory);
    lost = {memory.lost_before, memory.lost_after};
  }
}

/// Adds what corners do that are about to fold: few cells have one.
template <class Real, class P = Pack<Real>, class V = typename P::V>
__attribute__((noinline)) void hold_corners(const HexContext<Real>& m, const Corners<P>& w, Index i,
                                            const Index* at, V stiffness, HexForces<P>& out) {
  CornerForces<P> corner;
  corner_forces<P>(m.k, w, corner);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 8; ++a) {
      Real* f = (a < 4 ? m.masses.f[c] : m.high[c]) + i + at[a];
      P::store(f, P::fma(stiffness, corner.f[c][a], P::load(f)));
    }
  out.stiffness += corner.stiffness;
  out.energy = corner.energy;
}

/// Forces of the cells of a run. @tparam torn  some have lost stiffness
template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing, bool exact,
          bool watched, bool torn>
void run_forces(const HexContext<Real>& m, std::size_t r) {
  using P = Pack<Real>;
  using V = typename P::V;
  using Here = std::conditional_t<relaxing, RememberedHere<Real>, NothingRemembered>;
  const HexRun run = m.runs[r];
  Index at[8];
  for (Index a = 0; a < 8; ++a) at[a] = (a & 1) * run.right + (a >> 1 & 1) * m.up_y + (a >> 2) * m.up_z;
  V elastic{}, power{}, stiffest{}, lost_before{}, lost_after{};
  V least = P::all(1);  // of J - 1
  // Whole packs only: cells beyond the run's end have no stiffness.
  for (Index i = run.first; i < run.first + run.count; i += P::width) {
    const V stiffness = P::load(m.stiffness + i);
    [[maybe_unused]] V whole = P::all(1);
    if constexpr (torn) whole = whole - P::load(m.damage + i);
    const CornersAt<Real, torn> w{m.masses.u, at, i, stiffness}, v{m.masses.v, at, i, stiffness};
    Here here;
    if constexpr (relaxing) here.load(m, i);
    HexForces<P> out;
    [[maybe_unused]] Corners<P> of_rate;
    LostByTerms<V> lost;
    V taken{};
    cell_forces<Real, Law, physical, damped, watched, exact>(m, w, v, here, out, of_rate, lost, taken);
    if constexpr (damped) power = P::fma(stiffness, taken, power);
    if constexpr (relaxing) {
      here.store(m, i, stiffness);
      lost_before = P::fma(stiffness, lost.before, lost_before);
      lost_after = P::fma(stiffness, lost.after, lost_after);
    }
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) {
        Real* f = (a < 4 ? m.masses.f[c] : m.high[c]) + i + at[a];
        P::store(f, P::fma(stiffness, out.f[c][a], P::load(f)));
      }
    if constexpr (exact)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t a = 0; a < 8; ++a) {
          Real* f = (a < 4 ? m.rate_low[c] : m.rate_high[c]) + i + at[a];
          P::store(f, P::fma(stiffness, of_rate[c][a], P::load(f)));
        }
    // Lanes without a cell see the corners of others: what strain that makes is nobody's.
    if (__builtin_expect(P::any_above_zero(stiffness > V{} ? out.fold : V{}), false)) {
      HexForces<P> more;
      more.stiffness = out.stiffness;
      hold_corners(m, w.all(), i, at, stiffness, more);
      out.stiffness = more.stiffness;
      if constexpr (watched) out.energy += more.energy;
    }
    if constexpr (torn) out.stiffness = whole * out.stiffness;
    stiffest = P::larger(stiffest, stiffness > V{} ? out.stiffness : V{});
    if constexpr (watched) elastic = P::fma(stiffness, out.energy, elastic);
    if constexpr (watched) {
      const V change = least_corner_change<P>(m.k, w.all());
      V counted = stiffness;
      if constexpr (torn)
        counted = whole < P::all(1) ? V{} : stiffness;  // what tears may fold: its corners part
      least = counted > V{} && change < least ? change : least;
    }
  }
  m.stiffest[r] = static_cast<double>(P::largest(stiffest));
  if constexpr (watched) {
    m.elastic[r] = static_cast<double>(P::sum(elastic));
    m.least_J[r] = 1 - static_cast<double>(P::largest(-least));
  }
  if constexpr (relaxing) {
    m.lost_before[r] = static_cast<double>(P::sum(lost_before));
    m.lost_after[r] = static_cast<double>(P::sum(lost_after));
  }
  if constexpr (damped) {
    const double now = static_cast<double>(P::sum(power));
    m.damped[r] = m.books ? damper_loss(m.dt_before, m.power[r], now) : 0;
    m.power[r] = now;
  }
}

template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing,
          bool exact = false>
void forces(const HexContext<Real>& m, Index first_run, Index last_run) {
  for (auto r = static_cast<std::size_t>(first_run); r < static_cast<std::size_t>(last_run); ++r) {
    if (m.acts != nullptr && m.acts[r] == 0) continue;
    // Only bodies of this law tear, and such that do not relax.
    if constexpr (!relaxing && std::is_same_v<Law<Pack<Real>>, StableNeoHookean<Pack<Real>>>)
      if (m.torn != nullptr && m.torn[r] != 0) {
        m.masses.watch ? run_forces<Real, Law, physical, damped, relaxing, exact, true, true>(m, r)
                       : run_forces<Real, Law, physical, damped, relaxing, exact, false, true>(m, r);
        continue;
      }
    m.masses.watch ? run_forces<Real, Law, physical, damped, relaxing, exact, true, false>(m, r)
                   : run_forces<Real, Law, physical, damped, relaxing, exact, false, false>(m, r);
  }
}

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
