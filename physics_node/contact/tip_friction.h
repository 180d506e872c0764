#pragma once
// Coulomb's friction of a massless tip that a hand leads by a spring, across the normal: a = hand + lag is where the tip lies. It is carried along by
// what it presses, and slides where the spring pulls by more than mu F_n:
//
//   lag := lag + way of the tissue - way of the hand,    T = -K lag, |T| <= mu F_n: beyond, lag := -T / K
//
// The way of the tissue is that at the end of the step, under T itself: with the way w that elements have taken it, and the mobility c = sum s^2 / m
// of the masses under the tip, T = -K (lag + w) / (1 + K dt^2 c). So light tissue needs no shorter steps (backward Euler, for contact alone).

#include "common/math/vec3.h"

namespace palpate::physics {

class TipFriction {
 public:
  explicit TipFriction(double coefficient) : mu_(coefficient) {}

  /// Before a press: the tip stays where it is while the hand goes on [m]. @param n  normal, unit
  void lead(const Vec3& hand, const Vec3& n) noexcept {
    if (mu_ <= 0) return;
    lag_ -= hand;
    lag_ -= lag_.dot(n) * n;
  }
  /// After it. @param tissue  w [m]  @param pressed  F_n [N]  @param mobility  c [1/kg]
  void pull(const Vec3& tissue, const Vec3& n, double stiffness, double pressed, double mobility,
            double dt) noexcept {
    if (mu_ <= 0 || stiffness <= 0) return release();
    lag_ += tissue - tissue.dot(n) * n;
    force_ = -stiffness / (1 + stiffness * dt * dt * mobility) * lag_;
    if (const double most = mu_ * pressed, size = force_.norm(); size > most) {
      force_ *= most / size;
      slid_ -= force_ / stiffness + lag_ + dt * dt * mobility * force_;
    }
    lag_ = -force_ / stiffness;
  }
  void release() noexcept { lag_ = force_ = slid_ = Vec3::Zero(); }

  const Vec3& lag() const noexcept { return lag_; }      // of the tip behind the hand [m]
  const Vec3& force() const noexcept { return force_; }  // T, on the tissue [N]
  /// By how far the tip has slid over the tissue since this was asked last [m].
  Vec3 take_slid() noexcept {
    const Vec3 slid = slid_;
    slid_.setZero();
    return slid;
  }
  bool sticks() const noexcept { return mu_ > 0; }

 private:
  double mu_;
  Vec3 lag_ = Vec3::Zero(), force_ = Vec3::Zero(), slid_ = Vec3::Zero();
};

}  // namespace palpate::physics
