#pragma once
// Impulses on something in a frame: their sum, their moment, and which springs in their place would look like.

#include "common/math/six.h"
#include "common/math/vec3.h"

namespace palpate::physics {

/// T that moves the point that moments are about: W' = T W, K' = T K T^T.
/// @param from_new  the old point seen from the new one [m]
Mat6 lever(const Vec3& from_new) noexcept;

/// About some point, world axes.
struct ContactSum {
  Vec6 impulse = Vec6::Zero();  // sum J_i g_i, g_i = (n_i, r_i x n_i) [N s], [N m s]
  Mat6 spread = Mat6::Zero();   // S = sum |J_i| g_i g_i^T
  /// Adds an impulse at an arm from the point.
  void add(const Vec3& J, const Vec3& arm) noexcept;
  /// The same about another point. @param from_new  where the old point is, seen from the new one
  ContactSum about(const Vec3& from_new) const noexcept;
};

}  // namespace palpate::physics
