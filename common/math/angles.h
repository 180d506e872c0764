#pragma once
// Three angles and the rotation that they make.

#include <Eigen/Core>

namespace palpate {

/// Intrinsic rotations, first about z by theta[0], then about the new y by theta[1], then about the newest x by theta[2]:
///
///   R = Z(theta_0) Y(theta_1) X(theta_2)        [rad]
///
/// Columns of R are the turned axes in the world. Source: EQUATIONS C-16; the papers name the angles only.
Eigen::Matrix3d rotation_of_angles(const Eigen::Vector3d& theta);

/// The angles of a rotation, theta[1] within +-pi/2, the others within +-pi. At theta[1] = +-pi/2 only theta_0 -+ theta_2
/// counts; there theta_2 is 0.
Eigen::Vector3d angles_of_rotation(const Eigen::Matrix3d& R);

}  // namespace palpate
