#pragma once
// How the forces of a hexahedron change with its corners, positive definite: for systems that conjugate gradients solve.
//
//   dP = mu dH + (lambda + mu)(C : dH) C + q~ (F x dH),   C = cof F, F x dH = the change of C,
//   q~ = (lambda + mu)(J - 1) - mu, kept within -mu/s and mu/s,   s = (1 + max row sum of |F^T F|) / 2
//
// s is at least the largest stretch, so that q~ takes from turns and flips no more than mu gives them; at rest q~ = -mu and s = 1,
// and the tangent is linear elasticity's. Of the hourglass modes dt = F^T dm, dG = G(dt), df = F dG + k_i dm: what turns with dH is
// left out. Corners that are about to fold stiffen all hourglass modes: see corner_stiffness(). All of a cell's tangent is then F,
// q~ and k_i.
// Deviation: not the slope of the force far from rest, where that has directions of negative energy; Newton's method then takes
// some steps more, and every one leads downhill.

#include "physics_node/step/fem/hex_element.h"

namespace palpate::physics {

template <class T>
struct HexTangent {
  Tensor<T> f;  // F
  T q;          // q~ [Pa]
  T every;      // k_i, and what corners add that are about to fold [N/m]
};

template <class P, class Real, class T = typename P::V>
HexTangent<T> hex_tangent_at(const HexConstants<Real>& k, const Corners<P>& u) noexcept {
  Tensor<T> h;
  T of_modes = P::all(0);  // sum of |m_M|^2
  for (std::size_t i = 0; i < 3; ++i) {
    const Modes<T> m = modes_of(u[i]);
    of_modes = P::fma(m.xy, m.xy, P::fma(m.xz, m.xz, P::fma(m.yz, m.yz, P::fma(m.xyz, m.xyz, of_modes))));
    h[i] = {m.x * P::all(k.per_4h[0]), m.y * P::all(k.per_4h[1]), m.z * P::all(k.per_4h[2])};
  }
  const Tensor<T> cof = cofactor<P>(h);
  const T det = P::fma(h[0][2], cof[0][2], P::fma(h[0][1], cof[0][1], h[0][0] * cof[0][0]));
  const T change = trace(h) + (trace(cof) + det);  // J - 1
  HexTangent<T> at{plus_identity<P>(h), P::fma(P::all(k.lambda + k.mu), change, P::all(-k.mu)),
                   P::all(k.every)};
  if (P::any_above_zero(may_fold_at<P>(k, of_modes, h)))
    at.every = at.every + corner_stiffness<P>(k, u, P::all(1) + change);
  T most = P::all(0);
  for (std::size_t r = 0; r < 3; ++r) {
    T row = P::all(0);
    for (std::size_t c = 0; c < 3; ++c) {
      T e = at.f[0][r] * at.f[0][c];
      for (std::size_t i = 1; i < 3; ++i) e = P::fma(at.f[i][r], at.f[i][c], e);
      row = row + (e > P::all(0) ? e : -e);
    }
    most = row > most ? row : most;
  }
  const T bound = P::all(2 * k.mu) / (P::all(1) + most);  // mu / s
  at.q = at.q > bound ? bound : at.q;
  at.q = at.q < -bound ? -bound : at.q;
  return at;
}

/// out = K d: what holds the corners back when they move by d [N].
template <class P, bool physical, class Real, class T = typename P::V>
inline __attribute__((always_inline)) void hex_tangent_times(const HexConstants<Real>& k,
                                                             const HexTangent<T>& at, const Corners<P>& d,
                                                             Corners<P>& out) noexcept {
  const std::array<Modes<T>, 3> m{modes_of(d[0]), modes_of(d[1]), modes_of(d[2])};
  Tensor<T> dh;
  for (std::size_t i = 0; i < 3; ++i) {
    dh[i] = {m[i].x * P::all(k.per_4h[0]), m[i].y * P::all(k.per_4h[1]), m[i].z * P::all(k.per_4h[2])};
  }
  const Tensor<T> cof = cofactor<P>(at.f), dcof = cofactor_change<P>(at.f, dh);
  const T volume = P::all(k.volume), mu = volume * P::all(k.mu), q = volume * at.q;
  const T along = volume * P::all(k.lambda + k.mu) * double_dot<P>(cof, dh);
  [[maybe_unused]] Hourglass<T> g;
  if constexpr (physical) {
    const auto turned = [&](T x, T y, T z) { return transposed_times<P>(at.f, std::array<T, 3>{x, y, z}); };
    g = hourglass_forces<P>(
        k, Hourglass<T>{turned(m[0].xy, m[1].xy, m[2].xy), turned(m[0].xz, m[1].xz, m[2].xz),
                        turned(m[0].yz, m[1].yz, m[2].yz), turned(m[0].xyz, m[1].xyz, m[2].xyz)});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<T, 3> s;
    for (std::size_t j = 0; j < 3; ++j)
      s[j] = P::fma(mu, dh[i][j], P::fma(along, cof[i][j], q * dcof[i][j])) * P::all(k.per_4h[j]);
    const auto back = [&](const std::array<T, 3>& g_m, T m_i) {
      T sum = at.every * m_i;
      if constexpr (physical)
        for (std::size_t j = 0; j < 3; ++j) sum = P::fma(at.f[i][j], g_m[j], sum);
      return sum;
    };
    Modes<T> force;
    force.x = s[0], force.y = s[1], force.z = s[2];
    force.xy = back(g.xy, m[i].xy), force.xz = back(g.xz, m[i].xz);
    force.yz = back(g.yz, m[i].yz), force.xyz = back(g.xyz, m[i].xyz);
    out[i] = corners_of(force);
  }
}

/// A symmetric tensor: xx yy zz yz xz xy.
template <class T>
using Symmetric = std::array<T, 6>;

/// The 3 x 3 blocks of K on its diagonal, of corners 0 to 3; corner 7 - a has that of a. Signs come in pairs only, so that
///   D_a = B + s_x s_y B_xy + s_x s_z B_xz + s_y s_z B_yz
/// with B = V mu |b|^2 I + 4 k_i I + sum_j (w_jj c_j c_j^T + g_jj f_j f_j^T), B_jk = w_jk (c_j c_k^T + c_k c_j^T) + g_jk (f_j f_k^T
/// + f_k f_j^T), c and f the columns of C and F, b_j = 1 / (4 h_j), w_jk = V (lambda + mu) b_j b_k; the term of q~ has no part here.
template <class P, bool physical, class Real, class T = typename P::V>
std::array<Symmetric<T>, 4> hex_tangent_blocks(const HexConstants<Real>& k,
                                               const HexTangent<T>& at) noexcept {
  constexpr std::size_t row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  const Tensor<T> cof = cofactor<P>(at.f);
  const auto w = [&](std::size_t i, std::size_t j) {
    return P::all(k.volume * (k.lambda + k.mu) * k.per_4h[i] * k.per_4h[j]);
  };
  Real of_strain = 0;
  for (const Real b : k.per_4h) of_strain += k.volume * k.mu * b * b;
  const T own = P::fma(P::all(4), at.every, P::all(of_strain));
  Symmetric<T> base;
  for (std::size_t e = 0; e < 6; ++e) {
    base[e] = e < 3 ? own : P::all(0);
    for (std::size_t j = 0; j < 3; ++j) {
      base[e] = P::fma(w(j, j) * cof[row[e]][j], cof[column[e]][j], base[e]);
      if constexpr (physical) {
        const Real g = k.bend[j][j] * Real(7.0 / 3.0) + k.twist[(j + 1) % 3][(j + 1) % 3] +
                       k.twist[(j + 2) % 3][(j + 2) % 3];
        base[e] = P::fma(P::all(g) * at.f[row[e]][j], at.f[column[e]][j], base[e]);
      }
    }
  }
  const auto pair = [&](std::size_t i, std::size_t j) {
    Symmetric<T> b;
    for (std::size_t e = 0; e < 6; ++e) {
      const std::size_t r = row[e], c = column[e];
      b[e] = w(i, j) * P::fma(cof[r][i], cof[c][j], cof[r][j] * cof[c][i]);
      if constexpr (physical)
        b[e] = P::fma(P::all(k.bend[i][j] + k.twist[i][j]),
                      P::fma(at.f[r][i], at.f[c][j], at.f[r][j] * at.f[c][i]), b[e]);
    }
    return b;
  };
  const Symmetric<T> xy = pair(0, 1), xz = pair(0, 2), yz = pair(1, 2);
  std::array<Symmetric<T>, 4> blocks;
  for (std::size_t e = 0; e < 6; ++e) {
    blocks[0][e] = base[e] + xy[e] + (xz[e] + yz[e]);
    blocks[1][e] = base[e] - xy[e] + (yz[e] - xz[e]);
    blocks[2][e] = base[e] - xy[e] + (xz[e] - yz[e]);
    blocks[3][e] = base[e] + xy[e] - (xz[e] + yz[e]);
  }
  return blocks;
}

}  // namespace palpate::physics
