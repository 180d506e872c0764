#pragma once
// Where a cell of stable neo-Hookean tissue begins to break: stretched too far, and in tension.
//
//   l_1 > b                 its largest principal stretch, as a spring breaks at l / L > b
//   tau_1 >= tau_b / 2      the stress along it, tau_i = mu l_i^2 + q J, q = (lambda + mu)(J - 1) - mu; tau_b of a bar stretched to b
//
// at its centre. A bar that is pulled, free at its sides, breaks at b; one that is pressed flat bulges beyond b, but nothing pulls
// there (tau = 0). tau_1 belongs to l_1, so that both say l_1^2 > B = max(b^2, (tau_b / 2 - q J) / mu): B I - C is not positive
// definite, C = F^T F. No square root, no eigenvalue. The stretch of a rotation is 1.
// Why half: a sheet or a shear at b has 2/3 of tau_b, and must break; a pressed side has none but for what swings.
// Why not the stress alone: with nu near 0.5 a sound wave of tissue that falls at 1 m/s has as much tension without any stretch.

#include "physics_node/material/tensor.h"

namespace palpate::physics {

template <class T>
struct TensionLimit {
  T stretch{};  // b^2 - 1
  T tension{};  // tau_b / (2 mu)
};

/// Of a bar of ratio b: its sides are free, mu l_t^2 + q J = 0, so q = - mu / b and J_b = 1 + (1 - 1 / b) mu / (lambda + mu);
///   tau_b = mu (b^2 - J_b / b)
inline TensionLimit<double> tension_limit(double b, double mu, double lambda) noexcept {
  const double J = 1 + (1 - 1 / b) * mu / (lambda + mu);
  return {.stretch = b * b - 1, .tension = 0.5 * (b * b - J / b)};
}

/// What a bar holds that is stretched to b, by its volume at rest: psi of its stretches [J/m^3].
inline double energy_at_limit(double b, double mu, double lambda) noexcept {
  const double j = (1 - 1 / b) * mu / (lambda + mu);  // J - 1
  return 0.5 * mu * (b * b + 2 * (1 + j) / b - 3) - mu * j + 0.5 * (lambda + mu) * j * j;
}

/// C - I = H + H^T + H^T H
template <class P, class T = typename P::V>
Tensor<T> stretching(const Tensor<T>& h) noexcept {
  Tensor<T> c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      c[i][j] = c[j][i] =
          P::fma(h[2][i], h[2][j], P::fma(h[1][i], h[1][j], P::fma(h[0][i], h[0][j], h[i][j] + h[j][i])));
  return c;
}

/// B - 1. @param of_volume  (lambda + mu) / mu
template <class P, class T = typename P::V>
T breaking_stretch(const TensionLimit<T>& limit, T of_volume, const Tensor<T>& h) noexcept {
  const Tensor<T> cof = cofactor<P>(h);
  const T det = P::fma(h[0][2], cof[0][2], P::fma(h[0][1], cof[0][1], h[0][0] * cof[0][0]));
  const T j = trace(h) + (trace(cof) + det);
  const T q = P::fma(of_volume, j, P::all(-1));  // over mu
  const T by_tension = limit.tension - P::all(1) - P::fma(q, j, q);
  return by_tension > limit.stretch ? by_tension : limit.stretch;
}

/// The least leading minor of A I - c: positive where A I - c is positive definite, and nowhere else.
template <class P, class T = typename P::V>
T least_minor(T A, const Tensor<T>& c) noexcept {
  const T x = A - c[0][0], y = A - c[1][1], z = A - c[2][2];
  const T second = P::fma(x, y, -(c[0][1] * c[0][1]));
  const T u = P::fma(c[0][1], c[1][2], c[0][2] * y), v = P::fma(x, c[1][2], c[0][1] * c[0][2]);
  const T third = P::fma(z, second, -P::fma(c[0][2], u, c[1][2] * v));
  const T first_two = x < second ? x : second;
  return first_two < third ? first_two : third;
}

}  // namespace palpate::physics
