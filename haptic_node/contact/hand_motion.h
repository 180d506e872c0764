#pragma once
// Where a hand holds a tool and how it moves, in the world.

#include <Eigen/Geometry>
#include <cmath>

#include "common/math/six.h"
#include "common/math/vec3.h"

namespace palpate::haptic {

struct HandMotion {
  Vec3 x = Vec3::Zero();                                  // tip [m]
  Vec3 v = Vec3::Zero();                                  // smoothed [m/s]
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  // attitude
};

/// The turn that leads from a to b, as axis times angle, angle within pi [rad], world axes.
inline Vec3 turn_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) noexcept {
  Eigen::Quaterniond by = b * a.conjugate();
  if (by.w() < 0) by.coeffs() = -by.coeffs();
  const double sine = by.vec().norm();
  if (sine < 1e-12) return 2 * by.vec();
  return 2 * std::atan2(sine, by.w()) / sine * by.vec();
}

inline Vec6 motion_between(const Vec3& x_a, const Eigen::Quaterniond& q_a, const Vec3& x_b,
                           const Eigen::Quaterniond& q_b) noexcept {
  Vec6 motion;
  motion << x_b - x_a, turn_between(q_a, q_b);
  return motion;
}

}  // namespace palpate::haptic
