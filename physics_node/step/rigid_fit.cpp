#include "physics_node/step/rigid_fit.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace palpate::physics {

void RigidFit::add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) noexcept {
  if (n_ == 0) from_ = from, to_ = to;
  // Why against the first: far from the origin, sums of products would lose what is asked for.
  const Eigen::Vector3d a = from - from_, b = to - to_;
  from_sum_ += a;
  to_sum_ += b;
  products_ += b * a.transpose();
  ++n_;
}

/// C = sum (to - middle)(from - middle)^T = U S V^T;  R = U diag(1, 1, det(U V^T)) V^T
void RigidFit::solve() noexcept {
  const Eigen::Matrix3d c = products_ - to_sum_ * from_sum_.transpose() / n_;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(c, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  rotation_ = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  from_ += from_sum_ / n_;
  to_ += to_sum_ / n_;
}

}  // namespace palpate::physics
