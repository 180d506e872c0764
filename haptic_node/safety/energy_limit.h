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
// Position comes in steps of the encoder. A hand that makes one in n ticks is given work as if it had moved at once, with the
// force of two ticks ago: too much by (1 - 3 / n) / 2 of force change times step, the share being the autocorrelation of a saw
// tooth at one and two ticks. A hand that steps back trembles across a threshold, slower than its steps come.
// Source: Hannaford & Ryu 2002 (passivity observer). Deviation: forces shrink instead of a damper being added, which
// would be without bounds at rest.

#include <algorithm>
#include <array>

#include "common/math/vec3.h"
#include "haptic_node/contact/hand_motion.h"
#include "haptic_node/safety/step_pace.h"

namespace palpate::haptic {

class EnergyLimit {
 public:
  static constexpr double slack = 0.04e-3;   // [J]
  static constexpr double credit = 0.04e-3;  // most that dissipation is remembered [J]
  static constexpr double trembling = 30;    // ticks for a step's length, of a hand that trembles

  /// @param resolution  of the measured position, q [m]
  explicit EnergyLimit(double resolution) noexcept : resolution_(resolution) {}

  /// Once a tick, before the force of this tick is known.
  /// @param hand        forces of two ticks ago acted on its way here, or newer ones, which gives less
  /// @param period      until the next tick, T [s]
  /// @param stored      S, as it would be applied; 0 without contact [J]
  /// @param plane_work  E_plane since the start [J]
  /// @param force       of the springs, as it would be applied [N]
  /// @return what is left of the force, 0..1
  double share(const HandMotion& hand, double period, double stored, double plane_work,
               const Vec3& force) noexcept {
    const Vec6 moved = began_ ? motion_between(x_, q_, hand.x, hand.q) : Vec6(Vec6::Zero());
    given_ += forces_[1].dot(moved) - (plane_work - plane_work_);
    if (stored > 0) given_ += apparent_step_work(moved.head<3>(), force);
    began_ = true;
    x_ = hand.x;
    q_ = hand.q;
    plane_work_ = plane_work;
    given_ = std::max(given_, -credit - stored);
    if (stored <= 0) {
      given_ = std::min(given_, 0.5 * slack);
      left_ = 0;
      share_ = 1;
      pace_ = {};
      return 1.0;
    }
    // What is on its way to the motors will be given before this tick's force acts.
    const double on_its_way = coming_work(hand, moved, period);
    const double may_give = std::max(0.0, slack - given_ - on_its_way);
    left_ = std::min(stored, may_give);
    share_ = std::min(1.0, 2 * may_give / stored);
    return share_;
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
  /// To be added to what was given; mostly below 0 [J].
  double apparent_step_work(const Vec3& way, const Vec3& force) noexcept {
    const double size = force.norm();
    const double along = size > 0 ? force.dot(way) / size : 0.0;
    pace_.pass(std::abs(along) > 0.1 * resolution_ ? along : 0.0);
    if (std::abs(along) >= 1.5 * resolution_) return 0;  // several at once: fast
    const double n = pace_.turned() ? trembling : pace_.ticks();
    const double part = n >= 2 ? 1 - 3 / n : 0.0;
    return 0.5 * part * (share_ * force - forces_[1].head<3>()).dot(way);
  }

  /// Of the forces already sent, if the hand goes on as it does, no faster than its steps say; it turns as in the last tick [J].
  double coming_work(const HandMotion& hand, const Vec6& moved, double period) const noexcept {
    Vec6 coming = moved;
    coming.head<3>() = period * hand.v;
    const Vec6 sent = forces_[0] + forces_[1];
    double work = sent.head<3>().dot(coming.head<3>());
    if (pace_.ticks() > 1) work = std::min(work, sent.head<3>().norm() * pace_.way());
    return std::max(0.0, work + sent.tail<3>().dot(coming.tail<3>()));
  }

  double resolution_;
  bool began_ = false;
  Vec3 x_ = Vec3::Zero();
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  double plane_work_ = 0;
  StepPace pace_;
  double given_ = 0;  // E_port - E_plane, kept above -(credit + S) [J]
  double left_ = 0;
  double share_ = 1;                                        // of the last tick
  std::array<Vec6, 2> forces_{Vec6::Zero(), Vec6::Zero()};  // newest first
};

}  // namespace palpate::haptic
