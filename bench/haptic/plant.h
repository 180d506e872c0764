#pragma once
// A hand that holds a device, in steps of 20 us.
//
//   (m_h + m_d) x'' = k_h (q - x) + b_h (q' - x') - b_d x' + F + F_friction,    q(t) where the hand wants to be
//
// Coulomb friction acts on the velocity as a vector: what does not reach it sticks.

#include "bench/haptic/models.h"
#include "common/math/vec3.h"

namespace palpate::bench {

class Plant {
 public:
  static constexpr double step = 2e-5;  // [s]

  Plant(const DeviceModel& device, const HandSpring& hand, const Vec3& x) noexcept
      : device_(device), hand_(hand), x_(x) {}

  /// One step.
  /// @param q, q_dot  where the hand wants to be [m], and its velocity
  /// @param force     of the device on the handle, and any push from outside [N]
  void advance(const Vec3& q, const Vec3& q_dot, const Vec3& force) noexcept;

  /// What the encoders tell [m].
  Vec3 measured() const noexcept;
  const Vec3& x() const noexcept { return x_; }  // true position [m]
  const Vec3& v() const noexcept { return v_; }  // [m/s]
  /// For a kinematic hand: put where it is told.
  void put(const Vec3& x, const Vec3& v) noexcept { x_ = x, v_ = v; }

 private:
  DeviceModel device_;
  HandSpring hand_;
  Vec3 x_;
  Vec3 v_ = Vec3::Zero();
};

}  // namespace palpate::bench
