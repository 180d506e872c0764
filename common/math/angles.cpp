#include "common/math/angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpate {

Eigen::Matrix3d rotation_of_angles(const Eigen::Vector3d& theta) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  if (theta.isZero(0)) return Eigen::Matrix3d::Identity();  // to the bit
  return (AngleAxisd(theta[0], Vector3d::UnitZ()) * AngleAxisd(theta[1], Vector3d::UnitY()) *
          AngleAxisd(theta[2], Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d angles_of_rotation(const Eigen::Matrix3d& R) {
  // R = [ c0 c1   .       .     ]
  //     [ s0 c1   .       .     ]
  //     [ -s1     c1 s2   c1 c2 ]
  const double c1 = std::hypot(R(0, 0), R(1, 0));
  const double theta_1 = std::atan2(-R(2, 0), c1);
  constexpr double upright = 1e-9;
  if (c1 < upright) return {std::atan2(-R(0, 1), R(1, 1)), theta_1, 0};
  return {std::atan2(R(1, 0), R(0, 0)), theta_1, std::atan2(R(2, 1), R(2, 2))};
}

}  // namespace palpate
