#include "haptic_node/drivers/mouse/pointer_follower.h"

#include <cmath>

namespace palpate::haptic::mouse {

void PointerFollower::begin(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) noexcept {
  x_ = p;
  v_.setZero();
  q_ = q;
}

void PointerFollower::step(const Eigen::Vector3d& p, const Eigen::Quaterniond& q, double dt) noexcept {
  if (!(dt > 0)) return;
  // e = x - p, c = v + w e:   e(t) = (e + c t) exp(-w t),   v(t) = (v - w c t) exp(-w t)
  const double decay = std::exp(-corner * dt);
  const Eigen::Vector3d e = x_ - p;
  const Eigen::Vector3d c = v_ + corner * e;
  Eigen::Vector3d moved = (e + dt * c) * decay + p - x_;
  v_ = (v_ - corner * dt * c) * decay;
  if (const double speed = v_.norm(); speed > most_speed_) v_ *= most_speed_ / speed;
  if (const double way = moved.norm(); way > most_speed_ * dt) moved *= most_speed_ * dt / way;
  x_ += moved;
  q_ = q_.slerp(1 - decay, q).normalized();
}

}  // namespace palpate::haptic::mouse
