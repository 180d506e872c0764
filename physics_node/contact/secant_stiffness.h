#pragma once
// How stiffly tissue answers a tool, learnt from the force on it and the indentation that the force does work on:
//
//   K -> (F + K e) / (d + e),   e = 0.2 mm, with a time constant of 150 ms
//
// What is known weighs as much as an indentation of e: K ends at F / d, and a light touch changes little.

#include <algorithm>
#include <cmath>

#include "physics_node/step/node_motion.h"

namespace palpate::physics {

class SecantStiffness {
 public:
  /// @param first  for the first touch, K_0 [N/m]; what is learnt stays within a fiftieth and fifty times it
  void begin(double first) noexcept { first_ = K_ = first; }
  bool begun() const noexcept { return first_ > 0; }

  /// @param F, d  along one direction [N], [m]
  void follow(double F, double d, double dt) noexcept {
    const double measured = (F + K_ * slack) / (std::max(0.0, d) + slack);
    K_ += (1 - std::exp(-dt / time)) * (std::clamp(measured, first_ / range, first_ * range) - K_);
  }
  double value() const noexcept { return K_; }  // K [N/m]; 0: not begun

 private:
  static constexpr double slack = 2e-4;  // e [m]
  static constexpr double time = 0.150;  // [s]
  static constexpr double range = 50;

  double first_ = 0, K_ = 0;
};

/// Does it always come back to its rest shape? Then the plane at zero force is the surface at rest.
inline bool remembers_rest(const Body& body) noexcept {
  return is_anchored(body) && !may_change_for_good(body);
}

}  // namespace palpate::physics
