#pragma once
// Keeps a copy of tissue from giving what was not put into it. The hand works against forces that come two ticks late and are
// held; the copy is worked by the motion at once, and gives part of it away in its dampers. What it believes beyond what the
// hand has really given is the leak
//
//   L := max(-credit, L + (W - F_sent . dx) - D)       W work on the copy, D what the copy has dissipated of it, not below 0
//   share = min(1, 2 (S + slack - L - coming) / S)   of the force;  coming: by forces on their way, if the hand goes on
//
// S is the energy of the copy, H. On the way out it is that of the contact spring alone: tissue keeps energy after the tip has
// left, and half of that would never be missed. The other way round, with the spring alone always, a handle falls through soft
// tissue for ever. Without contact L is at most half the slack and what the copy still swings with: a surface never stays away
// for longer than that, and what a device at its limit did not take in is not forgotten while the copy has it.
// Steps of the encoder count as in energy_limit.h.
// Source: Hannaford & Ryu 2002 (passivity observer). Deviation: forces shrink instead of a damper being added; the copy's own
// dissipation is told to the observer, which otherwise holds back the force of all tissue that is viscous.

#include <algorithm>
#include <array>
#include <cmath>

#include "common/math/vec3.h"
#include "haptic_node/safety/energy_limit.h"
#include "haptic_node/safety/step_pace.h"

namespace palpate::haptic {

/// One tick; forces are those on the tissue.
struct LeakStep {
  Vec3 way = Vec3::Zero();    // of the hand since the last tick [m]
  Vec3 v = Vec3::Zero();      // of the hand, smoothed [m/s]
  double speed = 0;           // of it, into the tissue [m/s]
  double given = 0;           // W [J]
  double dissipated = 0;      // D [J]
  Vec3 force = Vec3::Zero();  // of the copy, as it would be applied [N]
  double spring_energy = 0;   // of the contact spring [J]
  double whole_energy = 0;    // H [J]

  /// Of tissue in one dimension, along z; all count into it.
  static LeakStep along(double way, double speed, double given, double dissipated, double force,
                        double spring_energy, double whole_energy) noexcept {
    return {Vec3(0, 0, way), Vec3(0, 0, speed), speed,         given,
            dissipated,      Vec3(0, 0, force), spring_energy, whole_energy};
  }
};

class LeakLimit {
 public:
  static constexpr double slack = EnergyLimit::slack, credit = EnergyLimit::credit;
  static constexpr double outward = 1e-3;  // speed beyond which the hand is on its way out [m/s]

  /// @param resolution  of the measured position [m]
  /// @param period      of ticks [s]
  LeakLimit(double resolution, double period) noexcept : resolution_(resolution), period_(period) {}

  /// Once a tick, before the force of this tick is known. @return what is left of the force, 0..1
  double share(const LeakStep& step) noexcept {
    leak_ += step.given - sent_[1].dot(step.way) - std::max(0.0, step.dissipated);
    const bool touching = step.force.squaredNorm() > 0;
    if (touching) leak_ += apparent_step_work(step);
    leak_ = std::max(leak_, -credit);
    if (!touching) {
      leak_ = std::min(leak_, 0.5 * slack + step.whole_energy);
      pace_ = {};
      left_ = 0;
      return share_ = 1;
    }
    const double S = step.speed < -outward ? step.spring_energy : step.whole_energy;
    const double lacks = leak_ + coming_work(step.v) - slack;
    left_ = std::clamp(step.whole_energy - lacks, 0.0, step.whole_energy);
    return share_ = S > 0 ? std::clamp(2 * (S - lacks) / S, 0.0, 1.0) : 1.0;
  }

  /// The force that goes to the device now [N].
  void sent(const Vec3& force) noexcept {
    sent_[1] = sent_[0];
    sent_[0] = force;
  }

  /// It was less than sent() had it [N].
  void correct(const Vec3& force) noexcept { sent_[0] = force; }

  void sent(double force_along) noexcept { sent(Vec3(0, 0, force_along)); }

  /// Of H, what may still be given [J].
  double left() const noexcept { return left_; }
  double leak() const noexcept { return leak_; }  // L [J]

 private:
  /// A hand that steps by the encoder is given work as if it had moved at once: energy_limit.h.
  double apparent_step_work(const LeakStep& step) noexcept {
    const double along = step.way.dot(step.force) / step.force.norm();
    pace_.pass(std::abs(along) > 0.1 * resolution_ ? along : 0.0);
    if (std::abs(along) >= 1.5 * resolution_) return 0;
    const double n = pace_.turned() ? EnergyLimit::trembling : pace_.ticks();
    const double part = n >= 2 ? 1 - 3 / n : 0.0;
    return 0.5 * part * (sent_[1] - share_ * step.force).dot(step.way);
  }

  double coming_work(const Vec3& v) const noexcept {
    const Vec3 sent = sent_[0] + sent_[1];
    double work = -period_ * sent.dot(v);
    if (pace_.ticks() > 1) work = std::min(work, sent.norm() * pace_.way());
    return std::max(0.0, work);
  }

  double resolution_;
  double period_;
  StepPace pace_;
  double leak_ = 0;
  double left_ = 0;
  double share_ = 1;  // of the last tick
  std::array<Vec3, 2> sent_{Vec3::Zero(), Vec3::Zero()};
};

}  // namespace palpate::haptic
