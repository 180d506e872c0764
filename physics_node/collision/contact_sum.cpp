#include "physics_node/collision/contact_sum.h"

#include <Eigen/Geometry>

namespace palpate::physics {
namespace {

Eigen::Matrix3d cross_matrix(const Vec3& a) noexcept {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace

Mat6 lever(const Vec3& from_new) noexcept {
  Mat6 T = Mat6::Identity();
  T.bottomLeftCorner<3, 3>() = cross_matrix(from_new);
  return T;
}

void ContactSum::add(const Vec3& J, const Vec3& arm) noexcept {
  const double size = J.norm();
  if (!(size > 0)) return;
  Vec6 g;
  g << J, arm.cross(J);
  impulse += g;
  spread += (g / size) * g.transpose();
}

ContactSum ContactSum::about(const Vec3& from_new) const noexcept {
  const Mat6 T = lever(from_new);
  ContactSum sum;
  sum.impulse = T * impulse;
  sum.spread = T * spread * T.transpose();
  return sum;
}

}  // namespace palpate::physics
