#pragma once
// The force on the hand as it is reported to physics: low-passed, so that the oscillation of soft tissue does
// not return as a force that drives it further. Physics low-passes once more, at 5 Hz; with that pole alone,
// a hand without friction on 0.5 kg of tissue swings by 0.3 mm for ever, and with this one at 5 Hz it settles
// late.
//
//   R := R + (1 - e^(-2 pi f dt)) (F - R)

#include <cmath>
#include <numbers>

#include "common/math/vec3.h"

namespace palpate::haptic {

class ForceReport {
 public:
  static constexpr double cutoff_Hz = 2.0;
  static constexpr double negligible = 1e-6;  // [N]; below this no force is no force

  const Vec3& pass(const Vec3& force, double dt) noexcept {
    reported_ += (1 - std::exp(-2 * std::numbers::pi * cutoff_Hz * dt)) * (force - reported_);
    if (force.isZero() && reported_.norm() < negligible) reported_.setZero();
    return reported_;
  }

 private:
  Vec3 reported_ = Vec3::Zero();
};

}  // namespace palpate::haptic
