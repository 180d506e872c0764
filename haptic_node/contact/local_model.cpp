#include "haptic_node/contact/local_model.h"

#include "haptic_node/contact/raw_planes.h"

namespace palpate::haptic {

bool LocalModel::penetrated(const HandMotion& hand) const noexcept {
  switch (model_) {
    case ForceModel::norton:
      return planes_.penetrated(hand.x);
    case ForceModel::tangent:
      return tangent_.penetrated();
    case ForceModel::raw_planes:
      return raw_plane_force(patch_, hand, stiffness_, 0, limit_).n_planes > 0;
    case ForceModel::direct:
      return direct_force(wrench_, hand, stiffness_).n_planes > 0;
    case ForceModel::tissue:
      return tissue_.penetrated(hand.x);
  }
  return true;
}

ContactResult LocalModel::tick(const HandMotion& hand, double dt, double share, double gain) noexcept {
  switch (model_) {
    case ForceModel::norton:
      return planes_.tick(hand.x, hand.v, dt, share);
    case ForceModel::tangent:
      return tangent_.tick(hand, dt, share);
    case ForceModel::raw_planes:
      return raw_plane_force(patch_, hand, stiffness_, damping_, limit_);
    case ForceModel::direct:
      return direct_force(wrench_, hand, stiffness_);
    case ForceModel::tissue: {
      ContactResult felt;
      felt.force = tissue_.tick(hand.x, hand.q, gain);
      felt.torque = tissue_.torque(felt.force);
      // Both are shortened together: the work of one without the other would not be the copy's.
      if (const double turns = felt.torque.norm(); torque_limit_ > 0 && turns > torque_limit_)
        felt.force *= torque_limit_ / turns, felt.torque *= torque_limit_ / turns;
      felt.proxy = hand.x + felt.force / stiffness_;
      felt.stored = tissue_.touch().stored();
      felt.n_planes = felt.force.isZero() ? 0 : 1;
      return felt;
    }
  }
  return {};
}

}  // namespace palpate::haptic
