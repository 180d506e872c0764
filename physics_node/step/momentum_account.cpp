#include "physics_node/step/momentum_account.h"

#include <Eigen/Geometry>

namespace palpate::physics {

void MomentumAccount::restart(const Start& start) noexcept {
  booked_ = start.momenta;
  mass_moment_ = start.mass_moment;
  mass_ = start.mass;
  linear_ = start.linear;
  angular_ = start.angular;
}

void MomentumAccount::step(const Vec3& gravity, double kick, double dt) noexcept {
  const Vec3 impulse = mass_ * kick * gravity;
  const Vec3 moment = kick * mass_moment_.cross(gravity);
  booked_.linear += impulse;
  booked_.angular += moment;
  linear_ += impulse.norm();
  angular_ += moment.norm();
  mass_moment_ += dt * booked_.linear;
}

void MomentumAccount::hit(const Vec3& impulse, const Vec3& x) noexcept {
  const Vec3 moment = x.cross(impulse);
  booked_.linear += impulse;
  booked_.angular += moment;
  linear_ += impulse.norm();
  angular_ += moment.norm();
  ++hits_;
}

void MomentumAccount::push(const Vec3& impulse, const Vec3& x, double dt) noexcept {
  hit(impulse, x);
  mass_moment_ += dt * impulse;
}

void MomentumAccount::shift(const Momenta& now, const Momenta& before) noexcept {
  booked_.linear += now.linear - before.linear;
  booked_.angular += now.angular - before.angular;
}

MomentumBalance MomentumAccount::balance(const Momenta& now) const noexcept {
  return {{now.linear - booked_.linear, now.angular - booked_.angular}, linear_, angular_};
}

}  // namespace palpate::physics
