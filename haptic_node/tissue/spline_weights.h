#pragma once
// Weights of four neighbours in a row, by the cubic B-spline: they sum to 1, give back what is linear, and are C2, so that a tip
// that slides over nodes is not felt to do so. With u in [0, 1] behind the second of the four:
//
//   w = ((1 - u)^3, 3 u^3 - 6 u^2 + 4, -3 u^3 + 3 u^2 + 3 u + 1, u^3) / 6
//
// Source: de Boor 1978.

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::haptic {

struct SplineWeights {
  int first = 0;                    // of the four
  std::array<double, 4> w{}, dw{};  // and their derivatives by the coordinate

  /// @param x      coordinate, in nodes; taken as the nearest in [1, nodes - 2]
  /// @param nodes  in the row, at least 4
  SplineWeights(double x, int nodes) noexcept {
    x = std::clamp(x, 1.0, nodes - 2.0);
    const int cell = std::min(static_cast<int>(x), nodes - 3);
    const double u = x - cell, r = 1 - u;
    first = cell - 1;
    w = {r * r * r / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * r * r * r - 6 * r * r + 4) / 6,
         u * u * u / 6};
    dw = {-0.5 * r * r, 1.5 * u * u - 2 * u, 2 * r - 1.5 * r * r, 0.5 * u * u};
  }
};

}  // namespace palpate::haptic
