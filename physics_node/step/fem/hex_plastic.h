#pragma once
// What of a hexahedron yields: J2 plasticity at large strain, beside stable neo-Hookean tissue.
//
// A cell that has yielded is at rest in another shape of the same volume, of which it knows C_p^-1 = I + D, det C_p = 1, and the
// hourglass modes t_p. It pulls by what is left:
//
//   psi   = mu/2 (tr b_e - 3) - mu (J - 1) + (lambda + mu)/2 (J - 1)^2,   b_e = F C_p^-1 F^T,   so  P += mu F D
//   s     = t - t_p,                                                       G(s) in place of G(t)
//   tau   = mu b_e + q J I,           S^2 = 3/2 |dev b_e|^2 + 3 s . G(s) / (V mu)
//
// mu S is von Mises' stress (Kirchhoff's), its mean square over the cell: a mode that bends a cell counts by its energy, of which
// distortion has mu S^2 / 6 by volume. So thin parts yield by bending, too. C_p lives at rest: a rotation changes nothing.
//
// Where S > Y + K alpha it flows, dev b_e and s by the same share r, and volume stays:
//   b_e := c I + (1 - r) dev b_e,   det b_e = J^2;       s := (1 - r) s;      S := (1 - r) S = Y + K (alpha + d alpha)
//   d alpha = lost / (mu S),   lost = mu/2 d(tr b_e) + d(s . G(s)) / (2 V),   mu S halfway
// so that what is lost is stress times plastic strain, never negative since tr b_e falls with r while det b_e stays. For a bar alpha is
// the plastic part of ln l, and Y, K make its stress begin to yield at the stretch of `Yielding` and go on with its slope.
// Source: Simo 1988 (return along dev b_e), Simo & Hughes 1998, chapter 9; det b_e is kept exactly, which these only do nearly.
// Limit: k_i and what corners do that are about to fold (hex_corners.h) do not yield; nor does a cell below a tenth of its volume.

#include <algorithm>
#include <cmath>

#include "physics_node/body/solid_elements.h"
#include "physics_node/step/fem/hex_element.h"
#include "physics_node/step/fem/hex_tension.h"

namespace palpate::physics {

inline constexpr std::size_t n_plastic = 19;  // six of D, twelve of t_p, alpha
inline constexpr double least_yielding_J = 0.1;

/// D as xx, yy, zz, xy, xz, yz; then t_p of xy, xz, yz, xyz, each x, y, z; then alpha.
template <class T>
using Plastic = std::array<T, n_plastic>;

template <class T>
Tensor<T> plastic_strain(const Plastic<T>& p) noexcept {  // D
  return {{{p[0], p[3], p[4]}, {p[3], p[1], p[5]}, {p[4], p[5], p[2]}}};
}
template <class T>
Hourglass<T> plastic_modes(const Plastic<T>& p) noexcept {  // t_p
  return {{p[6], p[7], p[8]}, {p[9], p[10], p[11]}, {p[12], p[13], p[14]}, {p[15], p[16], p[17]}};
}

/// When and how far a cell flows, in units of its shear modulus.
struct YieldLimit {
  double stress = 0;     // Y; 0: never
  double hardening = 0;  // K
};

/// Of a bar with free sides, of any modulus: K is such that stress over strain has the slope hardening * E.
inline YieldLimit yield_limit(const Yielding& yielding, double mu, double lambda) noexcept {
  if (yielding.ratio == 0) return {};
  const double E = mu * (3 * lambda + 2 * mu) / (lambda + mu);
  return {.stress = 2 * tension_limit(yielding.ratio, mu, lambda).tension,
          .hardening = E / mu * yielding.hardening / (1 - yielding.hardening)};
}

/// The elastic part of the stretch of a bar that is pulled to l: ln l = ln l_e + alpha.
inline double elastic_stretch(double l, const Yielding& yielding, double mu, double lambda) noexcept {
  if (yielding.ratio == 0 || l <= yielding.ratio) return l;
  if (yielding.hardening == 0) return yielding.ratio;
  const YieldLimit limit = yield_limit(yielding, mu, lambda);
  double lo = yielding.ratio, hi = l;
  for (int n = 0; n < 60; ++n) {
    const double l_e = 0.5 * (lo + hi);
    const double alpha = (2 * tension_limit(l_e, mu, lambda).tension - limit.stress) / limit.hardening;
    (std::log(l_e) + alpha < std::log(l) ? lo : hi) = l_e;
  }
  return 0.5 * (lo + hi);
}

/// When a cell breaks that may yield before: where a bar is stretched to b, whose stress then is what it has yielded to.
/// @param b  0: never
inline TensionLimit<double> break_limit(double b, const Yielding& yielding, double mu,
                                        double lambda) noexcept {
  if (b == 0) return {};
  return {.stretch = b * b - 1,
          .tension = tension_limit(elastic_stretch(b, yielding, mu, lambda), mu, lambda).tension};
}

/// As hex_tension.h has it, of a cell that has yielded: stretched by C, in tension by mu b_e + q J I.
/// @param of_volume  (lambda + mu) / mu
inline bool is_pulled_plastic(const Tensor<double>& h, const Plastic<double>& plastic,
                              const TensionLimit<double>& limit, double of_volume) noexcept {
  using One = Scalar<double>;
  if (least_minor<One>(limit.stretch, stretching<One>(h)) > 0) return false;
  const Tensor<double> f = plus_identity<One>(h);
  const Tensor<double> fc = product<One>(f, plus_identity<One>(plastic_strain(plastic)));  // F C_p^-1
  Tensor<double> b;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      b[i][j] = fc[i][0] * f[j][0] + fc[i][1] * f[j][1] + fc[i][2] * f[j][2];
  const Tensor<double> cof = cofactor<One>(f);
  const double J = f[0][0] * cof[0][0] + f[0][1] * cof[0][1] + f[0][2] * cof[0][2];
  return least_minor<One>(limit.tension - (of_volume * (J - 1) - 1) * J, b) <= 0;
}

/// A cell as it is deformed.
template <class P>
struct HexStrained {
  using T = typename P::V;
  Tensor<T> h, f;  // H, F
  Tensor<T> c;     // C - I
  Hourglass<T> mode, t;
};

template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) HexStrained<P> hex_strained(const HexConstants<Real>& k,
                                                                  const Corners<P>& w) noexcept {
  const std::array<Modes<T>, 3> m{modes_of(w[0]), modes_of(w[1]), modes_of(w[2])};
  HexStrained<P> now;
  for (std::size_t i = 0; i < 3; ++i)
    now.h[i] = {m[i].x * P::all(k.per_4h[0]), m[i].y * P::all(k.per_4h[1]), m[i].z * P::all(k.per_4h[2])};
  now.f = plus_identity<P>(now.h);
  now.c = stretching<P>(now.h);
  now.mode = {{m[0].xy, m[1].xy, m[2].xy},
              {m[0].xz, m[1].xz, m[2].xz},
              {m[0].yz, m[1].yz, m[2].yz},
              {m[0].xyz, m[1].xyz, m[2].xyz}};
  now.t = {transposed_times<P>(now.f, now.mode.xy), transposed_times<P>(now.f, now.mode.xz),
           transposed_times<P>(now.f, now.mode.yz), transposed_times<P>(now.f, now.mode.xyz)};
  return now;
}

template <class P, class T = typename P::V>
T hourglass_dot(const Hourglass<T>& a, const Hourglass<T>& b) noexcept {
  T sum = P::all(0);
  for (std::size_t j = 0; j < 3; ++j)
    sum = P::fma(a.xy[j], b.xy[j],
                 P::fma(a.xz[j], b.xz[j], P::fma(a.yz[j], b.yz[j], P::fma(a.xyz[j], b.xyz[j], sum))));
  return sum;
}

/// @param cof  of a
template <class P, class T = typename P::V>
T determinant(const Tensor<T>& a, const Tensor<T>& cof) noexcept {
  return P::fma(a[0][2], cof[0][2], P::fma(a[0][1], cof[0][1], a[0][0] * cof[0][0]));
}

/// How near a cell is to yielding.
template <class P>
struct HexStressed {
  using T = typename P::V;
  Tensor<T> dev;      // of C C_p^-1, whose invariants are those of b_e
  T mean, dev2;       // tr b_e / 3, |dev b_e|^2
  Hourglass<T> s, g;  // s, G(s)
  T bent;             // s . G(s) / (V mu)
  T stress2;          // S^2
};

template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) HexStressed<P> hex_stressed(const HexConstants<Real>& k,
                                                                  const HexStrained<P>& now,
                                                                  const Plastic<T>& plastic) noexcept {
  HexStressed<P> is;
  const Tensor<T> d = plastic_strain(plastic);
  // C C_p^-1 - I: small where strain is, so that float keeps its digits.
  is.dev = product<P>(now.c, d);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) is.dev[i][j] = is.dev[i][j] + (now.c[i][j] + d[i][j]);
  const T third = trace(is.dev) * P::all(Real(1.0 / 3.0));
  for (std::size_t i = 0; i < 3; ++i) is.dev[i][i] = is.dev[i][i] - third;
  is.mean = P::all(1) + third;
  const T off =
      P::fma(is.dev[0][1], is.dev[1][0], P::fma(is.dev[0][2], is.dev[2][0], is.dev[1][2] * is.dev[2][1]));
  is.dev2 = P::fma(is.dev[0][0], is.dev[0][0],
                   P::fma(is.dev[1][1], is.dev[1][1], P::fma(is.dev[2][2], is.dev[2][2], P::all(2) * off)));
  const Hourglass<T> before = plastic_modes(plastic);
  for (std::size_t j = 0; j < 3; ++j) {
    is.s.xy[j] = now.t.xy[j] - before.xy[j], is.s.xz[j] = now.t.xz[j] - before.xz[j];
    is.s.yz[j] = now.t.yz[j] - before.yz[j], is.s.xyz[j] = now.t.xyz[j] - before.xyz[j];
  }
  is.g = hourglass_forces<P>(k, is.s);
  is.bent = hourglass_dot<P>(is.s, is.g) * P::all(1 / (k.volume * k.mu));
  is.stress2 = P::fma(P::all(Real(1.5)), is.dev2, P::all(3) * is.bent);
  return is;
}

/// What a step of flow does.
template <class P>
struct HexFlow {
  using T = typename P::V;
  T share;            // r
  T strain;           // d alpha
  T lost;             // of the energy, as it stands [J]
  Tensor<T> relaxed;  // by which D has changed
};

/// @param stress     S
/// @param limit      Y + K alpha, at least S where it does not flow: then r = 0
/// @param hardening  K
/// @param plastic    moves on
template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) HexFlow<P> hex_flow(const HexConstants<Real>& k,
                                                          const HexStrained<P>& now, const HexStressed<P>& is,
                                                          T stress, T limit, T hardening,
                                                          Plastic<T>& plastic) noexcept {
  const T one = P::all(1), two = P::all(2), half = P::all(Real(0.5));
  const T over = stress > limit ? stress - limit : P::all(0);
  const T safe = stress > limit ? stress : one;
  const T det_dev = determinant<P>(is.dev, cofactor<P>(is.dev));
  // c = m - r x:  x (3 m (m - e) + e^2 - a) = (2 - r) m |dev|^2 / 2 - (3 - 3 r + r^2) det dev,  e = r x, a = (1 - r)^2 |dev|^2 / 2
  T r = over / (safe * P::fma(hardening, P::all(Real(1.0 / 3.0)), one));
  T x = P::all(0), e = P::all(0), slope = one, rate = P::all(0);
  const auto keep_volume = [&] {  // a step of Newton's: from above, so it always converges
    const T kept = one - r, a = half * kept * kept * is.dev2, left = is.mean - e;
    const T wanted = half * (two - r) * is.mean * is.dev2 - (P::all(3) - P::all(3) * r + r * r) * det_dev;
    slope = P::all(3) * left * left - a;
    x = x - (x * (P::all(3) * is.mean * left + e * e - a) - wanted) / slope;
    e = r * x;
    // d alpha / r
    rate = P::fma(P::all(Real(1.5)), x, half * is.bent * (two - r)) / (safe * (one - half * r));
  };
  for (int n = 0; n < 4; ++n) {
    keep_volume();
    r = over / P::fma(hardening, rate, safe);
    e = r * x;
  }
  for (int n = 0; n < 6; ++n)
    keep_volume();  // Why: a cell that is drawn to five times its length in one step takes as many
  HexFlow<P> flow;
  flow.share = r;
  flow.strain = r * rate;
  const T mu_v = P::all(k.mu * k.volume);
  flow.lost = mu_v * P::fma(P::all(Real(1.5)), e, half * is.bent * r * (two - r));
  // det C_p strays by rounding: what it has is taken out with the next flow.
  const Tensor<T> d = plastic_strain(plastic), cof_d = cofactor<P>(d);
  const T strayed = trace(d) + (trace(cof_d) + determinant<P>(d, cof_d));
  const Tensor<T> C = plus_identity<P>(now.c), cof = cofactor<P>(C);
  const T det = determinant<P>(C, cof);
  const T c_more = stress > limit ? r * is.mean - e - det * strayed / slope : P::all(0);
  const T per_det = c_more / (det > P::all(0) ? det : one);
  // C_p^-1 := (1 - r) C_p^-1 + (c - (1 - r) m) C^-1
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      flow.relaxed[i][j] = P::fma(per_det, cof[i][j], -(r * (i == j ? d[i][j] + one : d[i][j])));
  const Tensor<T>& by = flow.relaxed;
  const T more[6] = {by[0][0], by[1][1], by[2][2], by[0][1], by[0][2], by[1][2]};
  for (std::size_t n = 0; n < 6; ++n) plastic[n] = plastic[n] + more[n];
  for (std::size_t j = 0; j < 3; ++j) {
    plastic[6 + j] = P::fma(r, is.s.xy[j], plastic[6 + j]);
    plastic[9 + j] = P::fma(r, is.s.xz[j], plastic[9 + j]);
    plastic[12 + j] = P::fma(r, is.s.yz[j], plastic[12 + j]);
    plastic[15 + j] = P::fma(r, is.s.xyz[j], plastic[15 + j]);
  }
  plastic[18] = plastic[18] + flow.strain;
  return flow;
}

/// The power with which the corners moved against what flow has taken from their forces, V mu (- dD) : F^T F' + r G(s) . t' [W].
/// @param v  of the corners [m/s]
template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) T hex_flow_power(const HexConstants<Real>& k, const HexStrained<P>& now,
                                                       const HexStressed<P>& is, const HexFlow<P>& flow,
                                                       const Corners<P>& v) noexcept {
  const std::array<Modes<T>, 3> m{modes_of(v[0]), modes_of(v[1]), modes_of(v[2])};
  Tensor<T> rate;  // F'
  for (std::size_t i = 0; i < 3; ++i)
    rate[i] = {m[i].x * P::all(k.per_4h[0]), m[i].y * P::all(k.per_4h[1]), m[i].z * P::all(k.per_4h[2])};
  T strained = P::all(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<T, 3> column = transposed_times<P>(now.f, {rate[0][i], rate[1][i], rate[2][i]});
    for (std::size_t j = 0; j < 3; ++j) strained = P::fma(flow.relaxed[j][i], column[j], strained);
  }
  const auto rate_of = [&](const std::array<T, 3>& moves, const std::array<T, 3>& mode) {
    std::array<T, 3> t = transposed_times<P>(now.f, moves);
    const std::array<T, 3> turned = transposed_times<P>(rate, mode);
    for (std::size_t j = 0; j < 3; ++j) t[j] = t[j] + turned[j];
    return t;
  };
  const Hourglass<T> t{rate_of({m[0].xy, m[1].xy, m[2].xy}, now.mode.xy),
                       rate_of({m[0].xz, m[1].xz, m[2].xz}, now.mode.xz),
                       rate_of({m[0].yz, m[1].yz, m[2].yz}, now.mode.yz),
                       rate_of({m[0].xyz, m[1].xyz, m[2].xyz}, now.mode.xyz)};
  return P::fma(flow.share, hourglass_dot<P>(is.g, t), -(P::all(k.mu * k.volume) * strained));
}

/// What its plastic shape does beside the law, of a cell as it is: forces on the corners [N], and energy [J].
template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) T plastic_forces(const HexConstants<Real>& k, const HexStrained<P>& now,
                                                       const Plastic<T>& plastic, Corners<P>& out) noexcept {
  const Tensor<T> d = plastic_strain(plastic);
  Tensor<T> stress = product<P>(now.f, d);
  for (auto& row : stress)
    for (T& one : row) one = P::all(k.mu) * one;
  const Hourglass<T> before = plastic_modes(plastic);
  Hourglass<T> g = hourglass_forces<P>(k, before);
  // G is symmetric: s . G(s) - t . G(t) = G(t_p) . (t_p - 2 t)
  const T bent = P::fma(P::all(Real(0.5)), hourglass_dot<P>(g, before), -hourglass_dot<P>(g, now.t));
  for (auto* mode : {&g.xy, &g.xz, &g.yz, &g.xyz})
    for (T& one : *mode) one = -one;
  spread<P, true>(k, P::all(0), now.f, now.mode, stress, g, out);
  return P::fma(P::all(Real(0.5) * k.mu * k.volume), trace(d) + double_dot<P>(now.c, d), bent);
}

/// |D|^2. To the bound of the law's tangent it adds |D| shear moduli at most.
template <class P, class T = typename P::V>
T plastic_bound2(const Plastic<T>& p) noexcept {
  const T axes = P::fma(p[0], p[0], P::fma(p[1], p[1], p[2] * p[2]));
  return P::fma(P::all(2), P::fma(p[3], p[3], P::fma(p[4], p[4], p[5] * p[5])), axes);
}

}  // namespace palpate::physics
