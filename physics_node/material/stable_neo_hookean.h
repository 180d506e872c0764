#pragma once
// Stable neo-Hookean, without its logarithm: finite for any deformation, also for one that turns a cell inside out.
//
//   psi(F) = mu/2 (F:F - 3) - mu (J - 1) + (lambda + mu)/2 (J - 1)^2,   J = det F
//   P(F)   = mu F + [(lambda + mu)(J - 1) - mu] cof F
//
// P(I) = 0, and near I it is linear elasticity of the same mu and lambda. Computed from H = F - I, the gradient of the
// displacement, and never from F: of a small strain float would keep three digits.
// Source: Smith, de Goes, Kim 2018, eq. (14), less the term of the logarithm.

#include "physics_node/material/tensor.h"

namespace palpate::physics {

/// @tparam P  Scalar or Pack: how many at once
template <class P>
struct StableNeoHookean {
  using T = typename P::V;
  using Real = typename P::Number;
  T mu, lambda;  // [Pa]

  /// J - 1 = tr H + tr cof H + det H
  static T volume_change(const Tensor<T>& h, const Tensor<T>& cof) noexcept {
    const T det = P::fma(h[0][2], cof[0][2], P::fma(h[0][1], cof[0][1], h[0][0] * cof[0][0]));
    return trace(h) + (trace(cof) + det);
  }

  /// Energy per volume at rest [J/m^3].
  T psi(const Tensor<T>& h) const noexcept { return psi(h, volume_change(h, cofactor<P>(h)), lambda + mu); }

  /// The same with another modulus in place of lambda + mu of (J - 1)^2 / 2. @param j  J - 1
  T psi(const Tensor<T>& h, T j, T of_volume) const noexcept {
    const T shear = P::fma(P::all(0.5), double_dot<P>(h, h), trace(h)) - j;
    return P::fma(mu, shear, P::all(0.5) * of_volume * j * j);
  }

  /// First Piola-Kirchhoff stress, force per area at rest [Pa].
  Tensor<T> stress(const Tensor<T>& h) const noexcept {
    const Tensor<T> cof = cofactor<P>(h);
    return stress(h, cof, (lambda + mu) * volume_change(h, cof));
  }

  /// The same under another p than (lambda + mu)(J - 1), where volume is not a matter of this place alone.
  ///   P = mu H + q (cof H - H^T) + (p (1 + t) - mu t) I,   t = tr H, q = p - mu
  /// @param cof  of H
  Tensor<T> stress(const Tensor<T>& h, const Tensor<T>& cof, T p) const noexcept {
    const T q = p - mu;
    const T on_axes = P::fma(q, trace(h), p);  // p + p t - mu t
    Tensor<T> s;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) s[i][j] = P::fma(mu, h[i][j], q * (cof[i][j] - h[j][i]));
    for (std::size_t i = 0; i < 3; ++i) s[i][i] = s[i][i] + on_axes;
    return s;
  }

  /// Bound of the tangent, |dP| <= stiffness |dH|: 3 (lambda + mu) + (1 + sqrt(3)) mu at rest, more where it is stretched or squeezed [Pa].
  T stiffness(const Tensor<T>& h) const noexcept {
    const Tensor<T> cof = cofactor<P>(h);
    return stiffness(h, cof, P::fma(lambda + mu, volume_change(h, cof), -mu));
  }

  /// The same under another q = p - mu, see stress().
  ///   mu + (lambda + mu) |cof F|^2 + |q| |F|,   |F| <= (|F|^2 / sqrt(3) + sqrt(3)) / 2
  T stiffness(const Tensor<T>& h, Tensor<T> cof, T q) const noexcept {
    const T t = trace(h);
    T f2 = P::fma(P::all(2), t, P::all(3)) + double_dot<P>(h, h);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) cof[i][j] = cof[i][j] - h[j][i];
    for (std::size_t i = 0; i < 3; ++i) cof[i][i] = cof[i][i] + (t + P::all(1));
    constexpr double root3 = 1.7320508075688772;
    f2 = P::fma(f2, P::all(static_cast<Real>(0.5 / root3)), P::all(static_cast<Real>(0.5 * root3)));
    return P::fma(lambda + mu, double_dot<P>(cof, cof), P::fma(q > T{} ? q : -q, f2, mu));
  }

  /// Its change for a change dH of H.
  Tensor<T> stress_change(const Tensor<T>& h, const Tensor<T>& dh) const noexcept {
    const Tensor<T> cof = cofactor<P>(plus_identity<P>(h));
    const T q = P::fma(lambda + mu, volume_change(h, cofactor<P>(h)), -mu);
    const T dp = (lambda + mu) * double_dot<P>(cof, dh);
    const Tensor<T> dcof = cofactor_change<P>(plus_identity<P>(h), dh);
    Tensor<T> ds;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        ds[i][j] = P::fma(mu, dh[i][j], P::fma(dp, cof[i][j], q * dcof[i][j]));
    return ds;
  }
};

}  // namespace palpate::physics
