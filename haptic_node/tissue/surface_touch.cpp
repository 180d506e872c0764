#include "haptic_node/tissue/surface_touch.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {
namespace {

bool same_modes(const SurfaceModel& a, const SurfaceModel& b) noexcept {
  if (a.n_modes != b.n_modes) return false;
  for (std::uint32_t i = 0; i < a.n_modes; ++i)
    if (a.modes[i].stiffness != b.modes[i].stiffness || a.modes[i].damping != b.modes[i].damping)
      return false;
  return true;
}

}  // namespace

SurfaceTouch::SurfaceTouch(const TouchSettings& settings) noexcept
    : settings_(settings),
      history_(settings.period),
      step_(model_, settings.spring, settings.period),
      leak_(settings.resolution, settings.period),
      guard_(settings.force_limit, settings.spring.stiffness, settings.period) {}

bool SurfaceTouch::take(const SurfaceAnswer& answer) noexcept {
  if (!history_.has(answer.stamp)) return false;
  const bool same = same_modes(answer.model, model_);
  if (touching() && !same) return false;
  model_ = answer.model;
  if (!same) step_ = SurfaceStep(model_, settings_.spring, settings_.period), began_ = false;
  shadow_ = answer.state;
  shadow_at_ = answer.stamp;
  while (shadow_at_ < history_.newest()) step_.advance(model_, shadow_, history_.at(++shadow_at_));
  return true;
}

/// Tissue that is first known around a tip begins at the tip, at rest and without force.
void SurfaceTouch::begin(const TipSample& tip) noexcept {
  felt_ = shadow_;
  began_ = true;
  const HeldSurface held = held_surface(model_, felt_, settings_.spring, tip.x);
  if (!held.contact.touching && felt_.force.squaredNorm() == 0) return;
  felt_.q.fill(0), felt_.w.fill(0);
  felt_.force.setZero();
  felt_.rest.setZero();
  felt_.rest = tip.x - held_surface(model_, felt_, settings_.spring, tip.x).point.modal;
}

/// Moves the tissue with the tip until its force is `keep` of what it was.
void SurfaceTouch::weaken(double keep, const Vec3& x) noexcept {
  const HeldSurface held = held_surface(model_, felt_, settings_.spring, x);
  if (held.contact.touching) felt_.rest += (1 - keep) * (x - held.point.modal);
  felt_.force *= keep;
}

/// F - n clamp(K* 1.5 h n . (y' - v), -f, f / 2): what pays the hold, as in tissue_touch.h, along the normal.
Vec3 SurfaceTouch::command(const HeldSurface& held, const Vec3& v) const noexcept {
  const Vec3& n = held.point.normal;
  const double pressed = std::max(0.0, -n.dot(felt_.force));
  Vec3 speed = -v;
  for (std::uint32_t i = 0; i < model_.n_modes; ++i) speed += felt_.w[i] * held.point.psi[i];
  const double series = 1 / (1 / settings_.spring.stiffness + n.dot(held.point.residual * n));
  const double late = series * TissueTouch::hold * settings_.period * n.dot(speed);
  return felt_.force - std::clamp(late, -pressed, ContactSpring::most_damping * pressed) * n;
}

Vec3 SurfaceTouch::tick(const Vec3& x, double gain) noexcept {
  const Vec3 before = history_.newest() > 0 ? history_.at(history_.newest()).x : x;
  history_.add(x);
  const TipSample tip = history_.at(history_.newest());
  if (gain <= 0) began_ = false, shadow_at_ = 0;
  if (shadow_at_ > 0) step_.advance(model_, shadow_, tip), shadow_at_ = history_.newest();

  StepWork work;
  double put_in = 0;
  if (shadow_at_ > 0 && !began_) {
    begin(tip);
  } else if (began_) {
    work = step_.advance(model_, felt_, before, tip);
    if (gain > gain_) weaken(gain_ / gain, tip.x);
    put_in =
        SurfaceFade::pass(model_, step_, felt_, shadow_, tip.x, TissueTouch::slew * settings_.period, tank_);
  }
  gain_ = gain;
  made_ -= std::min(0.0, work.dissipated);
  tank_.pass(settings_.period, touching() || put_in > 0);

  LeakStep step;
  step.way = tip.x - before;
  step.v = tip.v;
  step.given = work.given, step.dissipated = work.dissipated;
  Vec3 wanted = Vec3::Zero();
  if (began_) {
    const HeldSurface held = held_surface(model_, felt_, settings_.spring, tip.x);
    step.speed = -held.point.normal.dot(tip.v);
    step.force = gain * felt_.force;
    step.spring_energy = held.spring_energy;
    step.whole_energy = held.energy;
    if (touching()) wanted = command(held, tip.v);
  }
  share_ = leak_.share(step);
  felt_force_ = began_ ? Vec3(gain * share_ * felt_.force) : Vec3(Vec3::Zero());
  const Vec3 sent = guard_.pass(gain * share_ * wanted, 1.0, false, step.way.norm());
  leak_.sent(sent);
  return sent;
}

}  // namespace palpate::haptic
