#pragma once
// Tensors of the second order for laws and kernels: of one number each, or of as many side by side as a vector holds.

#include <array>

namespace palpate::physics {

/// T is double or float, or a vector of them: whatever has + - *.
template <class T>
using Tensor = std::array<std::array<T, 3>, 3>;  // by row, then column

/// Numbers one by one; a Pack is the same for many.
template <class Real>
struct Scalar {
  using V = Real;
  using Number = Real;
  static V all(Real value) noexcept { return value; }
  static V fma(V a, V b, V c) noexcept { return a * b + c; }
  static V fnma(V a, V b, V c) noexcept { return c - a * b; }
  static bool any_above_zero(V v) noexcept { return v > 0; }
};

template <class T>
T trace(const Tensor<T>& a) noexcept {
  return a[0][0] + a[1][1] + a[2][2];
}

/// a : b
template <class P, class T = typename P::V>
T double_dot(const Tensor<T>& a, const Tensor<T>& b) noexcept {
  T sum = a[0][0] * b[0][0];
  for (std::size_t n = 1; n < 9; ++n) sum = P::fma(a[n / 3][n % 3], b[n / 3][n % 3], sum);
  return sum;
}

/// cof A = det A A^-T; its entry (i, j) is the minor without row i and column j, with its sign.
template <class P, class T = typename P::V>
Tensor<T> cofactor(const Tensor<T>& a) noexcept {
  Tensor<T> c;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t m = (j + 1) % 3, n = (j + 2) % 3;
      c[i][j] = P::fma(a[k][m], a[l][n], -(a[k][n] * a[l][m]));
    }
  }
  return c;
}

/// Its derivative: d(cof A) for a change dA.
template <class P, class T = typename P::V>
Tensor<T> cofactor_change(const Tensor<T>& a, const Tensor<T>& da) noexcept {
  Tensor<T> c;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t m = (j + 1) % 3, n = (j + 2) % 3;
      c[i][j] = P::fma(a[k][m], da[l][n],
                       P::fma(da[k][m], a[l][n], -P::fma(a[k][n], da[l][m], da[k][n] * a[l][m])));
    }
  }
  return c;
}

/// a b
template <class P, class T = typename P::V>
Tensor<T> product(const Tensor<T>& a, const Tensor<T>& b) noexcept {
  Tensor<T> c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      c[i][j] = P::fma(a[i][2], b[2][j], P::fma(a[i][1], b[1][j], a[i][0] * b[0][j]));
  return c;
}

/// I + h
template <class P, class T = typename P::V>
Tensor<T> plus_identity(const Tensor<T>& h) noexcept {
  Tensor<T> f;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) f[i][j] = i == j ? h[i][j] + P::all(1) : h[i][j];
  return f;
}

}  // namespace palpate::physics
