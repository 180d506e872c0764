#include "haptic_node/tissue/model_fade.h"

#include <algorithm>
#include <cmath>

#include "haptic_node/tissue/largest_share.h"

namespace palpate::haptic {
namespace {

constexpr int halvings = 16;  // beta to 1e-5 of its range

double between(double a, double b, double share) noexcept { return a + share * (b - a); }

bool same_parameters(const TissueModel& a, const TissueModel& b) noexcept {
  for (std::uint32_t i = 0; i < a.n_modes; ++i)
    if (a.modes[i].phi != b.modes[i].phi || a.modes[i].stiffness != b.modes[i].stiffness ||
        a.modes[i].damping != b.modes[i].damping)
      return false;
  for (std::uint32_t j = 0; j < a.n_branches; ++j)
    if (a.branches[j].stiffness != b.branches[j].stiffness || a.branches[j].time != b.branches[j].time)
      return false;
  return a.residual == b.residual;
}

TissueModel mixed(const TissueModel& a, const TissueModel& b, double beta) noexcept {
  TissueModel m = a;
  for (std::uint32_t i = 0; i < m.n_modes; ++i) {
    m.modes[i].phi = between(a.modes[i].phi, b.modes[i].phi, beta);
    m.modes[i].stiffness = between(a.modes[i].stiffness, b.modes[i].stiffness, beta);
    m.modes[i].damping = between(a.modes[i].damping, b.modes[i].damping, beta);
  }
  for (std::uint32_t j = 0; j < m.n_branches; ++j) {
    m.branches[j].stiffness = between(a.branches[j].stiffness, b.branches[j].stiffness, beta);
    m.branches[j].time = between(a.branches[j].time, b.branches[j].time, beta);
  }
  m.residual = between(a.residual, b.residual, beta);
  return m;
}

/// phi q and phi w are mixed, so that the surface moves straight from one to the other.
TissueState mixed(const TissueCopy& felt, const TissueCopy& shadow, const TissueModel& m,
                  double beta) noexcept {
  const TissueModel &a = felt.step.model(), &b = shadow.step.model();
  TissueState s = felt.state;
  for (std::uint32_t i = 0; i < m.n_modes; ++i) {
    const double from = a.modes[i].phi, to = b.modes[i].phi, phi = m.modes[i].phi;
    s.q[i] = between(from * felt.state.q[i], to * shadow.state.q[i], beta) / phi;
    s.w[i] = between(from * felt.state.w[i], to * shadow.state.w[i], beta) / phi;
  }
  for (std::uint32_t j = 0; j < m.n_branches; ++j) s.p[j] = between(felt.state.p[j], shadow.state.p[j], beta);
  s.rest = between(felt.state.rest, shadow.state.rest, beta);
  return s;
}

/// A mixture without its step, which is dear: what is asked of it is only energy and force.
struct Tried {
  TissueModel model;
  TissueState state;
  double energy, force;
};

Tried tried(const TissueCopy& felt, const TissueCopy& shadow, double x, double v, double before,
            double beta) noexcept {
  Tried t{mixed(felt.step.model(), shadow.step.model(), beta), {}, 0, 0};
  t.state = mixed(felt, shadow, t.model, beta);
  const ContactSpring& spring = felt.step.spring();
  const double e = x - modal_surface(t.model, t.state);
  t.energy = tissue_energy(t.model, t.state) + spring.energy(t.model.residual, e);
  t.force = spring.force(t.model.residual, felt.step.h(), e, v - modal_speed(t.model, t.state), before);
  return t;
}

}  // namespace

TissueCopy mixed(const TissueCopy& felt, const TissueCopy& shadow, double beta) noexcept {
  const TissueModel model = mixed(felt.step.model(), shadow.step.model(), beta);
  TissueCopy copy = felt;
  copy.state = mixed(felt, shadow, model, beta);
  if (!same_parameters(model, felt.step.model()))
    copy.step = TissueStep(model, felt.step.spring(), felt.step.h());
  return copy;
}

bool ModelFade::is_event(double felt, double shadow, double h) noexcept {
  quiet_for_ = shadow > felt + ripple_force ? 0.0 : quiet_for_ + h;
  const double below = felt - shadow;
  if (below > std::max(event_force, event_share * felt) && quiet_for_ >= ripple_rest) falling_ = true;
  if (below < event_over) falling_ = false;
  return falling_;
}

double ModelFade::pass(TissueCopy& felt, const TissueCopy& shadow, double x, double v, double before,
                       double force_step, WorkTank& tank) noexcept {
  const double h = felt.step.h(), force = felt.state.force, held = felt.step.energy(felt.state, x);
  const auto fits = [&](const Tried& t) {
    return t.energy - held <= tank.level() && std::abs(t.force - force) <= force_step;
  };
  double beta = -std::expm1(-h / slow);
  if (is_event(force, shadow.state.force, h)) {
    const double fast = -std::expm1(-h / quick);
    const Tried t = tried(felt, shadow, x, v, before, fast);
    if (t.energy <= held && t.force <= force) beta = fast;
  }
  Tried t = tried(felt, shadow, x, v, before, beta);
  if (!fits(t)) {
    beta = largest_share(beta, halvings,
                         [&](double share) { return fits(tried(felt, shadow, x, v, before, share)); });
    if (beta <= 0) return 0;
    t = tried(felt, shadow, x, v, before, beta);
  }
  felt = mixed(felt, shadow, beta);
  felt.state.force = t.force;
  tank.book(t.energy - held);
  return t.energy - held;
}

}  // namespace palpate::haptic
