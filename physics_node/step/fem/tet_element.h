#pragma once
// A linear tetrahedron of stable neo-Hookean tissue, plain or with the average pressure of its nodes.
//
//   d_k = u_k - u_0,   H = sum over k = 1, 2, 3 of d_k b_k^T,   b_k the slope of corner k's shape function at rest
//   f_k = - V P b_k,   f_0 = - (f_1 + f_2 + f_3)
//
// Plain: P of the law. It locks where volume is nearly kept: five or six elements a node leave no way to move that keeps the volume of
// each. With nodal pressure, a node's volume in place of an element's resists by lambda:
//
//   j_n = sum over t at n of V_t (J_t - 1) / sum of V_t,   j_t = mean of j_n over the corners of t
//   P   = mu F + [lambda j_t + mu (J_t - 1) - mu] cof F
//
// which is the slope of sum_t V_t [mu/2 (F:F - 3) - mu (J - 1) + mu/2 (J - 1)^2] + sum_n V_n lambda/2 j_n^2, V_n = sum V_t / 4.
// The mu (J - 1) stays with the element: it resists what the average does not see, one growing beside one that shrinks.
// Source: Bonet & Burton 1998 for the average pressure of nodes.

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/tet_damper.h"

namespace palpate::physics {

template <class Real>
struct TetConstants {
  Real mu = 0, lambda = 0;  // [Pa]
};

/// Slopes of the shape functions of corners 1, 2, 3 [1/m].
template <class T>
using TetSlopes = std::array<Column<T>, 3>;

/// H of the displacements of the corners.
template <class P, class T = typename P::V>
inline __attribute__((always_inline)) Tensor<T> tet_gradient(const TetSlopes<T>& b,
                                                             const std::array<Column<T>, 4>& u) noexcept {
  std::array<Column<T>, 3> d;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) d[k][i] = u[k + 1][i] - u[0][i];
  Tensor<T> h;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      h[i][j] = P::fma(d[2][i], b[2][j], P::fma(d[1][i], b[1][j], d[0][i] * b[0][j]));
  return h;
}

/// J - 1
template <class P, class T = typename P::V>
inline __attribute__((always_inline)) T tet_volume_change(const TetSlopes<T>& b,
                                                          const std::array<Column<T>, 4>& u) noexcept {
  const Tensor<T> h = tet_gradient<P>(b, u);
  return StableNeoHookean<P>::volume_change(h, cofactor<P>(h));
}

/// J - 1, and J' = cof F : F' of the velocities of the corners.
template <class T>
struct TetGrowth {
  T change, rate;
};
template <class P, class T = typename P::V>
inline __attribute__((always_inline)) TetGrowth<T> tet_growth(const TetSlopes<T>& b,
                                                              const std::array<Column<T>, 4>& u,
                                                              const std::array<Column<T>, 4>& v) noexcept {
  const Tensor<T> h = tet_gradient<P>(b, u), rate = tet_gradient<P>(b, v), cof = cofactor<P>(h);
  T sum = P::fma(trace(h), trace(rate), trace(rate));  // cof F = cof H - H^T + (1 + tr H) I
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum = P::fma(cof[i][j] - h[j][i], rate[i][j], sum);
  return {StableNeoHookean<P>::volume_change(h, cof), sum};
}

template <class P>
struct TetForces {
  using T = typename P::V;
  std::array<Column<T>, 4> f;  // on each corner [N]
  T change;                    // J - 1
  T energy;     // [J]; without that of the nodes' volumes where they have one; only where it was asked for
  T stiffness;  // bound of the tangent of the stress [Pa]; only there
};

/// f_k of a stress.
template <class P, class T = typename P::V>
inline __attribute__((always_inline)) void tet_spread(const TetSlopes<T>& b, T volume,
                                                      const Tensor<T>& stress,
                                                      std::array<Column<T>, 4>& f) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      f[c + 1][i] =
          -(volume * P::fma(stress[i][2], b[c][2], P::fma(stress[i][1], b[c][1], stress[i][0] * b[c][0])));
    f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }
}

/// @param mean  j_t; only with nodal pressure
/// @param damping  Undamped or TetDamping
template <class P, bool nodal, bool with_energy, class Real, class Damping, class T = typename P::V>
inline __attribute__((always_inline)) void tet_forces(const TetConstants<Real>& k, const TetSlopes<T>& b,
                                                      T volume, const std::array<Column<T>, 4>& u, T mean,
                                                      Damping& damping, TetForces<P>& out) noexcept {
  const StableNeoHookean<P> law{P::all(k.mu), P::all(k.lambda)};
  const Tensor<T> h = tet_gradient<P>(b, u), cof = cofactor<P>(h);
  out.change = law.volume_change(h, cof);
  T p;
  if constexpr (nodal)
    p = P::fma(law.lambda, mean, law.mu * out.change);
  else
    p = P::all(k.lambda + k.mu) * out.change;
  if constexpr (with_energy) {
    out.energy = volume * law.psi(h, out.change, nodal ? law.mu : law.lambda + law.mu);
    out.stiffness = law.stiffness(h, cof, p - law.mu);
  }
  if constexpr (nodal && Damping::any) p = P::fma(law.lambda * damping.beta, damping.mean, p);
  Tensor<T> stress = law.stress(h, cof, p);
  if constexpr (Damping::any)
    damping.template add<nodal, with_energy>(law, h, cof, tet_gradient<P>(b, *damping.v), volume, stress);
  tet_spread<P>(b, volume, stress, out.f);
}

}  // namespace palpate::physics
