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

/// Forces and energy of some cells; with a memory that moves on.
template <class Real, template <class> class Law, bool physical, bool with_energy, class Here,
          class P = Pack<Real>, class V = typename P::V>
inline __attribute__((always_inline)) void cell_forces(const HexContext<Real>& m, const Corners<P>& w,
                                                       Here& here, HexForces<P>& out, LostByTerms<V>& lost) {
  if constexpr (std::is_same_v<Here, NothingRemembered>) {
    hex_forces<P, Law, physical, with_energy>(m.k, w, out);
  } else {
    Relaxing<P, Real> memory{{m.terms, m.n_terms}, here.terms};
    hex_forces<P, Law, physical, with_energy>(m.k, w, out, memory);
    lost = {memory.lost_before, memory.lost_after};
  }
}

/// Forces of the cells of a run, at w = u + beta v.
template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing, bool watched>
void run_forces(const HexContext<Real>& m, std::size_t r) {
  using P = Pack<Real>;
  using V = typename P::V;
  using Here = std::conditional_t<relaxing, RememberedHere<Real>, NothingRemembered>;
  const HexRun run = m.runs[r];
  Index at[8];
  for (Index a = 0; a < 8; ++a) at[a] = (a & 1) * run.right + (a >> 1 & 1) * m.up_y + (a >> 2) * m.up_z;
  V elastic{}, ahead{}, stiffest{}, lost_before{}, lost_after{};
  V least = P::all(1);  // of J - 1
  const bool torn = m.torn != nullptr && m.torn[r] != 0;
  // Whole packs only: cells beyond the run's end have no stiffness.
  for (Index i = run.first; i < run.first + run.count; i += P::width) {
    Corners<P> w;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) {
        w[c][a] = P::load(m.masses.u[c] + i + at[a]);
        if constexpr (damped) w[c][a] = P::fma_all(P::load(m.masses.v[c] + i + at[a]), m.beta, w[c][a]);
      }
    const V stiffness = P::load(m.stiffness + i);
    V whole = P::all(1);
    if (torn) {
      whole = whole - P::load(m.damage + i);
      // Corners of what is gone may be anywhere; no strain of theirs may become infinite.
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t a = 0; a < 8; ++a) w[c][a] = P::where(stiffness > V{}, w[c][a]);
    }
    Here here;
    if constexpr (relaxing) here.load(m, i);
    [[maybe_unused]] std::conditional_t<watched && damped, Here, NothingRemembered> before;
    if constexpr (relaxing && watched && damped) before = here;
    HexForces<P> out;
    LostByTerms<V> lost;
    cell_forces<Real, Law, physical, watched>(m, w, here, out, lost);
    if constexpr (relaxing) {
      here.store(m, i, stiffness);
      lost_before = P::fma(stiffness, lost.before, lost_before);
      lost_after = P::fma(stiffness, lost.after, lost_after);
    }
    // Lanes without a cell see the corners of others: what strain that makes is nobody's.
    if (torn) out.stiffness = whole * out.stiffness;
    stiffest = P::larger(stiffest, stiffness > V{} ? out.stiffness : V{});
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) {
        Real* f = (a < 4 ? m.masses.f[c] : m.high[c]) + i + at[a];
        P::store(f, P::fma(stiffness, out.f[c][a], P::load(f)));
      }
    if constexpr (watched && damped) {
      HexForces<P> at_u;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t a = 0; a < 8; ++a) {
          w[c][a] = P::load(m.masses.u[c] + i + at[a]);
          if (torn) w[c][a] = P::where(stiffness > V{}, w[c][a]);
        }
      if constexpr (relaxing) here = before;
      cell_forces<Real, Law, physical, true>(m, w, here, at_u, lost);
      ahead = P::fma(stiffness, out.energy - at_u.energy, ahead);
      elastic = P::fma(stiffness, at_u.energy, elastic);
    } else if constexpr (watched) {
      elastic = P::fma(stiffness, out.energy, elastic);
    }
    if constexpr (watched) {  // at u
      const V change = least_corner_change<P>(m.k, w);
      // What tears may fold: its corners part.
      const V counted = torn ? (whole < P::all(1) ? V{} : stiffness) : stiffness;
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
  if constexpr (watched && damped) m.ahead[r] = static_cast<double>(P::sum(ahead));
}

template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing>
void forces(const HexContext<Real>& m, Index first_run, Index last_run) {
  for (auto r = static_cast<std::size_t>(first_run); r < static_cast<std::size_t>(last_run); ++r) {
    if (m.acts != nullptr && m.acts[r] == 0) continue;
    m.masses.watch || !m.books ? run_forces<Real, Law, physical, damped, relaxing, true>(m, r)
                               : run_forces<Real, Law, physical, damped, relaxing, false>(m, r);
  }
}

/// Clears what cells gave to a row that is nobody's business: not all cells around it have given.
template <class Real>
void forget_forces(const HexContext<Real>& m, const RowSegment& row) {
  using P = Pack<Real>;
  for (Index i = row.first; i < row.first + row.count; i += P::width)
    for (int a = 0; a < 3; ++a) {
      P::store(m.high[a] + i, typename P::V{});
      P::store(m.masses.f[a] + i, typename P::V{});
    }
}

/// Moves the masses of a row with what all cells around them gave, and clears it. Rows at a rim stand.
/// @return by how much f + f' and v' - v went together: see move()
template <class Real, bool damped, bool stands>
typename Pack<Real>::V move_row(const HexContext<Real>& m, const RowSegment& row, Watched<Real>& watched) {
  using P = Pack<Real>;
  using V = typename P::V;
  V lost{};
  for (Index i = row.first; i < row.first + row.count; i += P::width) {
    Masses<Real> p;
    p.i = i;
    for (int a = 0; a < 3; ++a) {
      p.u[a] = P::load(m.masses.u[a] + i);
      p.v[a] = P::load(m.masses.v[a] + i);
      p.f[a] = P::load(m.high[a] + i) + P::load(m.masses.f[a] + i);
      P::store(m.high[a] + i, V{});
      if constexpr (damped) {
        if (m.books)
          lost = P::fma(p.f[a] + P::load(m.seen_f[a] + i), p.v[a] - P::load(m.seen_v[a] + i), lost);
        P::store(m.seen_f[a] + i, p.f[a]);
        P::store(m.seen_v[a] + i, p.v[a]);
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
///
/// The damper's loss. A step changes K = sum of m v(-) . v(+) / 2 and W(w), the elastic energy at w = u + beta v, together by
///   - beta/2 (f + f') . (v' - v),   exactly for linear elasticity,
/// so that with `passed` the sum of it, passed + W(w) - W(u) is what was lost of K + W(u): for linear elasticity the damper's own
/// work, beta v . K v dt, which never is negative.
template <class Real, bool damped, bool relaxing>
void move(const HexContext<Real>& m, Index first_row, Index last_row) {
  using P = Pack<Real>;
  for (auto r = static_cast<std::size_t>(first_row); r < static_cast<std::size_t>(last_row); ++r) {
    const RowState state = m.masses.row_state[r];
    if (state == RowState::asleep) continue;
    const RowSegment row = m.masses.rows[r];
    RowLedger& ledger = m.masses.ledger[r];
    Watched<Real> watched;
    if (m.masses.watch || m.masses.begins) watched.clear();
    [[maybe_unused]] typename P::V lost{};
    if (state == RowState::awake)
      lost = move_row<Real, damped, false>(m, row, watched);
    else if (state == RowState::rim)
      lost = move_row<Real, damped, true>(m, row, watched);
    else
      forget_forces(m, row);
    double elastic = 0, ahead = 0, lost_before = 0, lost_after = 0;
    for (Index n = m.runs_of_row[r]; n < m.runs_of_row[r + 1]; ++n) {
      elastic += m.elastic[n];
      if constexpr (damped) ahead += m.ahead[n];
      if constexpr (relaxing) lost_before += m.lost_before[n], lost_after += m.lost_after[n];
    }
    if constexpr (damped || relaxing) {
      if (m.books)
        m.passed[r] += 0.5 * static_cast<double>(m.beta) * static_cast<double>(P::sum(lost)) + lost_before;
      else
        m.passed[r] = ledger.viscous - ahead;
      if (m.masses.watch) ledger.viscous = m.passed[r] + ahead;
      m.passed[r] += lost_after;
    }
    if (m.masses.begins) ledger.numerical += static_cast<double>(P::sum(watched.begun));
    if (!m.masses.watch) continue;
    ledger.elastic = elastic;
    if (state != RowState::far_rim) book_watched(watched, state, ledger);
  }
}

template <class Real, template <class> class Law>
HexKernel<Real> kernel_of(HexKind kind) {
  if (kind.damped)
    return {kind.physical ? &forces<Real, Law, true, true, false> : &forces<Real, Law, false, true, false>,
            &move<Real, true, false>};
  return {kind.physical ? &forces<Real, Law, true, false, false> : &forces<Real, Law, false, false, false>,
          &move<Real, false, false>};
}

}  // namespace

template <class Real>
HexKernel<Real> hex_kernel(HexKind kind) {
  if (kind.relaxing)
    return kind.damped
               ? HexKernel<Real>{&forces<Real, StableNeoHookean, true, true, true>, &move<Real, true, true>}
               : HexKernel<Real>{&forces<Real, StableNeoHookean, true, false, true>,
                                 &move<Real, false, true>};
  return kind.law == TissueLaw::green ? kernel_of<Real, StVenantKirchhoff>(kind)
                                      : kernel_of<Real, StableNeoHookean>(kind);
}

template HexKernel<float> hex_kernel<float>(HexKind);
template HexKernel<double> hex_kernel<double>(HexKind);

}  // namespace palpate::physics::PALPATE_KERNEL
