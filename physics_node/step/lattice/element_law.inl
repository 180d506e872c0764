// The force of one kind of element on a pack of masses. Part of element_kernel.inl.
//
// Per element from mass i to mass j, with D the rest vector, L its length, d = u_j - u_i, x = D + d:
//
//   q   = d . (2 D + d)                   = l^2 - L^2, without the cancellation of l - L
//   l   = sqrt(L^2 + q),   l - L = q / (l + L)
//   elastic:  f_s / l = k1 (l - L) / l    = k1 q / (l^2 + L l)
//   damper:   c l' / l = c (dv . x) / l^2
//
// so a stretch of one part in a million is as exact in single precision as the displacements are.

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// Where the masses' numbers stand: in registers, which stores into one of them cannot change.
template <class Real>
struct Streams {
  Real *u[3], *v[3], *f[3];
  const Real *moved[3], *seen[3];  // as in ElementContext
};

/// The pack's elements in one direction, at their present length.
template <class Real>
struct Elements {
  using V = typename Pack<Real>::V;
  V x[3];  // vector to the other ends [m]
  V q, l2, l;
};

/// The constants of the elements: the body's, or their own where several materials meet.
template <class Real, bool varied>
typename Pack<Real>::V constant(const Real* of_each, Real of_all, Index owner) {
  if constexpr (varied) return Pack<Real>::load(of_each + owner);
  return Pack<Real>::all(of_all);
}

/// By how much an element has become longer in the step that led here, dt l', and what its damper did in it after its last kick.
struct LastStep {
  double longer = 0;  // [m]
  double damper = 0;  // [J]
};
template <class Real>
__attribute__((noinline)) LastStep last_step(const ElementContext<Real>& m, const ElementSlot<Real>& e,
                                             Index i, Real stretch, Real c) {
  Real seen = 0, moved = 0;
  for (int a = 0; a < 3; ++a) {
    const Real x = e.D[a] + m.u[a][i + e.offset] - m.u[a][i];
    moved += x * (m.moved[a][i + e.offset] - m.moved[a][i]);
    if (m.exact_axial) seen += x * (m.v_seen[a][i + e.offset] - m.v_seen[a][i]);
  }
  const double l = static_cast<double>(e.L + stretch), longer = static_cast<double>(m.dt_before * moved) / l;
  return {longer, 0.5 * static_cast<double>(c * seen) / l * longer};
}

/// Stage 2 and 3 of the law, lane by lane, for the few elements that are there: commits l_c and the yield stretch from the
/// static force, books what is lost, and takes broken elements out of the mask. (EQUATIONS C-2 to C-6)
///
///   stretch s = l - L,  s_y = yield + hardening,  f_s = k1 (s_y - l_c) + k2 (s - s_y)
///   lost in yielding: (f_y + f_s) / 2 (1 - k2 / k1) (s - s_y);   then  s_y := s,  l_c := s - f_s / k1
///   s > snap: gone, with its elastic energy f_s^2 / (2 k1)
/// @return the lanes that are gone, lane n as bit n
template <class Real, bool varied>
__attribute__((noinline)) unsigned commit_yield(const ElementContext<Real>& m, const ElementSlot<Real>& e,
                                                Index i, typename Pack<Real>::I beyond,
                                                typename Pack<Real>::V stretch, RowLedger& ledger) {
  const auto pick = [&](const Real* of_each, Real of_all, Index owner) {
    return varied ? of_each[owner] : of_all;
  };
  unsigned gone = 0;
  for (int lane = 0; lane < Pack<Real>::width; ++lane) {
    if (beyond[lane] == 0) continue;
    const Index owner = i + e.memory + lane;
    const Real k1 = pick(m.k1[e.half], e.k1, owner);
    const Real k2 = pick(m.k2[e.half], e.k2, owner);
    const Real s_y = pick(m.yield[e.half], e.yield, owner) + m.hardening[e.half][owner];
    const Real f_y = k1 * (s_y - m.l_c[e.half][owner]);
    const Real f_s = f_y + k2 * (stretch[lane] - s_y);
    ledger.plastic += 0.5 * static_cast<double>(f_y + f_s) * (1 - static_cast<double>(k2 / k1)) *
                      static_cast<double>(stretch[lane] - s_y);
    m.hardening[e.half][owner] += stretch[lane] - s_y;
    ++ledger.yields;
    m.l_c[e.half][owner] = stretch[lane] - f_s / k1;
    if (!(stretch[lane] > pick(m.snap[e.half], e.snap, owner))) continue;
    ledger.broken += static_cast<double>(f_s) * static_cast<double>(f_s) / (2 * static_cast<double>(k1));
    ++ledger.breaks;
    m.mask[i + lane] &= ~e.bit;
    gone |= 1U << lane;
  }
  return gone;
}

/// The same where something may be struck. With s_0 = s - dt l' the stretch one step ago, the trapezoid of the forces then and
/// now took less than the path over the corner at s_y, by (k1 - k2) (s_y - s_0) (s - s_y) / 2.
template <class Real, bool varied>
__attribute__((noinline)) unsigned commit_exactly(const ElementContext<Real>& m, const ElementSlot<Real>& e,
                                                  Index i, typename Pack<Real>::I beyond,
                                                  typename Pack<Real>::V stretch, RowLedger& ledger) {
  for (int lane = 0; lane < Pack<Real>::width; ++lane) {
    if (beyond[lane] == 0) continue;
    const Index owner = i + e.memory + lane;
    const Real bend = varied ? m.k1[e.half][owner] - m.k2[e.half][owner] : e.k1 - e.k2;
    const Real over =
        stretch[lane] - (varied ? m.yield[e.half][owner] : e.yield) - m.hardening[e.half][owner];
    const double before =
        last_step<Real>(m, e, i + lane, stretch[lane], Real(0)).longer - static_cast<double>(over);
    if (before > 0) ledger.numerical -= 0.5 * static_cast<double>(bend * over) * before;
  }
  return commit_yield<Real, varied>(m, e, i, beyond, stretch, ledger);
}

/// Elements that have just broken do not pull any more, which leaves f_s (s - s_0) / 2, nor have their dampers their last half
/// step. @param gone  their lanes, lane n as bit n
template <class Real, bool varied>
__attribute__((noinline)) void book_breaks(const ElementContext<Real>& m, const ElementSlot<Real>& e, Index i,
                                           unsigned gone, RowLedger& ledger) {
  for (int lane = 0; lane < Pack<Real>::width; ++lane) {
    if ((gone >> lane & 1U) == 0) continue;
    const Index owner = i + e.memory + lane;
    Real q = 0;
    for (int a = 0; a < 3; ++a) {
      const Real d = m.u[a][i + lane + e.offset] - m.u[a][i + lane];
      q += d * (e.D[a] + e.D[a] + d);
    }
    const Real stretch = q / (static_cast<Real>(__builtin_sqrt(static_cast<double>(q + e.L2))) + e.L);
    const Real f_s = (varied ? m.k1[e.half][owner] : e.k1) * (stretch - m.l_c[e.half][owner]);
    const LastStep last = last_step<Real>(m, e, i + lane, stretch, varied ? m.c[e.half][owner] : e.c);
    ledger.numerical -= 0.5 * static_cast<double>(f_s) * last.longer - last.damper;
  }
}

/// l l' of the pack's elements with other velocities than now.
template <class Real>
inline __attribute__((always_inline)) typename Pack<Real>::V rate_with(const Real* const v[3], Index i,
                                                                       Index j, const Elements<Real>& at) {
  using P = Pack<Real>;
  typename P::V rate{};
  for (int a = 0; a < 3; ++a) rate = P::fma(P::load(v[a] + j) - P::load(v[a] + i), at.x[a], rate);
  return rate;
}

/// Static force over length, f_s / l, of elements that may yield; commits what yields. `live` loses what breaks.
template <class Real, bool varied>
inline __attribute__((always_inline)) typename Pack<Real>::V yielding_force(
    const ElementContext<Real>& m, const ElementSlot<Real>& e, Masses<Real>& p, const Elements<Real>& at,
    typename Pack<Real>::I& live, RowLedger& ledger) {
  using P = Pack<Real>;
  using V = typename P::V;
  const Index owner = p.i + e.memory;
  const V k1 = constant<Real, varied>(m.k1[e.half], e.k1, owner);
  const V l_c = P::load(m.l_c[e.half] + owner);
  const V s_y =
      constant<Real, varied>(m.yield[e.half], e.yield, owner) + P::load(m.hardening[e.half] + owner);
  const V stretch = at.q / (at.l + e.L);
  const typename P::I beyond = (stretch > s_y) & live;
  V force = k1 * (stretch - l_c);
  if (__builtin_expect(P::any(beyond), 0)) {
    const V k2 = constant<Real, varied>(m.k2[e.half], e.k2, owner);
    const V plastic = P::fma(k2, stretch - s_y, k1 * (s_y - l_c));
    force = beyond != 0 ? plastic : force;
    const unsigned gone = m.exact ? commit_exactly<Real, varied>(m, e, p.i, beyond, stretch, ledger)
                                  : commit_yield<Real, varied>(m, e, p.i, beyond, stretch, ledger);
    p.mask = P::load_masks(m.mask + p.i);
    live = P::lanes_with(p.mask, e.bit);
    if (__builtin_expect(gone != 0, 0)) book_breaks<Real, varied>(m, e, p.i, gone, ledger);
  }
  return force / at.l;
}

/// Energy f_s^2 / (2 k1) of the pack's elements, for the ledger.
template <class Real, bool varied>
inline __attribute__((always_inline)) void watch_elastic(const ElementContext<Real>& m,
                                                         const ElementSlot<Real>& e, Masses<Real>& p,
                                                         const Elements<Real>& at,
                                                         typename Pack<Real>::I live,
                                                         typename Pack<Real>::V static_over_l) {
  using P = Pack<Real>;
  if (!m.watch) return;
  const auto f2 = static_over_l * static_over_l * at.l2;
  if constexpr (varied) {
    p.elastic += P::where(live, f2 / (P::all(Real(2)) * P::load(m.k1[e.half] + p.i + e.memory)));
  } else {
    p.elastic = P::fma_all(P::where(live, f2), e.half_over_k1, p.elastic);
  }
}

/// Power of the dampers over the step that led here: c (w + w_before) / 2 times the rate at which it moved, w = l'.
template <class Real, bool verlet>
inline __attribute__((always_inline)) typename Pack<Real>::V passed_power(const Streams<Real>& at_mass,
                                                                          Index i, Index j,
                                                                          const Elements<Real>& at,
                                                                          typename Pack<Real>::V c,
                                                                          typename Pack<Real>::V rate) {
  const auto seen = rate_with<Real>(at_mass.seen, i, j, at);
  const auto moved = verlet ? rate_with<Real>(at_mass.moved, i, j, at) : rate;
  return Real(0.5) * c * (rate + seen) * moved / at.l2;
}

/// Adds the forces of one kind of element at both of its ends.
template <class Real, DamperKind damper, bool yields, bool varied, bool verlet, bool exact>
inline __attribute__((always_inline)) void add_elements(const ElementContext<Real>& m,
                                                        const Streams<Real>& at_mass,
                                                        const ElementSlot<Real>& e, Masses<Real>& p,
                                                        RowLedger& ledger) {
  using P = Pack<Real>;
  using V = typename P::V;
  const Index j = p.i + e.offset;
  const Index owner = p.i + e.memory;
  typename P::I live = P::lanes_with(p.mask, e.bit);
  Elements<Real> at;
  const V d[3] = {P::load(at_mass.u[0] + j) - p.u[0], P::load(at_mass.u[1] + j) - p.u[1],
                  P::load(at_mass.u[2] + j) - p.u[2]};
  for (int a = 0; a < 3; ++a) at.x[a] = d[a] + e.D[a];
  at.q = P::fma(d[2], at.x[2] + e.D[2], P::fma(d[1], at.x[1] + e.D[1], d[0] * (at.x[0] + e.D[0])));
  // A collapsed element has no direction: l is never taken below L / 1000.
  at.q = P::larger(at.q, P::all(e.least_q));
  at.l2 = at.q + e.L2;
  at.l = P::square_root(at.l2);

  V s;          // force over length
  V w[3] = {};  // velocity of the far end, relative
  if constexpr (damper != DamperKind::none)
    for (int a = 0; a < 3; ++a) w[a] = P::load(at_mass.v[a] + j) - p.v[a];
  const V c = constant<Real, varied>(m.c[e.half], e.c, owner);
  if constexpr (damper == DamperKind::axial) {
    const V rate = P::fma(w[2], at.x[2], P::fma(w[1], at.x[1], w[0] * at.x[0]));  // l l'
    if constexpr (yields) {
      s = yielding_force<Real, varied>(m, e, p, at, live, ledger);
      watch_elastic<Real, varied>(m, e, p, at, live, s);
      const V viscous = c * rate / at.l2;
      s += viscous;
      p.viscous += P::where(live, viscous * rate);
      if constexpr (exact)
        p.passed += P::where(live, passed_power<Real, verlet>(at_mass, p.i, j, at, c, rate));
    } else {
      const V k1 = constant<Real, varied>(m.k1[e.half], e.k1, owner);
      const V h = P::fma_all(at.l, e.L, at.l2);
      const V over = P::all(Real(1)) / (h * at.l2);
      const V viscous = c * rate * h;
      s = P::fma(k1 * at.q, at.l2, viscous) * over;
      watch_elastic<Real, varied>(m, e, p, at, live, k1 * at.q * at.l2 * over);
      p.viscous = P::fma(P::where(live, viscous * over), rate, p.viscous);
      if constexpr (exact)
        p.passed += P::where(live, passed_power<Real, verlet>(at_mass, p.i, j, at, c, rate));
    }
  } else {
    if constexpr (yields) {
      s = yielding_force<Real, varied>(m, e, p, at, live, ledger);
    } else {
      s = constant<Real, varied>(m.k1[e.half], e.k1, owner) * at.q / P::fma_all(at.l, e.L, at.l2);
    }
    watch_elastic<Real, varied>(m, e, p, at, live, s);
  }
  s = P::where(live, s);
  for (int a = 0; a < 3; ++a) {
    V mine = s * at.x[a];
    V theirs = -mine;
    if constexpr (damper == DamperKind::other) {
      // Deviation of the papers, offered as printed: the second is drag (EQUATIONS C-31).
      const V c_live = P::where(live, c);
      const V far = m.relative ? -(c_live * w[a]) : -(c_live * P::load(at_mass.v[a] + j));
      const V near = m.relative ? c_live * w[a] : -(c_live * p.v[a]);
      mine += near;
      theirs += far;
      p.viscous += -(near * p.v[a]) - far * P::load(at_mass.v[a] + j);
      if constexpr (exact) {
        const V far_seen = P::load(at_mass.seen[a] + j), near_seen = P::load(at_mass.seen[a] + p.i);
        const V far_before = m.relative ? c_live * (near_seen - far_seen) : -(c_live * far_seen);
        const V near_before = m.relative ? -far_before : -(c_live * near_seen);
        p.passed -= Real(0.5) * ((near + near_before) * P::load(at_mass.moved[a] + p.i) +
                                 (far + far_before) * P::load(at_mass.moved[a] + j));
      }
    }
    p.f[a] += mine;
    P::store(at_mass.f[a] + j, P::load(at_mass.f[a] + j) + theirs);
  }
}

}  // namespace
}  // namespace palpate::physics::PALPATE_KERNEL
