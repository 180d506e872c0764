#pragma once
// What a hand feels of tissue that physics computes elsewhere. Physics presses its tissue by the hand's recorded motion through the spring and
// damper that the hand feels; the hand runs a copy of the tissue, reduced to some modes, which it presses by the same motion now. At an answer
// the shadow takes over model and state of the real tissue and replays the hand's own motion since; what is felt fades towards it. So the delay
// is not felt: only what the model does not know is late.
//
//   history of the hand --> physics --> answer of sample s --> shadow: replay s..n --fade, paid by the tank--> felt --> force
//
// Source: Smith 1957 (predictor). Deviation: the model's state is taken over whole instead of being compared with what comes.

#include <cstdint>

#include "haptic_node/safety/force_guard.h"
#include "haptic_node/safety/leak_limit.h"
#include "haptic_node/tissue/model_fade.h"
#include "haptic_node/tissue/model_trust.h"
#include "haptic_node/tissue/motion_history.h"

namespace palpate::haptic {

struct TouchSettings {
  ContactSpring spring;
  double period = 1e-3;    // [s]
  double force_limit = 3;  // [N]
  double resolution = 0;   // of a sample [m]
  bool torque = false;     // reaches the hand: turning it against the tissue is work
};

class TissueTouch {
 public:
  static constexpr double slew = 80.0;  // of F by corrections [N/s]
  /// A force acts from one to two ticks after its sample: 1.5 ticks later in the mean.
  static constexpr double hold = 1.5;        // [ticks]
  static constexpr double remembered = 0.5;  // of late answers [s]

  explicit TissueTouch(const TouchSettings& settings) noexcept;

  /// An answer that is_sound() and newer than the last. Before the next tick().
  /// @return false if it is of no use: of a sample that is forgotten or to come, or of another count of modes while
  ///         the hand touches
  bool take(const TissueAnswer& answer) noexcept;

  /// One tick. Contract: real time.
  /// @param x, q  tip of the hand, and how the handle lies [m]
  /// @param gain  what silence, arming and the like leave of spring and damper, 0..1; 0 forgets the tissue until the next answer,
  ///              and what rises again in contact is paid by the tank
  /// @return force on the hand, its hold paid [N]
  Vec3 tick(const Vec3& x, const Eigen::Quaterniond& q, double gain) noexcept;
  Vec3 tick(const Vec3& x, double gain) noexcept { return tick(x, Eigen::Quaterniond::Identity(), gain); }
  /// What the device really gets of what tick() returned [N]. After each tick(), where it may be less.
  void sent(const Vec3& force) noexcept;

  const TipHistory& history() const noexcept { return history_; }
  /// From the tip to the point that presses, now [m].
  Vec3 arm() const noexcept { return history_.newest() > 0 ? history_.at(history_.newest()).q * arm_ : arm_; }
  /// Force on the hand of the newest sample: of what is sent without what it leads by, which pays for the way to the motors [N].
  const Vec3& felt() const noexcept { return felt_force_; }
  bool touching() const noexcept { return began_ && felt_.state.force.squaredNorm() > 0; }
  /// Of the felt copy's energy, what may still be given [J].
  double stored() const noexcept { return leak_.left(); }
  /// Of corrections on the copy since the start [J].
  double correction_work() const noexcept { return tank_.booked(); }
  double share() const noexcept { return share_; }
  /// What the copy believes that the hand has not given, L [J].
  double leak() const noexcept { return leak_.leak(); }
  /// Energy that steps of the copy have made by themselves, sum of -min(0, D) since the start [J].
  double made() const noexcept { return made_; }
  /// Does its copy foretell something else than tissue does?
  bool doubted() const noexcept { return trust_.doubted(history_.newest()); }
  bool knows_shadow() const noexcept { return shadow_at_ > 0; }
  const TissueCopy& felt_copy() const noexcept { return felt_; }
  const TissueCopy& shadow_copy() const noexcept { return shadow_; }

 private:
  void turn_to(const Vec3& arm) noexcept;
  void scale(double gain) noexcept;
  void begin(const Vec3& x) noexcept;
  void weaken(double keep, const Vec3& x) noexcept;
  Vec3 command(const Vec3& v) const noexcept;

  TouchSettings settings_;
  TipHistory history_;
  Vec3 arm_ = Vec3::Zero();  // in the frame of the handle
  TissueCopy felt_, shadow_;
  ModelFade fade_;
  ModelTrust trust_;
  Vec3 answered_ = Vec3::Zero();  // F of the last answer [N]
  WorkTank tank_;
  LeakLimit leak_;
  ForceGuard guard_;
  bool began_ = false;
  std::uint64_t shadow_at_ = 0;  // the sample that the shadow has been brought to; 0: no shadow
  double gain_ = 0;              // of the last tick
  ContactSpring spring_;         // what that left of it
  Vec3 given_ = Vec3::Zero(), felt_force_ = Vec3::Zero();
  double share_ = 1, made_ = 0;
  double age_ = 0;  // of answers, the most that is remembered [s]
};

}  // namespace palpate::haptic
