#include "physics_node/contact/handle.h"

#include <algorithm>
#include <numeric>

namespace palpate::physics {

Vec6 motion(const Pose& from, const Pose& to) noexcept {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(to.q * from.q.conjugate()).normalized());
  Vec6 by;
  by << to.p - from.p, turn.angle() * turn.axis();
  return by;
}

Handle::Handle(const Body& body) : tip_(body.tip), cell_(body.handle) {
  for (const Index cell : cell_) {
    rest_.push_back(body.rest_position(cell));
    mass_.push_back(node_mass(body, cell));
  }
  all_.resize(cell_.size());
  std::iota(all_.begin(), all_.end(), 0U);
  pushes_.resize(cell_.size());
  for (auto* array : {&x_, &v_, &v_move_, &v_0_}) array->assign(cell_.size(), Vec3::Zero());
}

void Handle::note(const NodeMotion& moving) noexcept {
  moving.read(all_, cell_, rest_, 0, x_, v_, v_0_);
  noted_ = true;
}

HandleWork Handle::lead(NodeMotion& moving, const Pose& pose, double dt) noexcept {
  HandleWork sum;
  const Eigen::Matrix3d R = pose.q.toRotationMatrix();
  moving.read(all_, cell_, rest_, 0, x_, v_, v_move_);
  for (std::size_t n = 0; n < cell_.size(); ++n) {
    const Vec3 target = pose.p + R * (rest_[n] - tip_);
    const Vec3 dv = (target - x_[n]) / dt;  // on the velocity that moves the mass
    const Vec3 v = v_move_[n] + dv;
    pushes_[n] = {cell_[n], dv};
    const double m = mass_[n];
    sum.work += 0.5 * m * dv.dot(v + (noted_ ? v_0_[n] : v_move_[n]));
    sum.linear += m * dv;
    sum.angular += m * target.cross(dv);
  }
  moving.push(pushes_, dt);
  noted_ = false;
  return sum;
}

}  // namespace palpate::physics
