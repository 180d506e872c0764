#pragma once
// What keeps the corners of a hexahedron from folding, which its centre does not see.
//
//   J_a     = det F_a of corner a, from the three edges that meet there;  J of the centre
//   d_a     = max(0, share J - J_a)
//   W       = mu V / 3 sum d_a^3,      f = - mu V sum d_a^2 (share dJ - dJ_a)
//
// So nothing is added until a corner has less than `share` of the volume that the centre has, as no cell of a bent beam does; then
// force and stiffness begin at zero. J does not see a rotation, nor a translation: W keeps both momenta. Uniform strain
// has J_a = J, and W = 0 unless the cell is inside out.
// Why: under a sphere of 1.2 edges the hourglass terms let corners fold while centres stay sound. A stiffer k_i cures that, too, but
// stiffens every cell that bends, and the force of the sphere.

#include <algorithm>

#include "physics_node/step/fem/hex_modes.h"

namespace palpate::physics {

// Why: with 0.3 a corner under a sphere of 1.2 edges keeps 0.1 of its volume, with this 0.17; with 0.5 the force is 0.4 % larger.
inline constexpr double corner_share = 0.4;

/// Least J - 1 of the eight corners, each from the three edges that meet there: below -1 a corner is folded, which the centre need
/// not show. An edge is one of four along its axis, and has two corners.
/// @param w  displacements of the corners, as Corners<P> or what gives one component after the other as these do [m]
template <class P, class Real, class Moved, class T = typename P::V>
inline __attribute__((always_inline)) T least_corner_change(const HexConstants<Real>& k,
                                                            const Moved& w) noexcept {
  std::array<Tensor<T>, 4> edge;  // the n-th along each axis: what it changes by, over its length
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<T, 8> c = w[i];
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t n = 0; n < 4; ++n) {
        const std::size_t below = n & ((1U << j) - 1), from = (n - below) * 2 + below;
        edge[n][i][j] = (c[from | std::size_t{1} << j] - c[from]) * P::all(4 * k.per_4h[j]);
      }
  }
  T least = P::all(1);
  for (std::size_t a = 0; a < 8; ++a) {
    const std::size_t n[3] = {a >> 1, (a >> 2) * 2 + (a & 1), a & 3};
    Tensor<T> h;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) h[i][j] = edge[n[j]][i][j];
    // J - 1 = tr H + tr cof H + det H
    const Tensor<T> cof = cofactor<P>(h);
    const T det = P::fma(h[0][2], cof[0][2], P::fma(h[0][1], cof[0][1], h[0][0] * cof[0][0]));
    const T change = trace(h) + (trace(cof) + det);
    least = change < least ? change : least;
  }
  return least;
}

/// F_a and its cofactor.
template <class P>
struct HexCorner {
  Tensor<typename P::V> f, cof;
  typename P::V J;
};

template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) HexCorner<P> hex_corner(const HexConstants<Real>& k,
                                                              const Corners<P>& w, std::size_t a) noexcept {
  HexCorner<P> at;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t from = a & ~(std::size_t{1} << j), to = a | std::size_t{1} << j;
    for (std::size_t i = 0; i < 3; ++i) at.f[i][j] = (w[i][to] - w[i][from]) * P::all(4 * k.per_4h[j]);
    at.f[j][j] = at.f[j][j] + P::all(1);
  }
  at.cof = cofactor<P>(at.f);
  at.J = P::fma(at.f[0][2], at.cof[0][2], P::fma(at.f[0][1], at.cof[0][1], at.f[0][0] * at.cof[0][0]));
  return at;
}

/// Above zero wherever a corner may have less than its share; cheap, for cells that are far from it.
///
/// F_a = F (I + B), and each corner's part of the hourglass modes is at most |F B|^2 = 9/48 q sum 1/h^2, q = sum |m_M|^2. Then
///   J_a >= J (1 - y)^3,   y = |F B| |cof F| / J,
/// and what y^2 = r^2, (1 - r)^3 = share, is for q is the bound.
/// @param q  sum of |m_M|^2 [m^2]; @param cof2  |cof F|^2
template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) T may_fold(const HexConstants<Real>& k, T q, T cof2, T J) noexcept {
  constexpr double r = 0.263;
  static_assert((1 - r) * (1 - r) * (1 - r) >= corner_share);
  const Real per_h2 =
      16 * (k.per_4h[0] * k.per_4h[0] + k.per_4h[1] * k.per_4h[1] + k.per_4h[2] * k.per_4h[2]);
  const T size = J > P::all(0) ? J : -J;
  return q * cof2 * P::all(Real(9.0 / 48.0) * per_h2) - J * size * P::all(Real(r * r));
}

/// The same of a cell whose gradient of the displacement is h.
template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) T may_fold_at(const HexConstants<Real>& k, T q,
                                                    const Tensor<T>& h) noexcept {
  Tensor<T> cof = cofactor<P>(h);  // of H; then of F
  const T det = P::fma(h[0][2], cof[0][2], P::fma(h[0][1], cof[0][1], h[0][0] * cof[0][0]));
  const T t = trace(h), change = t + (trace(cof) + det);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) cof[i][j] = cof[i][j] - h[j][i];
  for (std::size_t i = 0; i < 3; ++i) cof[i][i] = cof[i][i] + (t + P::all(1));
  return may_fold<P>(k, q, double_dot<P>(cof, cof), P::all(1) + change);
}

/// What corners do that have less than their share.
template <class P>
struct CornerForces {
  Corners<P> f;             // on each corner [N]
  typename P::V energy;     // [J]
  typename P::V stiffness;  // bound of its tangent, as that of a law [Pa]
};

/// @param w  displacements of the corners [m]
///
/// Its tangent 2 mu V sum d g g^T - mu V sum d^2 dg, g = share dJ - dJ_a, is at most that of a law of the modulus
///   16 mu sum d |cof F_a|^2 + 16/sqrt(3) mu sum d^2 |F_a|,   |F| <= (|F|^2 / sqrt(3) + sqrt(3)) / 2
template <class P, class Real, class T = typename P::V>
__attribute__((noinline)) void corner_forces(const HexConstants<Real>& k, const Corners<P>& w,
                                             CornerForces<P>& out) noexcept {
  Tensor<T> h;
  for (std::size_t i = 0; i < 3; ++i) {
    const Modes<T> m = modes_of(w[i]);
    h[i] = {m.x * P::all(k.per_4h[0]), m.y * P::all(k.per_4h[1]), m.z * P::all(k.per_4h[2])};
  }
  const Tensor<T> f = plus_identity<P>(h), cof = cofactor<P>(f);
  const T wanted = P::all(Real(corner_share)) *
                   P::fma(f[0][2], cof[0][2], P::fma(f[0][1], cof[0][1], f[0][0] * cof[0][0]));
  const T mu_v = P::all(k.mu * k.volume), mu = P::all(k.mu);
  constexpr double root3 = 1.7320508075688772;
  const T zero = P::all(0);
  T pressed = zero;  // sum of mu V d^2
  out.energy = out.stiffness = zero;
  for (auto& axis : out.f) axis.fill(zero);
  for (std::size_t a = 0; a < 8; ++a) {
    const HexCorner<P> at = hex_corner<P>(k, w, a);
    const T less = wanted - at.J;
    if (!P::any_above_zero(less)) continue;  // of half of the corners of a cell that is inside out
    const T d = less > zero ? less : zero;
    const T force = mu_v * d * d;
    pressed = pressed + force;
    out.energy = P::fma(force * P::all(Real(1.0 / 3.0)), d, out.energy);
    const T size = P::fma(double_dot<P>(at.f, at.f), P::all(Real(0.5 / root3)), P::all(Real(0.5 * root3)));
    out.stiffness =
        P::fma(mu * d, P::fma(P::all(16), double_dot<P>(at.cof, at.cof), P::all(Real(16 / root3)) * d * size),
               out.stiffness);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t from = a & ~(std::size_t{1} << j), to = a | std::size_t{1} << j;
      for (std::size_t i = 0; i < 3; ++i) {
        const T along = force * at.cof[i][j] * P::all(4 * k.per_4h[j]);
        out.f[i][to] = out.f[i][to] + along;
        out.f[i][from] = out.f[i][from] - along;
      }
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Modes<T> centre{zero, zero, zero, zero, zero, zero, zero, zero};
    const T part = -(P::all(Real(corner_share)) * pressed);
    centre.x = part * cof[i][0] * P::all(k.per_4h[0]);
    centre.y = part * cof[i][1] * P::all(k.per_4h[1]);
    centre.z = part * cof[i][2] * P::all(k.per_4h[2]);
    const std::array<T, 8> back = corners_of(centre);
    for (std::size_t a = 0; a < 8; ++a) out.f[i][a] = out.f[i][a] + back[a];
  }
}

/// A stiffness for all hourglass modes alike, positive, that takes the place of its tangent: 7 mu V b^2 sum d |cof F_a|^2 with b^2 the
/// mean of 1 / (4 h)^2 [N/m]. Why 7: half of the most that any mode can ask for.
/// @param w  displacements of the corners [m]; @param J  of the centre
template <class P, class Real, class T = typename P::V>
__attribute__((noinline)) T corner_stiffness(const HexConstants<Real>& k, const Corners<P>& w, T J) noexcept {
  const T zero = P::all(0);
  T sum = zero;
  for (std::size_t a = 0; a < 8; ++a) {
    const HexCorner<P> at = hex_corner<P>(k, w, a);
    const T less = P::all(Real(corner_share)) * J - at.J;
    sum = P::fma(less > zero ? less : zero, double_dot<P>(at.cof, at.cof), sum);
  }
  Real b2 = 0;
  for (const Real b : k.per_4h) b2 += b * b / 3;
  return P::all(7 * k.mu * k.volume * b2) * sum;
}

}  // namespace palpate::physics
