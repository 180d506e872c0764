#pragma once
// Which way a massless tip is pressed that hangs on a spring as stiff sideways as along: against the resultant N of the
// pressure on the tissue. Its middle lies by zeta n from where the hand leads it, and may move sideways, but for a drag that
// makes it follow within tau:
//
//   K tau a' = -N_t - K a,    zeta n := zeta n + a
//
// N_t is N across n, which tissue bears as it is: so what pushes the tip aside pushes back, and turning gives no energy (the
// spring keeps its length; what the drag takes is lost). A step is taken as backward Euler's, with the stiffness k_t of the
// contact across n:
//
//   n := n + f lean, made unit,    lean = -N_t / F,    f = dt / (tau + dt (1 + k_t / K))
//
// Deviation: on a flat a round tip goes as in a guide: N across the normal g of the faces around is left out, by less where they
// do not face one way. A face between four nodes tilts under a ball beside its middle, by up to 15 degrees, and a hand that
// slides would feel the lattice.
//
// On a flat n is its normal; over an edge the ball rolls as it would on a handle, and falls off where the hand has gone
// deeper than its middle.

#include <algorithm>

#include "common/math/vec3.h"

namespace palpate::physics {

struct TipLean {
  static constexpr double tau =
      5e-3;  // Why: shorter than frames of a slow scene, longer than a wave takes through a cell [s]
  static constexpr double most = 1;  // of lean: a step at most to 45 degrees
  // Why: where the spring is hardly stretched its direction means little, and forces are small [m]
  static constexpr double little = 2e-5;

  static constexpr double flat_from = 0.97,
                          flat_whole = 0.99;  // |mean normal| of the faces around: LocalPlane::flat

  /// N as tissue bears it. @param g  unit  @param flat  of the faces around
  static Vec3 borne(const Vec3& g, const Vec3& on_tissue, double flat) noexcept {
    const double along = on_tissue.dot(g);
    const double share = std::clamp((flat - flat_from) / (flat_whole - flat_from), 0.0, 1.0);
    return (1 - share) * on_tissue + share * along * g;
  }
  /// @param n  unit  @param on_tissue  N, into the tissue along n [N]  @param stretched  zeta [m]
  /// @param across  k_t, and the spring's K [N/m]
  static Vec3 turned(const Vec3& n, const Vec3& on_tissue, double stretched, double across, double stiffness,
                     double dt) noexcept {
    const double pressed = -on_tissue.dot(n);
    if (!(pressed > 0 && stiffness > 0 && stretched > 0)) return n;
    Vec3 lean = -(on_tissue + pressed * n) / pressed;
    if (const double size = lean.norm(); size > most) lean *= most / size;
    const double f = dt / (tau + dt * (1 + across / stiffness));
    return (n + stretched / (stretched + little) * f * lean).normalized();
  }
};

}  // namespace palpate::physics
