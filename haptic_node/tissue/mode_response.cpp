#include "haptic_node/tissue/mode_response.h"

#include <cmath>

namespace palpate::haptic {
namespace {

// Why: with omega h + c h <= 1/2 the term left out is 0.5^14 / 16! of the first, below the rounding of a double.
constexpr double short_step = 0.5;
constexpr int terms = 14;

}  // namespace

ModeResponse mode_response(double stiffness, double damping, double h) noexcept {
  int doublings = 0;
  double t = h;
  for (const double rate = std::sqrt(stiffness) + damping; rate * t > short_step; t *= 0.5) ++doublings;

  // u_k = (M t)^k (0, 1),  M = (0 1; -omega^2 -c);  (P, P') = t sum u_k / (k + 1)!,  (Q, P) = t^2 sum u_k / (k + 2)!
  double u0 = 0, u1 = 1, weight = 1, P = 0, P_dot = 0, Q = 0;
  for (int k = 0; k < terms; ++k) {
    weight /= k + 1;
    P += weight * u0;
    P_dot += weight * u1;
    Q += weight / (k + 2) * u0;
    const double next = -t * (stiffness * u0 + damping * u1);
    u0 = t * u1;
    u1 = next;
  }
  P *= t, P_dot *= t, Q *= t * t;

  ModeResponse r;
  for (;; --doublings) {
    r.a12 = P_dot;
    r.a11 = 1 - stiffness * P;
    r.a21 = -stiffness * P_dot;
    r.a22 = 1 - damping * P_dot - stiffness * P;
    if (doublings == 0) break;
    // A load over 2 t: what it did by t goes on alone, and it acts for t once more.
    const double P_two = P + r.a11 * P + r.a12 * P_dot;
    Q += t * P + r.a11 * Q + r.a12 * P;
    P_dot += r.a21 * P + r.a22 * P_dot;
    P = P_two;
    t *= 2;
  }
  r.c1 = Q / h;
  r.d1 = P / h;
  r.c0 = P - r.c1;
  r.d0 = P_dot - r.d1;
  return r;
}

}  // namespace palpate::haptic
