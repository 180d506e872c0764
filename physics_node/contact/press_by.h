#pragma once
// What presses a shape into faces: a given force, or the spring and damper of a hand whose point is the pose's tip. With p = -z > 0 the way
// from the shape, at the depth z below the tip, to the hand and p' its rate, which the step of dt ends with,
//
//   F = K p + clamp(B p', -K p, K p / 2),   p' = lead - z / dt;    F = 0 for p <= 0
//
// B acts between hand and tissue and never pulls: haptic_node/tissue/contact_spring.h, which the hand feels, is the same.

#include <algorithm>

namespace palpate::physics {

struct PressBy {
  double force = 0;                   // given, where there is no spring [N]
  double stiffness = 0, damping = 0;  // K [N/m], B [N s/m]
  double lead = 0, dt = 1;            // [m/s], [s]
  double most = 0;                    // of a spring [N]

  bool presses() const noexcept { return force > 0 || (stiffness > 0 && most > 0); }
  /// At a depth [N].
  double at(double z) const noexcept {
    if (stiffness <= 0) return force;
    const double whole = stiffness * -z;
    return z >= 0 ? 0 : std::min(most, whole + std::clamp(damping * (lead - z / dt), -whole, 0.5 * whole));
  }
  /// By how much less it presses with depth, at most [N/m].
  double fall(double z) const noexcept { return stiffness > 0 && z < 0 ? stiffness + damping / dt : 0; }
};

}  // namespace palpate::physics
