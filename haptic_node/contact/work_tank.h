#pragma once
// How much energy moving planes may push into the hand. A plane that tissue moves against a pressing hand does work;
// with delayed patches that work feeds oscillation, so it is paid from a small tank that planes which give way fill
// again, plus a trickle for tissue that truly moves (a pulse).

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::haptic {

class WorkTank {
 public:
  static constexpr double capacity = 0.2e-3;  // [J]
  static constexpr double trickle = 5e-3;     // [W]
  static constexpr double rest = 0.05;        // without contact, after which the tank is full again [s]

  /// Once a tick.
  void pass(double dt, bool touching) noexcept {
    free_for_ = touching ? 0.0 : free_for_ + dt;
    level_ = free_for_ >= rest ? capacity : std::min(capacity, level_ + trickle * dt);
  }

  /// The farthest that a spring of stiffness k [N/m], compressed by d [m], may be compressed further [m]:
  /// k/2 ((d + s)^2 - d^2) <= level. Without bounds for k = 0.
  double affordable(double k, double d) const noexcept {
    if (k <= 0) return std::numeric_limits<double>::infinity();
    return std::sqrt(d * d + 2.0 * level_ / k) - d;
  }

  /// Work done by a plane on the hand [J]; below 0: by the hand on the plane.
  void book(double work) noexcept {
    level_ = std::clamp(level_ - work, 0.0, capacity);
    booked_ += work;
  }

  /// @return what there is of `work` [J], booked
  double pay(double work) noexcept {
    const double paid = std::min(work, level_);
    book(paid);
    return paid;
  }

  double level() const noexcept { return level_; }
  double booked() const noexcept { return booked_; }  // sum of all work of planes since the start [J]

 private:
  double level_ = capacity;
  double booked_ = 0;
  double free_for_ = 0;
};

}  // namespace palpate::haptic
