#pragma once
// St Venant-Kirchhoff: linear in Green's strain, as Mendoza & Laugier have it.
//
//   E = (H + H^T + H^T H) / 2,   psi = lambda/2 (tr E)^2 + mu E:E,   S = lambda tr E I + 2 mu E,   P = F S
//
// Limit: it softens under compression, below a stretch of 1/sqrt(3) in uniaxial strain, and does not resist being turned
// inside out. For small strain only.

#include "physics_node/material/tensor.h"

namespace palpate::physics {

template <class P>
struct StVenantKirchhoff {
  using T = typename P::V;
  using Real = typename P::Number;
  T mu, lambda;  // [Pa]

  static Tensor<T> green_strain(const Tensor<T>& h) noexcept {
    Tensor<T> e;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        T sum = h[i][j] + h[j][i];
        for (std::size_t k = 0; k < 3; ++k) sum = P::fma(h[k][i], h[k][j], sum);
        e[i][j] = e[j][i] = P::all(0.5) * sum;
      }
    return e;
  }

  /// Energy per volume at rest [J/m^3].
  T psi(const Tensor<T>& h) const noexcept {
    const Tensor<T> e = green_strain(h);
    const T t = trace(e);
    return P::fma(mu, double_dot<P>(e, e), P::all(0.5) * lambda * t * t);
  }

  /// First Piola-Kirchhoff stress [Pa].
  Tensor<T> stress(const Tensor<T>& h) const noexcept {
    return product<P>(plus_identity<P>(h), second_stress(green_strain(h)));
  }

  /// Bound of the tangent, |dP| <= stiffness |dH| [Pa]: (3 lambda + 2 mu)(|F|^2 + |E|), with |E| <= (|E|^2 + 1) / 2
  T stiffness(const Tensor<T>& h) const noexcept {
    const Tensor<T> e = green_strain(h);
    const T f2 = P::fma(P::all(2), trace(h), P::all(3)) + double_dot<P>(h, h);
    return (P::all(3) * lambda + P::all(2) * mu) *
           (f2 + P::fma(P::all(Real(0.5)), double_dot<P>(e, e), P::all(Real(0.5))));
  }

  /// Its change for a change dH of H.
  Tensor<T> stress_change(const Tensor<T>& h, const Tensor<T>& dh) const noexcept {
    const Tensor<T> f = plus_identity<P>(h);
    Tensor<T> de;  // (dH^T F + F^T dH) / 2
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        T sum = dh[0][i] * f[0][j];
        sum = P::fma(f[0][i], dh[0][j], sum);
        for (std::size_t k = 1; k < 3; ++k) sum = P::fma(dh[k][i], f[k][j], P::fma(f[k][i], dh[k][j], sum));
        de[i][j] = de[j][i] = P::all(0.5) * sum;
      }
    const Tensor<T> turned = product<P>(dh, second_stress(green_strain(h)));
    Tensor<T> ds = product<P>(f, second_stress(de));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) ds[i][j] = ds[i][j] + turned[i][j];
    return ds;
  }

 private:
  Tensor<T> second_stress(const Tensor<T>& e) const noexcept {
    const T on_axes = lambda * trace(e);
    Tensor<T> s;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) s[i][j] = P::all(2) * mu * e[i][j];
    for (std::size_t i = 0; i < 3; ++i) s[i][i] = s[i][i] + on_axes;
    return s;
  }
};

}  // namespace palpate::physics
