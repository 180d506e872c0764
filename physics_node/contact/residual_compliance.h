#pragma once
// How much tissue gives at once under a tip, beside what its modes tell: x = r + z(F) + sum phi q. By a closed form at first, that of a half
// space under what bears, z = g z_0 (growing_contact.h); g is learnt from what has been pressed since,
//
//   g = sum of d(x - sum phi q) dz_0  /  sum of dz_0^2,   sums that forget by what they are told, not by time
//
// so it stays where a hand stands. Both are low-passed twice at 10 Hz first: in a millisecond, or at a step of an encoder, the masses under the
// tip stand and tissue seems stiff. Why of changes: on what stiffens with depth the hand moves along the tangent.
// What the next touch begins with is the secant from the free surface, since tissue of cells gives in steps, each time the tip comes to one
// more node: g_1 = sum of x z_0 / sum of z_0^2 of all touches at such a place, weighted with time.

#include <Eigen/Core>
#include <algorithm>

#include "physics_node/contact/low_pass.h"

namespace palpate::physics {

class ResidualCompliance {
 public:
  static constexpr double least = 0.1, most = 3;  // g

  /// @param dz, dx  changes in a frame of dt of the closed form z_0(F) and of x - sum phi q [m]
  void follow(double dz, double dx, double dt) noexcept {
    const double part = low_pass_part(corner_Hz, dt);
    rates_.pass({dz / dt, dx / dt}, part);
    const double by = rates_.value()[0];
    const double keep = told / (told + by * by * dt);
    above_ = keep * above_ + rates_.value()[1] * by * dt;
    below_ = keep * below_ + by * by * dt;
  }
  /// Another contact begins.
  void begin(double g) noexcept {
    rates_ = {};
    above_ = std::clamp(g, least, most) * weight, below_ = weight;
  }
  double value() const noexcept { return std::clamp(above_ / below_, least, most); }  // g

 private:
  static constexpr double corner_Hz = 10;
  static constexpr double told = 1e-4;    // what sums hold about: 10 mm/s for a second [m^2/s]
  static constexpr double weight = 1e-6;  // of what g begins with: 1 mm/s for a second [m^2/s]

  TwiceLowPassed<Eigen::Vector2d> rates_;  // of z_0 and x - sum phi q [m/s]
  double above_ = weight, below_ = weight;
};

/// g of a first touch.
class FirstTouch {
 public:
  /// By what is known before anything has been pressed.
  void begin(double g) noexcept { above_ = g * weight, below_ = weight; }
  /// @param z, x  z_0(F) and how far it has given, from the free surface on [m]
  void follow(double z, double x, double dt) noexcept {
    const double keep = told / (told + z * z * dt);
    above_ = keep * above_ + x * z * dt;
    below_ = keep * below_ + z * z * dt;
  }
  double value() const noexcept {
    return std::clamp(above_ / below_, ResidualCompliance::least, ResidualCompliance::most);
  }

 private:
  static constexpr double told = 1e-7;    // what sums hold about: 1 mm for 0.1 s [m^2 s]
  static constexpr double weight = 1e-9;  // of what g begins with: 1 mm for a millisecond [m^2 s]

  double above_ = weight, below_ = weight;
};

}  // namespace palpate::physics
