#include "haptic_node/control/controller.h"

#include <algorithm>

#include "common/time/clock.h"

namespace palpate::haptic {
namespace {

constexpr double torque_lever = 0.1;  // [m]: torques may change as fast as the force at its end

}  // namespace

const char* name_of(HapticState state) noexcept {
  switch (state) {
    case HapticState::off:
      return "off";
    case HapticState::open:
      return "open";
    case HapticState::calibrating:
      return "calibrating";
    case HapticState::ready:
      return "ready";
    case HapticState::armed:
      return "armed";
    case HapticState::run:
      return "run";
    case HapticState::stale:
      return "stale";
    case HapticState::safe:
      return "safe";
    case HapticState::fault:
      return "fault";
  }
  return "";
}

const char* text_of(ArmRefusal refusal) noexcept {
  switch (refusal) {
    case ArmRefusal::none:
      return "";
    case ArmRefusal::no_sample:
      return "the device has not answered yet";
    case ArmRefusal::not_calibrated:
      return "not calibrated";
    case ArmRefusal::not_held:
      return "nobody holds it";
    case ArmRefusal::no_patch:
      return "physics is silent";
    case ArmRefusal::inside:
      return "inside the tissue, move out";
    case ArmRefusal::moving:
      return "too fast, hold still";
  }
  return "";
}

Controller::Controller(const ControllerSettings& settings) noexcept
    : settings_(settings),
      motion_(settings.period),
      patches_(settings.tool),
      wrenches_(settings.tool),
      model_(settings.model, settings.stiffness, settings.damping, settings.force_limit,
             settings.torque_limit, settings.friction, settings.period, settings.resolution, settings.grip),
      guard_(settings.force_limit, settings.stiffness, settings.period),
      torque_guard_(settings.torque_limit, settings.stiffness * torque_lever * torque_lever, settings.period),
      energy_(settings.resolution) {}

/// Motors off at once; nothing is written to the device any more. @param first  none: it has happened before
ControllerOutput Controller::faulted(FaultCause first) noexcept {
  if (first != FaultCause::none) {
    ++faults_;
    fault_cause_ = first;
    state_ = HapticState::fault;
    felt_ = {};
    guard_.pass(Vec3::Zero(), 0, false);
    torque_guard_.pass(Vec3::Zero(), 0, false);
  }
  ControllerOutput out;
  out.proxy = motion_.x();
  out.write = false;
  out.stop_motors = first != FaultCause::none;
  return out;
}

void Controller::enter_safe(bool may_resume_inside) noexcept {
  if (state_ != HapticState::safe) {
    ++safe_events_;
    resume_inside_ = may_resume_inside;
    state_ = HapticState::safe;
  } else {
    resume_inside_ = resume_inside_ && may_resume_inside;
  }
  safe_for_ = 0;
}

void Controller::look_for_trouble(MotionVerdict verdict, const DeviceSample& sample, double dt) noexcept {
  const bool forcing = engaged() || state_ == HapticState::safe;
  // Who lets go feels nothing from this tick on. A device that dropped its force in a stall is not pushed anew.
  if (forcing && (!sample.held || (settings_.hold > 0 && dt > settings_.hold))) gain_ = 0;
  if (verdict == MotionVerdict::unsafe || (forcing && !sample.held))
    enter_safe(false);
  else if ((forcing && dt > stall) || (engaged() && !sample.powered))
    enter_safe(true);
}

ArmRefusal Controller::why_not(std::int64_t now_ns, const DeviceSample& sample) const noexcept {
  if (!motion_.ever()) return ArmRefusal::no_sample;
  if (!sample.calibrated) return ArmRefusal::not_calibrated;
  if (!sample.held) return ArmRefusal::not_held;
  if (freshness(now_ns) < 1.0) return ArmRefusal::no_patch;
  if (!resume_inside_ && model_.penetrated(motion_.hand())) return ArmRefusal::inside;
  if (state_ == HapticState::ready && motion_.v().norm() > arming_speed && !sample.powered)
    return ArmRefusal::moving;
  return ArmRefusal::none;
}

/// From outside the tissue the gain goes from 0 to 1 over arm_ramp. After a stall inside it the planes start at the hand and
/// move out by their own budget, and a second ramp would only add to that.
void Controller::step_ready(std::int64_t now_ns, const DeviceSample& sample) noexcept {
  gain_ = 0;
  refusal_ = why_not(now_ns, sample);
  state_ = refusal_ == ArmRefusal::none ? HapticState::armed : HapticState::ready;
  if (state_ == HapticState::ready || !sample.powered) return;
  model_.release();
  guard_.restart();
  torque_guard_.restart();
  gain_ = resume_inside_ ? 1 : 0;
  resume_inside_ = false;
  state_ = HapticState::run;
}

/// After arming the gain rises over arm_ramp; in contact only as fast as the plane's tank pays for dg S, S the energy of
/// the springs at full gain.
void Controller::step_run() noexcept {
  if (gain_ >= 1) return;
  double rise = std::min(1.0 - gain_, settings_.period / arm_ramp);
  if (full_ > 0) rise = model_.pay(rise * full_) / full_;
  gain_ += rise;
}

/// Patches that return during the fade find the planes moved back so far that the force goes on as faded; once it
/// has gone, only leaving the tissue brings it back.
void Controller::step_stale(std::int64_t now_ns, bool new_patch) noexcept {
  if (!new_patch) {
    gain_ = std::min(gain_, freshness(now_ns));
    return;
  }
  if (gain_ <= 0) {
    state_ = HapticState::ready;
    return;
  }
  model_.weaken(motion_.x(), gain_);
  guard_.restart();
  torque_guard_.restart();
  gain_ = 1;
  state_ = HapticState::run;
}

/// In nominal ticks: after a stall the ramp is not skipped.
void Controller::step_safe(std::int64_t now_ns, const DeviceSample& sample) noexcept {
  refusal_ = why_not(now_ns, sample);
  gain_ = std::max(0.0, gain_ - settings_.period / safe_ramp);
  safe_for_ += settings_.period;
  const double rest = resume_inside_ ? safe_ramp : safe_rest;
  if (gain_ <= 0 && safe_for_ >= rest) state_ = HapticState::ready;
}

void Controller::step_state(std::int64_t now_ns, const DeviceSample& sample, bool new_patch) noexcept {
  if (state_ == HapticState::run && freshness(now_ns) < 1.0) {
    state_ = HapticState::stale;
    ++stale_events_;
  }
  switch (state_) {
    case HapticState::ready:
    case HapticState::armed:
      step_ready(now_ns, sample);
      break;
    case HapticState::run:
      step_run();
      break;
    case HapticState::stale:
      step_stale(now_ns, new_patch);
      break;
    case HapticState::safe:
      step_safe(now_ns, sample);
      break;
    default:
      break;
  }
}

/// Way of the tip since the last tick, and of the end of a lever by which turning changes forces [m].
double Controller::hand_moved() noexcept {
  const HandMotion hand = motion_.hand();
  const Vec6 moved = motion_between(x_before_, q_before_, hand.x, hand.q);
  x_before_ = hand.x;
  q_before_ = hand.q;
  return moved.head<3>().norm() + torque_lever * moved.tail<3>().norm();
}

/// What the springs may push with. A force that ends at the limit stores S (2 r - r^2), r = limit / F.
double Controller::share_of_felt() noexcept {
  if (!model_.is_passive()) return 1;
  if (model_.limits_itself()) {
    stored_ = felt_.stored;
    return 1;
  }
  const double force = felt_.force.norm(), limit = guard_.limit();
  const double r = force > limit ? limit / force : 1.0;
  full_ = felt_.stored * (2 * r - r * r);
  const double applied = full_ * whole_gain();
  const double share =
      energy_.share(motion_.hand(), settings_.period, applied, model_.work(), whole_gain() * r * felt_.force);
  stored_ = energy_.left();
  return share;
}

/// @return whether there is a new one
bool Controller::take_answer(std::int64_t now_ns, const ContactPatch* patch,
                             const ToolWrench* wrench) noexcept {
  const bool new_patch = patches_.accept(patch, now_ns);
  if (new_patch) {
    model_.take(*patch, std::max(patches_.period(), settings_.period));
    contact_set_ = patch->contact_set;
  }
  if (!model_.needs_wrench()) return new_patch;
  const bool new_wrench = wrenches_.accept(wrench, now_ns);
  if (new_wrench) model_.take(*wrench, std::max(wrenches_.period(), settings_.period));
  return new_wrench;
}

ControllerOutput Controller::tick(std::int64_t now_ns, const DeviceSample& sample, const ContactPatch* patch,
                                  const ToolWrench* wrench) noexcept {
  if (state_ == HapticState::fault) return faulted(FaultCause::none);
  const double dt = ticked_ ? seconds_from_ns(now_ns - last_ns_) : settings_.period;
  last_ns_ = now_ns;
  ticked_ = true;

  // 1. the hand
  const MotionVerdict verdict = motion_.take(sample, now_ns);
  if (verdict == MotionVerdict::fault) return faulted(motion_.cause());
  look_for_trouble(verdict, sample, dt);

  // 2. the tissue
  const bool is_new = take_answer(now_ns, patch, wrench);

  // 3. what may be felt
  step_state(now_ns, sample, is_new);
  const bool feels = engaged() || (state_ == HapticState::safe && gain_ > 0);
  felt_ = {};
  if (feels)
    felt_ = model_.tick(motion_.hand(), std::min(dt, stall), reached_, whole_gain());
  else
    model_.rest(motion_.hand());
  if (felt_.outran) ++outran_;

  // 4. the force
  if (stopping_) stop_gain_ = std::max(0.0, stop_gain_ - settings_.period / safe_ramp);
  thermal_.step(sample.temperature, felt_.n_planes > 0 || felt_.force.norm() > 0, settings_.period);
  const bool fading = state_ != HapticState::run || stopping_;
  ControllerOutput out;
  const double share = share_of_felt();
  out.force =
      guard_.pass(share * felt_.force, model_.limits_itself() ? 1.0 : whole_gain(), fading, hand_moved());
  model_.sent(out.force);
  const double wanted = felt_.force.norm();
  reached_ = wanted > 0 ? std::min(1.0, out.force.norm() / wanted) : 1.0;
  if (settings_.torque_limit > 0)
    out.torque =
        torque_guard_.pass(share * felt_.torque, model_.limits_itself() ? 1.0 : whole_gain(), fading);
  energy_.sent(out.force, out.torque);
  out.reported = report_.pass(out.force, std::min(dt, stall));
  out.proxy = felt_.n_planes > 0 ? Vec3(motion_.x() + out.force / settings_.stiffness) : motion_.x();
  out.want_power = state_ == HapticState::armed;
  return out;
}

}  // namespace palpate::haptic
