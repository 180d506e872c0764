#pragma once
// When a stick has to look again for what is near it.

#include <algorithm>

#include "physics_node/contact/stick.h"

namespace palpate::physics {

class StickSearch {
 public:
  /// Around the stick, within which things are listed: what a hand at 0.2 m/s covers in 50 ms [m].
  static constexpr double margin = 0.010;

  /// True the first time, once the stick has gone half the margin at either end, and after 20 ms, in which tissue
  /// may have come near by itself. A list begins with each `true`.
  bool due(const Stick& now, double t) noexcept {
    const double moved = std::max((now.A - A_).norm(), (now.A + now.D - A_ - D_).norm());
    if (moved <= 0.5 * margin && t - when_ < period && t >= when_) return false;
    A_ = now.A;
    D_ = now.D;
    when_ = t;
    return true;
  }
  void reset() noexcept { *this = {}; }

 private:
  static constexpr double period = 0.020;  // [s]

  Vec3 A_ = Vec3::Constant(1e9), D_ = Vec3::Zero();
  double when_ = -1e9;
};

}  // namespace palpate::physics
