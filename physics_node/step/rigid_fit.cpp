#include "physics_node/step/rigid_fit.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palpate::physics {

double rigid_fit_rms(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Matrix4d X = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd moved =
      (X.topLeftCorner<3, 3>() * from).colwise() + Eigen::Vector3d(X.topRightCorner<3, 1>());
  return std::sqrt((moved - to).squaredNorm() / static_cast<double>(from.cols()));
}

}  // namespace palpate::physics
