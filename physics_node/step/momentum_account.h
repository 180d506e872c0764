#pragma once
// Keeps the books of momentum: what gravity, floor and tools put into a body. What it really has must be that.

#include <cstdint>

#include "common/math/vec3.h"

namespace palpate::physics {

struct Momenta {
  Vec3 linear = Vec3::Zero();   // [kg m/s]
  Vec3 angular = Vec3::Zero();  // about the origin [kg m^2/s]
};

/// What should not differ and by what to measure it. Bodies add up: what they give each other cancels.
struct MomentumBalance {
  Momenta missing;     // what is there less what is booked
  double linear = 0;   // sum of |m v| at the start and of |J| of all impulses since [kg m/s]
  double angular = 0;  // likewise of |x x m v| and |x x J| [kg m^2/s]
};

/// Momentum and mass moment, stepped with the forces from outside alone. Exact for symplectic Euler and for Verlet's velocity
/// of half steps:
///
///   dp = M g dt,   dL = X x g dt,   dX = p dt,   X = sum of m x
///
/// Only for bodies whose masses are all free and whose dampers act along elements. Cost: a few sums a step.
class MomentumAccount {
 public:
  struct Start {
    Momenta momenta;
    Vec3 mass_moment = Vec3::Zero();  // X [kg m]
    double mass = 0;                  // M [kg]
    double linear = 0, angular = 0;   // sums of |m v|, |x x m v|

    /// A mass at x with velocity v.
    void add(double m, const Vec3& x, const Vec3& v) noexcept {
      const Vec3 mv = m * v;
      momenta.linear += mv;
      momenta.angular += x.cross(mv);
      mass_moment += m * x;
      mass += m;
      linear += mv.norm();
      angular += x.cross(mv).norm();
    }
  };
  void restart(const Start& start) noexcept;
  /// A step of all masses. @param kick  for which the velocities are accelerated, @param dt  for which masses move [s]
  void step(const Vec3& gravity, double kick, double dt) noexcept;
  /// An impulse on a mass at x, that changes its velocity only.
  void hit(const Vec3& impulse, const Vec3& x) noexcept;
  /// An impulse as if within the step of dt that brought the mass from x: it has moved on with it.
  void push(const Vec3& impulse, const Vec3& x, double dt) noexcept;

  /// Impulses from floor, tools and others, in all; a restart does not forget them.
  std::int64_t hits() const noexcept { return hits_; }

  /// The same masses at another moment: what they have there is `now`, where they had `before`.
  void shift(const Momenta& now, const Momenta& before) noexcept;

  MomentumBalance balance(const Momenta& now) const noexcept;

 private:
  Momenta booked_;
  Vec3 mass_moment_ = Vec3::Zero();
  double mass_ = 0;
  double linear_ = 0, angular_ = 0;
  std::int64_t hits_ = 0;
};

}  // namespace palpate::physics
