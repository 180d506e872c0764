#include "haptic_node/tissue/tissue_touch.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {

TissueTouch::TissueTouch(const TouchSettings& settings) noexcept
    : settings_(settings),
      history_(settings.period),
      leak_(settings.resolution, settings.period),
      guard_(settings.force_limit, settings.spring.stiffness, settings.period) {}

bool TissueTouch::take(const TissueAnswer& answer) noexcept {
  if (!history_.has(answer.stamp)) return false;
  if (touching() && !answer.model.same_counts(felt_.step.model())) return false;
  shadow_.step = TissueStep(answer.model, settings_.spring, settings_.period);
  shadow_.state = answer.state;
  shadow_at_ = answer.stamp;
  while (shadow_at_ < history_.newest()) {
    const HandSample& hand = history_.at(++shadow_at_);
    shadow_.step.advance(shadow_.state, hand.x, hand.v);
  }
  return true;
}

/// Tissue that is first known around a hand begins at the hand, at rest and without force, and comes out as fast as the
/// tank pays.
void TissueTouch::begin(double x) noexcept {
  felt_ = shadow_;
  began_ = true;
  if (shadow_.state.force <= 0 && modal_surface(shadow_.step.model(), shadow_.state) >= x) return;
  felt_.state = {};
  felt_.state.rest = x;
  felt_.state.p.fill(x);
}

/// Moves the tissue back until its force is `keep` of what it was.
void TissueTouch::weaken(double keep, double x) noexcept {
  const double e = x - modal_surface(felt_.step.model(), felt_.state);
  felt_.state.rest += (1 - keep) * std::max(0.0, e);
  felt_.state.force *= keep;
}

/// F + clamp(K* 1.5 h (x' - y'), -F, F / 2): a force that is held and late is worth its spring less a damper of that size,
/// which gives energy; the command has it in advance.
double TissueTouch::command(double v) const noexcept {
  const TissueModel& model = felt_.step.model();
  const double F = felt_.state.force;
  const double late = settings_.spring.series(model.residual) * hold * settings_.period *
                      (v - modal_speed(model, felt_.state));
  return F + std::clamp(late, -F, ContactSpring::most_damping * F);
}

double TissueTouch::tick(double x, double gain) noexcept {
  const double x_before = history_.newest() > 0 ? history_.at(history_.newest()).x : x;
  history_.add(x);
  const HandSample hand = history_.at(history_.newest());
  const double way = hand.x - x_before;
  if (gain <= 0) began_ = false, shadow_at_ = 0;
  if (shadow_at_ > 0) shadow_.step.advance(shadow_.state, hand.x, hand.v), shadow_at_ = history_.newest();

  StepWork work;
  double put_in = 0;
  if (shadow_at_ > 0 && (!began_ || !felt_.step.model().same_counts(shadow_.step.model()))) {
    begin(hand.x);
  } else if (began_) {
    const double before = felt_.state.force;
    work = felt_.step.advance(felt_.state, x_before, hand.x, hand.v);
    if (gain > gain_) weaken(gain_ / gain, hand.x);
    put_in = fade_.pass(felt_, shadow_, hand.x, hand.v, before, slew * settings_.period, tank_);
  }
  gain_ = gain;
  made_ -= std::min(0.0, work.dissipated);
  // The tank fills again after a rest in which nothing was put into the copy either.
  tank_.pass(settings_.period, touching() || put_in > 0);

  const double F = began_ ? felt_.state.force : 0.0;
  LeakStep step = LeakStep::along(way, hand.v, work.given, work.dissipated, gain * F, 0, 0);
  if (began_) {
    step.spring_energy = felt_.step.spring_energy(felt_.state, hand.x);
    step.whole_energy = felt_.step.energy(felt_.state, hand.x);
  }
  share_ = leak_.share(step);
  felt_force_ = gain * share_ * F;
  const double wanted = F > 0 ? gain * share_ * command(hand.v) : 0.0;
  const double sent = guard_.pass(Vec3(0, 0, wanted), 1.0, false, std::abs(way)).z();
  leak_.sent(sent);
  return sent;
}

}  // namespace palpate::haptic
