#pragma once
// What lies between a hand and tissue, on both sides of the wire the same: a spring K and a damper B in series with the
// compliance s of what follows at once. With e = x - y the depth of the hand below the modal surface and e' its rate
//
//   f = K e / (1 + K s)                                                          the spring alone
//   F = (K e + B e' + (B s / h) F_before) / (1 + K s + B s / h)                  F' by its difference over the step h
//   0 <= F <= 3/2 f,    F = 0 for e <= 0
//
// For s = 0 that is F = K e + clamp(B e', -K e, K e / 2): the damper never pulls. It acts between hand and tissue: towards the
// ground B = 1 N s/m would be half of what a spring gives at 20 Hz.

#include <algorithm>

namespace palpate::haptic {

struct ContactSpring {
  static constexpr double most_damping = 0.5;  // of the spring's force, toward the tissue

  double stiffness = 500;  // K [N/m]
  double damping = 1;      // B [N s/m]

  /// With the compliance in series, K / (1 + K s) [N/m].
  double series(double residual) const noexcept { return stiffness / (1 + stiffness * residual); }

  /// @param residual  s [m/N]
  /// @param h         the time since `before` [s]
  /// @param e, e_dot  [m], [m/s]
  /// @param before    F a step ago [N]
  double force(double residual, double h, double e, double e_dot, double before) const noexcept {
    if (e <= 0) return 0;
    const double memory = damping * residual / h;
    const double whole =
        (stiffness * e + damping * e_dot + memory * before) / (1 + stiffness * residual + memory);
    return std::clamp(whole, 0.0, (1 + most_damping) * series(residual) * e);
  }

  /// In spring and compliance [J].
  double energy(double residual, double e) const noexcept {
    return e > 0 ? 0.5 * series(residual) * e * e : 0.0;
  }
};

}  // namespace palpate::haptic
