#include "haptic_node/tissue/tissue_touch.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {

TissueTouch::TissueTouch(const TouchSettings& settings) noexcept
    : settings_(settings),
      history_(settings.period),
      trust_(settings.period),
      leak_(settings.resolution, settings.period),
      guard_(settings.force_limit, settings.spring.stiffness, settings.period),
      spring_(settings.spring) {}

bool TissueTouch::take(const TissueAnswer& answer) noexcept {
  if (!history_.has(answer.stamp)) return false;
  if (touching() && !answer.model.same_counts(felt_.step.model())) return false;
  trust_.compare(answer.stamp, history_.newest(), answer.state.force);
  turn_to(history_.at(answer.stamp).q.conjugate() * answer.arm);
  shadow_.step = TissueStep(answer.model, spring_, settings_.period);
  shadow_.state = answer.state;
  answered_ = answer.state.force;
  shadow_at_ = answer.stamp;
  age_ = std::max(age_, settings_.period * static_cast<double>(history_.newest() - answer.stamp));
  while (shadow_at_ < history_.newest())
    shadow_.step.advance(shadow_.state, history_.at(++shadow_at_).point(arm_));
  return true;
}

/// Another point of the tool presses: the felt copy keeps the force that it has.
void TissueTouch::turn_to(const Vec3& arm) noexcept {
  felt_.state.rest += history_.at(history_.newest()).q * (arm - arm_);
  arm_ = arm;
}

/// Physics is told the spring as it is, so that in a ramp tissue bears what is felt.
void TissueTouch::scale(double gain) noexcept {
  spring_ = {gain * settings_.spring.stiffness, gain * settings_.spring.damping};
  felt_.step = TissueStep(felt_.step.model(), spring_, settings_.period);
  shadow_.step = TissueStep(shadow_.step.model(), spring_, settings_.period);
}

/// Tissue that is first known around a hand begins at the hand, at rest and without force, and comes out as fast as the
/// tank pays.
void TissueTouch::begin(const Vec3& x) noexcept {
  felt_ = shadow_;
  began_ = true;
  const TissueModel& model = felt_.step.model();
  if (pressed(model, felt_.state) <= 0 && depth_below(model, felt_.state, x) <= 0) return;
  felt_.state = {};
  felt_.state.rest = x;
}

/// Moves the tissue with the tip until its force is `keep` of what it was.
void TissueTouch::weaken(double keep, const Vec3& x) noexcept {
  const TissueModel& model = felt_.step.model();
  if (depth_below(model, felt_.state, x) > 0)
    felt_.state.rest += (1 - keep) * (x - modal_surface(model, felt_.state));
  felt_.state.force *= keep;
  for (double& f : felt_.state.f) f *= keep;
}

/// F on the hand, and along the normal clamp(1.5 h F', -f, f / 2) more, F' = K* (x' - y') of what does not flow: a force
/// that is held and late is worth its spring less a damper of that size, which gives energy; the command has it in
/// advance.
Vec3 TissueTouch::command(const Vec3& v) const noexcept {
  const TissueModel& model = felt_.step.model();
  const double in = pressed(model, felt_.state);
  const double speed = -model.normal.dot(v - modal_speed(model, felt_.state));
  const double late = hold * settings_.period * felt_.step.rising(felt_.state, speed);
  return -felt_.state.force + std::clamp(late, -in, ContactSpring::most_damping * in) * model.normal;
}

Vec3 TissueTouch::tick(const Vec3& tip, const Eigen::Quaterniond& q, double gain) noexcept {
  const HandleSample then = history_.newest() > 0 ? history_.at(history_.newest())
                                                  : HandleSample{{tip, Vec3::Zero()}, q, Vec3::Zero()};
  history_.add(tip, q);
  const HandleSample& now = history_.at(history_.newest());
  const TipSample point = now.point(arm_);
  const Vec3 before = then.point(arm_).x;
  const Vec3& x = point.x;
  if (gain <= 0)
    began_ = false, shadow_at_ = 0;
  else if (gain != gain_)
    scale(gain);
  if (shadow_at_ > 0) {
    shadow_.step.advance(shadow_.state, point), shadow_at_ = history_.newest();
    trust_.foretell(shadow_at_, shadow_.state.force, answered_);
  }

  StepWork work;
  double put_in = 0;
  if (shadow_at_ > 0 && (!began_ || !felt_.step.model().same_counts(shadow_.step.model()))) {
    begin(x);
  } else if (began_) {
    work = felt_.step.advance(felt_.state, before, point);
    if (gain > gain_) weaken(gain_ / gain, x);
    put_in = fade_.pass(felt_, shadow_, x, slew * settings_.period, tank_, age_, doubted());
  }
  gain_ = gain;
  age_ *= 1 - settings_.period / remembered;
  made_ -= std::min(0.0, work.dissipated);
  // The tank fills again after a rest in which nothing was put into the copy either.
  tank_.pass(settings_.period, touching() || put_in > 0);

  LeakStep step;
  // Without torques the hand pushes at the tip alone.
  step.way = settings_.torque ? Vec3(x - before) : Vec3(now.x - then.x);
  step.v = settings_.torque ? point.v : now.v;
  step.given = work.given, step.dissipated = work.dissipated;
  Vec3 wanted = Vec3::Zero(), force = Vec3::Zero();
  if (began_) {
    const HeldTissue held = felt_.step.held(felt_.state, x);
    step.speed = -felt_.step.model().normal.dot(point.v);
    step.force = felt_.state.force;
    step.spring_energy = held.spring_energy;
    step.whole_energy = held.energy;
    force = felt_.state.force;
    if (touching()) wanted = command(point.v);
  }
  share_ = leak_.share(step);
  felt_force_ = -share_ * force;
  given_ = guard_.pass(share_ * wanted, 1.0, false, (x - before).norm());
  leak_.sent(-given_);
  return given_;
}

void TissueTouch::sent(const Vec3& force) noexcept {
  leak_.correct(-force);
  const double whole = given_.squaredNorm();
  felt_force_ *= whole > 0 ? std::clamp(force.dot(given_) / whole, 0.0, 1.0) : 0.0;
  const double size = felt_force_.norm();
  if (size > settings_.force_limit) felt_force_ *= settings_.force_limit / size;
}

}  // namespace palpate::haptic
