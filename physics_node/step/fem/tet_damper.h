#pragma once
// What resists the rate of strain at a point of a tetrahedron: Kelvin-Voigt, beta behind the strain.
//
//   P += F S_v,   S_v = beta (lambda tr E' I + 2 mu E'),   E' = (F^T F' + F'^T F) / 2,   F' the gradient of the velocity
//
// It takes the power V S_v : E' >= 0. With nodal pressure lambda resists the rate at which the volume of a node grows, as it does its
// growth: E' in the element would lock, near a Poisson's ratio of 0.5, what the nodes leave free.
//
//   j_n' = sum over t at n of V_t J_t' / sum of V_t,   J_t' = cof F : F',   j_t' = mean of j_n' over the corners of t
//   P   += F 2 mu beta E' + beta lambda j_t' cof F
//
// It takes sum_t V_t 2 mu beta E' : E' + sum_n V_n beta lambda j_n'^2: V_t j_t' J_t' summed over tetrahedra is V_n j_n'^2 summed over nodes.
// Neither E' nor J' sees a turning body, and S_v is symmetric: both momenta stay. Near rest it is beta times the stiffness.

#include <cmath>

#include "physics_node/material/stable_neo_hookean.h"

namespace palpate::physics {

/// By component; of one corner, or of one difference of corners.
template <class T>
using Column = std::array<T, 3>;

/// Of a symmetric M: no eigenvalue of it is above mean + sqrt(2 spread), and of many none above that of their largest means and spreads.
/// Source: Wolkowicz & Styan 1980.
template <class T>
struct Eigenvalues {
  T mean{}, spread{};
};
/// Of A^T A - I, A = I + H.
template <class P, class T = typename P::V>
inline __attribute__((always_inline)) Eigenvalues<T> stretches_of(const Tensor<T>& h) noexcept {
  Tensor<T> m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      m[i][j] = m[j][i] =
          P::fma(h[2][i], h[2][j], P::fma(h[1][i], h[1][j], P::fma(h[0][i], h[0][j], h[i][j] + h[j][i])));
  const T third = P::all(typename P::Number(1.0 / 3)), mean = third * trace(m);
  return {mean, P::fma(third, double_dot<P>(m, m), -(mean * mean))};
}
template <class T>
inline __attribute__((always_inline)) void widen(Eigenvalues<T>& to, const Eigenvalues<T>& by) noexcept {
  to.mean = to.mean < by.mean ? by.mean : to.mean;
  to.spread = to.spread < by.spread ? by.spread : to.spread;
}

struct Undamped {
  static constexpr bool any = false, apart = false;
};

/// @tparam apart_  its forces are asked for by themselves, too
template <class P, bool apart_>
struct TetDamping {
  using T = typename P::V;
  static constexpr bool any = true, apart = apart_;
  T beta;                             // [s]
  const std::array<Column<T>, 4>* v;  // of the corners [m/s]
  T mean{};                           // j_t'; only with nodal pressure [1/s]
  // Results.
  T power{};  // without that of the nodes' volumes where they have one [W]
  /// Of F^T F - I, and with nodal pressure the same of cof F: by their largest eigenvalues the damper grows; only with the energy.
  Eigenvalues<T> stretch{}, stretch_of_areas{};
  Tensor<T> stress{};  // its part alone; only apart [Pa]

  /// Adds F S_v. With nodal pressure the sum has the part of the nodes already.
  template <bool nodal, bool with_energy>
  inline __attribute__((always_inline)) void add(const StableNeoHookean<P>& law, const Tensor<T>& h,
                                                 const Tensor<T>& cof, const Tensor<T>& rate, T volume,
                                                 Tensor<T>& sum) noexcept {
    const Tensor<T> f = plus_identity<P>(h);
    T e[3][3];  // 2 E'; of the diagonal E'
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        e[i][j] = P::fma(f[2][i], rate[2][j], P::fma(f[1][i], rate[1][j], f[0][i] * rate[0][j]));
        if (i == j) continue;
        e[i][j] =
            P::fma(rate[2][i], f[2][j], P::fma(rate[1][i], f[1][j], P::fma(rate[0][i], f[0][j], e[i][j])));
      }
    const T eta = beta * law.mu, two_eta = eta + eta;
    Tensor<T> s;
    for (std::size_t i = 0; i < 3; ++i) {
      if constexpr (nodal)
        s[i][i] = two_eta * e[i][i];
      else
        s[i][i] = P::fma(two_eta, e[i][i], beta * law.lambda * (e[0][0] + e[1][1] + e[2][2]));
      for (std::size_t j = i + 1; j < 3; ++j) s[i][j] = s[j][i] = eta * e[i][j];
    }
    power = volume *
            P::fma(s[0][1], e[0][1],
                   P::fma(s[0][2], e[0][2],
                          P::fma(s[1][2], e[1][2],
                                 P::fma(s[0][0], e[0][0], P::fma(s[1][1], e[1][1], s[2][2] * e[2][2])))));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        sum[i][j] = P::fma(f[i][0], s[0][j], P::fma(f[i][1], s[1][j], P::fma(f[i][2], s[2][j], sum[i][j])));
        if constexpr (apart)
          stress[i][j] = P::fma(f[i][0], s[0][j], P::fma(f[i][1], s[1][j], f[i][2] * s[2][j]));
      }
    if constexpr (with_energy) stretch = stretches_of<P>(h);
    if constexpr (nodal && (apart || with_energy)) {
      Tensor<T> areas = cof;  // cof F - I
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) areas[i][j] = areas[i][j] - h[j][i];
      for (std::size_t i = 0; i < 3; ++i) areas[i][i] = areas[i][i] + trace(h);
      if constexpr (with_energy) stretch_of_areas = stretches_of<P>(areas);
      if constexpr (apart) {
        const T pressure = beta * law.lambda * mean;
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) stress[i][j] = P::fma(pressure, areas[i][j], stress[i][j]);
        for (std::size_t i = 0; i < 3; ++i) stress[i][i] = stress[i][i] + pressure;
      }
    }
  }
};

/// How many times the steps at rest are wanted where the law is stiffer than there by `of_law` and the damper by `of_damper`: as many as without
/// a damper, of_law, which has its root to spare, and no less than are stable, by omega (sqrt(1 + z^2) + z) of the fastest vibration.
/// @param z  beta omega / 2 at rest
inline __attribute__((always_inline)) double damped_stiffening(double of_law, double of_damper,
                                                               double z) noexcept {
  const double now = std::sqrt(of_law + z * z * of_damper * of_damper) + z * of_damper;
  const double stable = now / (std::sqrt(1 + z * z) + z);
  return of_law < stable ? stable : of_law;
}

}  // namespace palpate::physics
