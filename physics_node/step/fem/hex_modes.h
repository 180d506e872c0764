#pragma once
// How the eight corners of a hexahedron move: see hex_element.h, whose constants and modes these are.

#include <array>
#include <cstddef>

#include "physics_node/material/tensor.h"

namespace palpate::physics {

/// Of a cell of the body's own material; everything grows with its modulus.
template <class Real>
struct HexConstants {
  Real mu = 0, lambda = 0;                     // [Pa]
  Real volume = 0;                             // V [m^3]
  std::array<Real, 3> per_4h{};                // 1 / (4 h_j) [1/m]
  std::array<std::array<Real, 3>, 3> bend{};   // E' V / (48 h_i h_j), off the diagonal times nu [N/m]
  std::array<std::array<Real, 3>, 3> twist{};  // mu V / (48 h_i h_j) [N/m]
  Real every = 0;                              // k_i [N/m]
};

/// Which corner is which: bit 0 is +x, bit 1 +y, bit 2 +z.
template <class P>
using Corners = std::array<std::array<typename P::V, 8>, 3>;  // by component

/// m_S of one component; `whole` is that of a translation.
template <class T>
struct Modes {
  T whole, x, y, z, xy, xz, yz, xyz;
};

template <class T>
inline __attribute__((always_inline)) Modes<T> modes_of(const std::array<T, 8>& c) noexcept {
  const T s0 = c[0] + c[1], s1 = c[2] + c[3], s2 = c[4] + c[5], s3 = c[6] + c[7];
  const T d0 = c[1] - c[0], d1 = c[3] - c[2], d2 = c[5] - c[4], d3 = c[7] - c[6];
  const T ss0 = s0 + s1, ss1 = s2 + s3, sd0 = s1 - s0, sd1 = s3 - s2;
  const T ds0 = d0 + d1, ds1 = d2 + d3, dd0 = d1 - d0, dd1 = d3 - d2;
  return {.whole = ss0 + ss1,
          .x = ds0 + ds1,
          .y = sd0 + sd1,
          .z = ss1 - ss0,
          .xy = dd0 + dd1,
          .xz = ds1 - ds0,
          .yz = sd1 - sd0,
          .xyz = dd1 - dd0};
}

/// The transpose, without a translation: sum over S of s_S(a) m_S.
template <class T>
inline __attribute__((always_inline)) std::array<T, 8> corners_of(const Modes<T>& m) noexcept {
  // Corner (x, y, z) gets s_x A + B, A = m_x + s_y m_xy + s_z (m_xz + s_y m_xyz), B = s_y (m_y + s_z m_yz) + s_z m_z.
  const T x0 = m.x - m.xz, x1 = m.x + m.xz, xy0 = m.xy - m.xyz, xy1 = m.xy + m.xyz;  // at -z, +z
  const T y0 = m.y - m.yz, y1 = m.y + m.yz;
  const T low0 = -m.z - y0, low1 = y0 - m.z, high0 = m.z - y1, high1 = m.z + y1;
  const T a0 = x0 - xy0, a1 = x0 + xy0, a2 = x1 - xy1, a3 = x1 + xy1;
  return {low0 - a0, low0 + a0, low1 - a1, low1 + a1, high0 - a2, high0 + a2, high1 - a3, high1 + a3};
}

/// Of what each mode is pulled by, the forces on the corners: the same with the other sign.
template <class T>
inline __attribute__((always_inline)) std::array<T, 8> against(const Modes<T>& m) noexcept {
  const T x0 = m.x - m.xz, x1 = m.x + m.xz, xy0 = m.xy - m.xyz, xy1 = m.xy + m.xyz;  // at -z, +z
  const T y0 = m.y - m.yz, y1 = m.y + m.yz;
  const T low0 = m.z + y0, low1 = m.z - y0, high0 = y1 - m.z, high1 = m.z + y1;
  const T a0 = x0 - xy0, a1 = x0 + xy0, a2 = x1 - xy1, a3 = x1 + xy1;
  return {low0 + a0, low0 - a0, low1 + a1, low1 - a1, high0 + a2, high0 - a2, a3 - high1, -(high1 + a3)};
}

/// The four hourglass modes, by component.
template <class T>
struct Hourglass {
  std::array<T, 3> xy, xz, yz, xyz;
};

template <class P, class T = typename P::V>
inline __attribute__((always_inline)) std::array<T, 3> transposed_times(const Tensor<T>& f,
                                                                        const std::array<T, 3>& m) noexcept {
  std::array<T, 3> t;
  for (std::size_t j = 0; j < 3; ++j) t[j] = P::fma(f[2][j], m[2], P::fma(f[1][j], m[1], f[0][j] * m[0]));
  return t;
}

/// G of t: bending pairs share the direction in which they are linear, twists the axis about which they turn.
template <class P, class Real, class T = typename P::V>
inline __attribute__((always_inline)) Hourglass<T> hourglass_forces(const HexConstants<Real>& k,
                                                                    const Hourglass<T>& t) noexcept {
  const auto all = [](Real r) { return P::all(r); };
  const auto pair = [&](std::size_t i, std::size_t j, T own, T other) {
    return P::fma(all(k.bend[i][i]), own, all(k.bend[i][j]) * other);
  };
  constexpr std::size_t x = 0, y = 1, z = 2;
  Hourglass<T> g;
  g.xy[x] = pair(x, z, t.xy[x], t.yz[z]), g.yz[z] = pair(z, x, t.yz[z], t.xy[x]);  // linear in y
  g.xy[y] = pair(y, z, t.xy[y], t.xz[z]), g.xz[z] = pair(z, y, t.xz[z], t.xy[y]);  // linear in x
  g.xz[x] = pair(x, y, t.xz[x], t.yz[y]), g.yz[y] = pair(y, x, t.yz[y], t.xz[x]);  // linear in z
  // Shears g_xz = t_xy,z / h_x + t_yz,x / h_z and so on, each linear along the third axis.
  const auto twist = [&](std::size_t i, std::size_t j, T own, std::size_t l, T of_i, T of_j) {
    return P::fma(all(k.twist[i][i] + k.twist[j][j]), own,
                  P::fma(all(k.twist[i][l]), of_i, all(k.twist[j][l]) * of_j));
  };
  const T a = t.xy[z], b = t.xz[y], c = t.yz[x];
  g.xy[z] = twist(x, y, a, z, c, b);
  g.xz[y] = twist(x, z, b, y, c, a);
  g.yz[x] = twist(y, z, c, x, b, a);
  for (std::size_t j = 0; j < 3; ++j) g.xyz[j] = all(k.bend[j][j] * (Real(1) / Real(3))) * t.xyz[j];
  return g;
}

/// Forces on the corners, of a stress and hourglass forces: see hex_element.h. @param bends  off: g is not there
template <class P, bool bends, class Real, class T = typename P::V>
inline __attribute__((always_inline)) void spread(const HexConstants<Real>& k, T every, const Tensor<T>& f,
                                                  const Hourglass<T>& mode, const Tensor<T>& stress,
                                                  const Hourglass<T>& g, Corners<P>& out) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<T, 3> of_strain;
    for (std::size_t j = 0; j < 3; ++j) {
      T sum = P::all(k.volume) * stress[i][j];
      if constexpr (bends)
        sum = P::fma(
            mode.xy[i], g.xy[j],
            P::fma(mode.xz[i], g.xz[j], P::fma(mode.yz[i], g.yz[j], P::fma(mode.xyz[i], g.xyz[j], sum))));
      of_strain[j] = sum * P::all(k.per_4h[j]);
    }
    const auto of = [&](const std::array<T, 3>& g_m, T m_i) {
      T sum = every * m_i;
      if constexpr (bends)
        for (std::size_t j = 0; j < 3; ++j) sum = P::fma(f[i][j], g_m[j], sum);
      return sum;
    };
    Modes<T> pull;
    pull.x = of_strain[0], pull.y = of_strain[1], pull.z = of_strain[2];
    pull.xy = of(g.xy, mode.xy[i]), pull.xz = of(g.xz, mode.xz[i]);
    pull.yz = of(g.yz, mode.yz[i]), pull.xyz = of(g.xyz, mode.xyz[i]);
    out[i] = against(pull);
  }
}

}  // namespace palpate::physics
