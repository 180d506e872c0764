#pragma once
// How much tissue gives at once under a tip, beside what its modes tell: z = r + s F + sum phi q. By a closed form at first, that of a half
// space under the patch that bears, s = g / k, k = 2 E a / (1 - nu^2); g is learnt from what has been pressed since,
//
//   g = sum of d(z - sum phi q) dF / k  /  sum of (dF / k)^2,   sums that forget by what they are told, not by time
//
// so it stays where a hand stands. Both are low-passed twice at 10 Hz first: in a millisecond, or at a step of an encoder, the masses under the
// tip stand and tissue seems stiff. Why of changes: on what stiffens with depth the hand moves along the tangent. A copy that is too soft has to be
// paid for, too stiff a one costs nothing: g begins below 1.

#include <Eigen/Core>
#include <algorithm>

#include "physics_node/contact/low_pass.h"

namespace palpate::physics {

class ResidualCompliance {
 public:
  /// @param k  closed form of the stiffness [N/m]
  /// @param dF, dy  changes in a frame of dt of the force and of z - sum phi q [N], [m]
  void follow(double k, double dF, double dy, double dt) noexcept {
    k_ = k;
    const double part = low_pass_part(corner_Hz, dt);
    rates_.pass({dF / dt, dy / dt}, part);
    const double by = rates_.value()[0] / k;
    const double keep = told / (told + by * by * dt);
    above_ = keep * above_ + rates_.value()[1] * by * dt;
    below_ = keep * below_ + by * by * dt;
  }
  /// Another contact begins.
  void begin(double k) noexcept { *this = {}, k_ = k; }
  double value() const noexcept { return k_ > 0 ? std::clamp(above_ / below_, least, most) / k_ : 0; }

 private:
  static constexpr double corner_Hz = 10;
  static constexpr double first = 0.5, least = 0.1, most = 3;  // g
  static constexpr double told = 1e-4;    // what sums hold about: 10 mm/s for a second [m^2/s]
  static constexpr double weight = 1e-6;  // of what g begins with: 1 mm/s for a second [m^2/s]

  double k_ = 0;
  TwiceLowPassed<Eigen::Vector2d> rates_;  // of F and z - sum phi q [N/s], [m/s]
  double above_ = first * weight, below_ = weight;
};

}  // namespace palpate::physics
