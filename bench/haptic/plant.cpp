#include "bench/haptic/plant.h"

namespace palpate::bench {

void Plant::advance(const Vec3& q, const Vec3& q_dot, const Vec3& force) noexcept {
  const double m = device_.mass + hand_.mass;
  const Vec3 pull = hand_.stiffness * (q - x_) + hand_.damping * (q_dot - v_) - device_.damping * v_ + force;
  v_ += step / m * pull;
  const double speed = v_.norm();
  const double lost = step / m * device_.friction;
  if (speed <= lost)
    v_.setZero();
  else
    v_ *= (speed - lost) / speed;
  x_ += step * v_;
}

Vec3 Plant::measured() const noexcept {
  if (device_.resolution <= 0) return x_;
  return (x_ / device_.resolution).array().round().matrix() * device_.resolution;
}

}  // namespace palpate::bench
