#pragma once
// The last thing that a force passes on its way to a hand, whatever came before:
// finite, limited with its direction kept, no jump in a tick, faded.

#include <limits>

#include "common/math/vec3.h"

namespace palpate::haptic {

class ForceGuard {
 public:
  /// Fastest hand that the jump limit must not hinder [m/s]. Per tick the force may change by 2 K v T: less would
  /// lag behind a stiff contact and feed it energy.
  static constexpr double fastest_hand = 0.5;
  /// What the force may rise by in a tick although the hand stands: planes that move, dampers that begin [N].
  static constexpr double kick = 0.09;

  /// @param limit      most force [N]
  /// @param stiffness  of the hand spring, K [N/m]
  /// @param period     of ticks, T [s]
  ForceGuard(double limit, double stiffness, double period) noexcept
      : limit_(limit), stiffness_(stiffness), jump_(2.0 * stiffness * fastest_hand * period) {}

  /// @param wanted   may be anything, even not a number: that becomes no force
  /// @param gain     0..1; outside is taken as the nearer end, not a number as 0
  /// @param falling  true: the result is not larger than the last one (a fade)
  /// @param moved    way of the hand since the last tick: what a wall at rest answers to is never held back [m]
  Vec3 pass(const Vec3& wanted, double gain, bool falling,
            double moved = std::numeric_limits<double>::infinity()) noexcept;

  /// Forces go on from what was let through last, not from what it would have been without gain.
  void restart() noexcept { before_gain_ = last_; }

  const Vec3& last() const noexcept { return last_; }  // that was let through [N]
  double limit() const noexcept { return limit_; }
  double jump() const noexcept { return jump_; }  // most change in a tick, before the gain [N]

 private:
  double limit_;
  double stiffness_;
  double jump_;
  Vec3 before_gain_ = Vec3::Zero();
  Vec3 last_ = Vec3::Zero();
};

}  // namespace palpate::haptic
