#pragma once
// Keeps the rendered springs from giving more than was put into them. A spring whose force is held for a tick and comes
// a tick late gives K v^2 T (T/2 + T_io) too much each tick; a light handle that bounces collects that.
//
//   A = slack - (sum F_k . (x_{k+1} - x_k) + M_k . turn_k - E_plane)       what the springs may still give,  E_plane work of planes
//   F := F min(1, 2 A / S)                                  S the energy that they hold by their stretch
//
// While A >= S / 2 the springs are as they are; what was never put into them is missing at the end of the way out,
// where the force goes gently. Pressed in again they harden again. Each contact starts with at least half the slack, so
// that a surface never stays away.
// Source: Hannaford & Ryu 2002 (passivity observer). Deviation: forces shrink instead of a damper being added, which
// would be without bounds at rest.

#include <algorithm>
#include <array>

#include "common/scene/scene.h"
#include "haptic_node/contact/hand_motion.h"

namespace palpate::haptic {

class EnergyLimit {
 public:
  static constexpr double slack = 0.04e-3;   // [J]
  static constexpr double credit = 0.04e-3;  // most that dissipation is remembered [J]

  /// @param resolution  of the measured position, q [m]
  /// @param stiffness   of the hand spring, K [N/m]
  EnergyLimit(double resolution, double stiffness) noexcept
      : resolution_(resolution), stiffness_(stiffness) {}

  /// Once a tick, before the force of this tick is known.
  /// @param hand        forces of two ticks ago acted on its way here, or newer ones, which gives less
  /// @param period      until the next tick, T [s]
  /// @param stored      S, as it would be applied; 0 without contact [J]
  /// @param plane_work  E_plane since the start [J]
  /// @return what is left of the force, 0..1
  double share(const HandMotion& hand, double period, double stored, double plane_work) noexcept {
    const Vec6 moved = began_ ? motion_between(x_, q_, hand.x, hand.q) : Vec6(Vec6::Zero());
    const Vec3 way = moved.head<3>();
    given_ += forces_[1].dot(moved) - (plane_work - plane_work_);
    if (stored > 0 && way.norm() < 1.5 * resolution_)
      given_ -= 0.5 * stiffness_ * resolution_ * way.norm() * step_bias(speed_ * period / resolution_);
    speed_ = hand.v.norm();
    began_ = true;
    x_ = hand.x;
    q_ = hand.q;
    plane_work_ = plane_work;
    given_ = std::max(given_, -credit - stored);
    if (stored <= 0) {
      given_ = std::min(given_, 0.5 * slack);
      left_ = 0;
      return 1.0;
    }
    // What is on its way to the motors will be given before this tick's force acts.
    const double on_its_way = coming_work(hand, moved, period);
    const double may_give = std::max(0.0, slack - given_ - on_its_way);
    left_ = std::min(stored, may_give);
    return std::min(1.0, 2 * may_give / stored);
  }

  /// Of the stored energy, what may still be given [J].
  double left() const noexcept { return left_; }

  /// Force and torque that go to the device now.
  void sent(const Vec3& force, const Vec3& torque) noexcept {
    forces_[1] = forces_[0];
    forces_[0] << force, torque;
  }

  /// Given and still to be given, less what planes did and what was dissipated [J].
  double surplus() const noexcept { return given_ + left_; }

 private:
  /// A measured step q of a slow hand looks as if K q^2 / 2 had been made, on the way in and on the way out: the force of two ticks ago
  /// is that of before the step. A hand that makes r steps a tick feigns the share 1 - 3 r of that (autocorrelation of
  /// a saw tooth at one and two ticks) up to r = 1/2, and on the average over all speeds nothing. Deviation: below 1/3 all is taken off,
  /// as a share of less lets the springs of a light hand go by 0.3 N in a tick.
  static double step_bias(double r) noexcept { return r < 1.0 / 3 ? 1 : 0; }

  /// Of the forces already sent, if the hand goes on as it does; it turns as in the last tick [J].
  double coming_work(const HandMotion& hand, const Vec6& moved, double period) const noexcept {
    Vec6 coming = moved;
    coming.head<3>() = period * hand.v;
    return std::max(0.0, (forces_[0] + forces_[1]).dot(coming));
  }

  double resolution_;
  double stiffness_;
  bool began_ = false;
  Vec3 x_ = Vec3::Zero();
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  double plane_work_ = 0;
  double speed_ = 0;  // a tick ago: now a step has just been seen, and every hand looks fast [m/s]
  double given_ = 0;  // E_port - E_plane, kept above -(credit + S) [J]
  double left_ = 0;
  std::array<Vec6, 2> forces_{Vec6::Zero(), Vec6::Zero()};  // newest first
};

}  // namespace palpate::haptic
