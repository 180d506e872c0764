#pragma once
// A handle that follows a pointer. Pointers come a few times a second and jump; a hand does neither, so the handle is
// drawn along by a critically damped spring, never faster than a limit:
//
//   x'' = w^2 (p - x) - 2 w x',   |x'| <= v_most        attitude: the rest of the way shrinks by exp(-w dt)
//
// The step is exact for a pointer at rest. Source: the closed form of the critically damped oscillator; w is our choice.

#include <Eigen/Geometry>

namespace palpate::haptic::mouse {

class PointerFollower {
 public:
  static constexpr double corner = 50.0;  // w [1/s]: 99 % of the way in 0.13 s

  /// @param most_speed  v_most [m/s]
  explicit PointerFollower(double most_speed) : most_speed_(most_speed) {}

  /// Lets go of all motion and stands at p.
  void begin(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) noexcept;
  /// Contract: real time. @param dt  [s]
  void step(const Eigen::Vector3d& p, const Eigen::Quaterniond& q, double dt) noexcept;

  const Eigen::Vector3d& x() const noexcept { return x_; }  // [m]
  const Eigen::Vector3d& v() const noexcept { return v_; }  // [m/s]
  const Eigen::Quaterniond& q() const noexcept { return q_; }

 private:
  double most_speed_;
  Eigen::Vector3d x_ = Eigen::Vector3d::Zero(), v_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
};

}  // namespace palpate::haptic::mouse
