// What the cells of hexahedra do to their corners, a run at a time: the first half of the kernel in hex_kernel.inl, which defines
// PALPATE_KERNEL.

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// What the cells from i on remember, term by term.
template <class P, class Real = typename P::Number, class V = typename P::V>
struct RememberedHere {
  std::array<Remembered<V>, most_relaxations> terms;

  void load(const HexContext<Real>& m, std::ptrdiff_t i) {
    for (std::size_t t = 0; t < m.n_terms; ++t)
      for (std::size_t n = 0; n < n_remembered; ++n) terms[t][n] = P::load(m.remembered[t][n] + i);
  }
  /// Only of cells that are there: other lanes may be of another run.
  void store(const HexContext<Real>& m, std::ptrdiff_t i, V stiffness) const {
    for (std::size_t t = 0; t < m.n_terms; ++t)
      for (std::size_t n = 0; n < n_remembered; ++n) {
        Real* at = m.remembered[t][n] + i;
        P::store(at, stiffness > V{} ? terms[t][n] : P::load(at));
      }
  }
};

/// A body that does not relax: nothing to load, nothing to store.
struct NothingRemembered {};

/// From the lowest corner of a cell to all: bit 0 of the number is +x, bit 1 +y, bit 2 +z.
struct ToCorners {
  std::ptrdiff_t right, up_y, up_z;

  inline __attribute__((always_inline)) std::ptrdiff_t operator[](std::size_t a) const {
    return ((a & 1) != 0 ? right : 0) + ((a & 2) != 0 ? up_y : 0) + ((a & 4) != 0 ? up_z : 0);
  }
};

/// What the corners of some cells have, loaded one component after the other: all three at once would not fit into the registers.
template <class P, bool torn, class Real = typename P::Number, class V = typename P::V>
struct CornersAt {
  std::array<const Real*, 3> of;  // by component, of the lowest corner
  ToCorners at;
  V stiffness;

  inline __attribute__((always_inline)) std::array<V, 8> operator[](std::size_t c) const {
    std::array<V, 8> w;
    for (std::size_t a = 0; a < 8; ++a) {
      w[a] = P::load(of[c] + at[a]);
      // Corners of what is gone may be anywhere; no strain of theirs may become infinite.
      if constexpr (torn) w[a] = P::where(stiffness > V{}, w[a]);
    }
    return w;
  }
};

/// What cells need of HexContext, copied: the compiler must take every store for one that changes what lies in memory.
template <class Real>
struct CellFields {
  HexConstants<Real> k;
  std::array<const Real*, 3> u, v;
  std::array<Real*, 3> low, high;
  const Real* stiffness;
  std::ptrdiff_t up_y, up_z;
  Real beta, damper_weight;

  explicit CellFields(const HexContext<Real>& m)
      : k(m.k),
        u{m.masses.u[0], m.masses.u[1], m.masses.u[2]},
        v{m.masses.v[0], m.masses.v[1], m.masses.v[2]},
        low{m.masses.f[0], m.masses.f[1], m.masses.f[2]},
        high{m.high[0], m.high[1], m.high[2]},
        stiffness(m.stiffness),
        up_y(m.up_y),
        up_z(m.up_z),
        beta(m.beta),
        damper_weight(m.damper_weight) {}
};

/// Adds forces on the corners of the cells from i on.
template <class P, class Real, class V = typename P::V>
inline __attribute__((always_inline)) void add_to_corners(const std::array<Real*, 3>& low,
                                                          const std::array<Real*, 3>& high, ToCorners at,
                                                          std::ptrdiff_t i, V stiffness,
                                                          const Corners<P>& force) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 8; ++a) {
      Real* f = (a < 4 ? low[c] : high[c]) + i + at[a];
      P::store(f, P::fma(stiffness, force[c][a], P::load(f)));
    }
}

/// What is kept of a run, lane by lane.
template <class P, class V = typename P::V>
struct RunBooks {
  V elastic{}, power{}, lost_before{}, lost_after{}, stiffest{};
  V least = P::all(1);  // of J - 1
};

/// And of all its lanes.
struct RunSums {
  double elastic = 0, power = 0, lost_before = 0, lost_after = 0, stiffest = 0, least = 1;

  template <class P>
  void add(const RunBooks<P>& books) {
    elastic += static_cast<double>(P::sum(books.elastic));
    power += static_cast<double>(P::sum(books.power));
    lost_before += static_cast<double>(P::sum(books.lost_before));
    lost_after += static_cast<double>(P::sum(books.lost_after));
    stiffest = std::max(stiffest, static_cast<double>(P::largest(books.stiffest)));
    least = std::min(least, -static_cast<double>(P::largest(-books.least)));
  }
};

/// What some cells do.
template <class P>
struct CellsNow {
  HexForces<P> out;
  Corners<P> of_rate;  // the damper's part; only exact
  typename P::V power{}, lost_before{}, lost_after{};
};

/// Forces and energy of some cells; with a memory that moves on. @param w  displacements of the corners; @param v  velocities
template <class P, template <class> class Law, bool physical, bool damped, bool with_energy, bool exact,
          class Real, class Here, class Moved>
inline __attribute__((always_inline)) void cell_forces(const HexContext<Real>& m, const CellFields<Real>& run,
                                                       const Moved& w, const Moved& v, Here& here,
                                                       CellsNow<P>& now) {
  const Damping<P, Real, Moved> damper{.beta = run.beta, .v = &v, .weight = run.damper_weight};
  if constexpr (std::is_same_v<Here, NothingRemembered> && !damped) {
    Lasting lasting;
    hex_centre_forces<P, Law, physical, with_energy>(run.k, w, now.out, lasting);
  } else if constexpr (std::is_same_v<Here, NothingRemembered>) {
    auto damping = damper;
    hex_centre_forces<P, Law, physical, with_energy>(run.k, w, now.out, damping);
    now.power = damping.power;
    if constexpr (exact) damping.forces(run.k, now.of_rate);
  } else if constexpr (damped) {
    RelaxingAndDamped<P, Real, Moved> both{{{m.terms, m.n_terms}, here.terms}, damper};
    hex_centre_forces<P, Law, physical, with_energy>(run.k, w, now.out, both);
    now.lost_before = both.relaxing.lost_before, now.lost_after = both.relaxing.lost_after;
    now.power = both.damping.power;
    if constexpr (exact) both.damping.forces(run.k, now.of_rate);
  } else {
    Relaxing<P, Real> memory{{m.terms, m.n_terms}, here.terms};
    hex_centre_forces<P, Law, physical, with_energy>(run.k, w, now.out, memory);
    now.lost_before = memory.lost_before, now.lost_after = memory.lost_after;
  }
}

template <class V>
struct Held {
  V stiffness, energy;
};

/// Adds what corners do that are about to fold: few cells have one.
template <class P, bool torn, class Real, class V = typename P::V>
__attribute__((noinline)) Held<V> hold_corners(const HexContext<Real>& m, const HexRun& run, Index i) {
  const CellFields<Real> fields(m);
  const ToCorners at{run.right, m.up_y, m.up_z};
  const V stiffness = P::load(m.stiffness + i);
  const CornersAt<P, torn> w{{fields.u[0] + i, fields.u[1] + i, fields.u[2] + i}, at, stiffness};
  CornerForces<P> corner;
  corner_forces<P>(m.k, {w[0], w[1], w[2]}, corner);
  add_to_corners<P>(fields.low, fields.high, at, i, stiffness, corner.f);
  return {corner.stiffness, corner.energy};
}

/// Forces of as many cells of a run as a pack has lanes, from i on. @tparam torn  some have lost stiffness
template <class P, template <class> class Law, bool physical, bool damped, bool relaxing, bool exact,
          bool watched, bool torn, class Real>
inline __attribute__((always_inline)) void pack_forces(const HexContext<Real>& m, const HexRun& run,
                                                       const CellFields<Real>& here, std::ptrdiff_t i,
                                                       RunBooks<P>& books) {
  using V = typename P::V;
  const ToCorners at{run.right, here.up_y, here.up_z};
  const V stiffness = P::load(here.stiffness + i);
  [[maybe_unused]] V whole = P::all(1);
  if constexpr (torn) whole = whole - P::load(m.damage + i);
  const CornersAt<P, torn> w{{here.u[0] + i, here.u[1] + i, here.u[2] + i}, at, stiffness};
  const auto& of_damper = damped ? here.v : here.u;  // where nothing is damped there may be no velocities
  const CornersAt<P, torn> v{{of_damper[0] + i, of_damper[1] + i, of_damper[2] + i}, at, stiffness};
  std::conditional_t<relaxing, RememberedHere<P>, NothingRemembered> memory;
  if constexpr (relaxing) memory.load(m, i);
  CellsNow<P> now;
  cell_forces<P, Law, physical, damped, watched, exact>(m, here, w, v, memory, now);
  if constexpr (damped) books.power = P::fma(stiffness, now.power, books.power);
  if constexpr (relaxing) {
    memory.store(m, i, stiffness);
    books.lost_before = P::fma(stiffness, now.lost_before, books.lost_before);
    books.lost_after = P::fma(stiffness, now.lost_after, books.lost_after);
  }
  add_to_corners<P>(here.low, here.high, at, i, stiffness, now.out.f);
  if constexpr (exact)
    add_to_corners<P, Real>({m.rate_low[0], m.rate_low[1], m.rate_low[2]},
                            {m.rate_high[0], m.rate_high[1], m.rate_high[2]}, at, i, stiffness, now.of_rate);
  // Lanes without a cell see the corners of others: what strain that makes is nobody's.
  if (__builtin_expect(P::any_above_zero(stiffness > V{} ? now.out.fold : V{}), false)) {
    const Held<V> held = hold_corners<P, torn>(m, run, static_cast<Index>(i));
    now.out.stiffness += held.stiffness;
    if constexpr (watched) now.out.energy += held.energy;
  }
  if constexpr (torn) now.out.stiffness = whole * now.out.stiffness;
  books.stiffest = P::larger(books.stiffest, stiffness > V{} ? now.out.stiffness : V{});
  if constexpr (watched) {
    books.elastic = P::fma(stiffness, now.out.energy, books.elastic);
    const V change = least_corner_change<P>(here.k, w);
    V counted = stiffness;
    if constexpr (torn)
      counted = whole < P::all(1) ? V{} : stiffness;  // what tears may fold: its corners part
    books.least = counted > V{} && change < books.least ? change : books.least;
  }
}

/// Forces of the cells of a run. Whole packs only: cells beyond the run's end have no stiffness.
template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing, bool exact,
          bool watched, bool torn>
inline __attribute__((always_inline)) void run_forces(const HexContext<Real>& m, const CellFields<Real>& here,
                                                      std::size_t r) {
  using P = Pack<Real>;
  using Tail = Pack<Real, tail_bytes>;
  constexpr bool has_tail = Tail::width < P::width;
  const HexRun run = m.runs[r];
  RunBooks<P> books;
  std::ptrdiff_t i = run.first;
  const std::ptrdiff_t end = i + run.count;
  for (; end - i > (has_tail ? Tail::width : 0); i += P::width)
    pack_forces<P, Law, physical, damped, relaxing, exact, watched, torn>(m, run, here, i, books);
  RunSums all;
  all.add(books);
  if constexpr (has_tail)
    if (i < end) {
      RunBooks<Tail> rest;
      pack_forces<Tail, Law, physical, damped, relaxing, exact, watched, torn>(m, run, here, i, rest);
      all.add(rest);
    }
  m.stiffest[r] = all.stiffest;
  if constexpr (watched) {
    m.elastic[r] = all.elastic;
    m.least_J[r] = 1 + all.least;
  }
  if constexpr (relaxing) {
    m.lost_before[r] = all.lost_before;
    m.lost_after[r] = all.lost_after;
  }
  if constexpr (damped) {
    m.damped[r] = m.books ? damper_loss(m.dt_before, m.power[r], all.power) : 0;
    m.power[r] = all.power;
  }
}

/// The same of a run with cells that have lost stiffness: few have one.
template <class Real, template <class> class Law, bool physical, bool damped, bool exact, bool watched>
__attribute__((noinline)) void torn_forces(const HexContext<Real>& m, std::size_t r) {
  run_forces<Real, Law, physical, damped, false, exact, watched, true>(m, CellFields<Real>(m), r);
}

template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing, bool exact,
          bool watched>
void forces_of_runs(const HexContext<Real>& m, Index first_run, Index last_run) {
  const CellFields<Real> here(m);
  for (auto r = static_cast<std::size_t>(first_run); r < static_cast<std::size_t>(last_run); ++r) {
    if (m.acts != nullptr && m.acts[r] == 0) continue;
    // Only bodies of this law tear, and such that do not relax.
    if constexpr (!relaxing && std::is_same_v<Law<Pack<Real>>, StableNeoHookean<Pack<Real>>>)
      if (__builtin_expect(m.torn != nullptr && m.torn[r] != 0, false)) {
        torn_forces<Real, Law, physical, damped, exact, watched>(m, r);
        continue;
      }
    run_forces<Real, Law, physical, damped, relaxing, exact, watched, false>(m, here, r);
  }
}

template <class Real, template <class> class Law, bool physical, bool damped, bool relaxing,
          bool exact = false>
void forces(const HexContext<Real>& m, Index first_run, Index last_run) {
  m.masses.watch
      ? forces_of_runs<Real, Law, physical, damped, relaxing, exact, true>(m, first_run, last_run)
      : forces_of_runs<Real, Law, physical, damped, relaxing, exact, false>(m, first_run, last_run);
}

}  // namespace
}  // namespace palpate::physics::PALPATE_KERNEL
