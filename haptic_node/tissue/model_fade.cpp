#include "haptic_node/tissue/model_fade.h"

#include <algorithm>
#include <cmath>

#include "haptic_node/tissue/largest_share.h"

namespace palpate::haptic {
namespace {

constexpr int halvings = 16;          // beta to 1e-5 of its range
constexpr double least_turned = 0.1;  // of a mixed normal: beyond, the two look away from each other

template <class T>
T between(const T& a, const T& b, double share) noexcept {
  return a + share * (b - a);
}

bool same_parameters(const TissueModel& a, const TissueModel& b) noexcept {
  for (std::uint32_t i = 0; i < a.n_modes; ++i)
    if (a.modes[i].psi != b.modes[i].psi || a.modes[i].stiffness != b.modes[i].stiffness ||
        a.modes[i].damping != b.modes[i].damping)
      return false;
  for (std::uint32_t j = 0; j < a.n_branches; ++j)
    if (a.branches[j].stiffness != b.branches[j].stiffness || a.branches[j].time != b.branches[j].time ||
        a.branches[j].share != b.branches[j].share)
      return false;
  return a.normal == b.normal && a.friction == b.friction && a.residual == b.residual &&
         a.growth == b.growth && a.residual_across == b.residual_across;
}

TissueModel mixed(const TissueModel& a, const TissueModel& b, double beta) noexcept {
  TissueModel m = a;
  const Vec3 normal = between(a.normal, b.normal, beta);
  m.normal = normal.norm() > least_turned ? Vec3(normal.normalized()) : b.normal;
  m.friction = between(a.friction, b.friction, beta);
  for (std::uint32_t i = 0; i < m.n_modes; ++i) {
    m.modes[i].psi = between(a.modes[i].psi, b.modes[i].psi, beta);
    m.modes[i].stiffness = between(a.modes[i].stiffness, b.modes[i].stiffness, beta);
    m.modes[i].damping = between(a.modes[i].damping, b.modes[i].damping, beta);
  }
  for (std::uint32_t j = 0; j < m.n_branches; ++j) {
    m.branches[j].stiffness = between(a.branches[j].stiffness, b.branches[j].stiffness, beta);
    m.branches[j].time = between(a.branches[j].time, b.branches[j].time, beta);
    m.branches[j].share = between(a.branches[j].share, b.branches[j].share, beta);
  }
  m.residual = between(a.residual, b.residual, beta);
  m.growth = between(a.growth, b.growth, beta);
  m.residual_across = between(a.residual_across, b.residual_across, beta);
  return m;
}

/// The modal surface moves straight from one to the other: the rest follows from that.
TissueState mixed(const TissueCopy& felt, const TissueCopy& shadow, const TissueModel& m,
                  double beta) noexcept {
  TissueState s = felt.state;
  for (std::uint32_t i = 0; i < m.n_modes; ++i) {
    s.q[i] = between(felt.state.q[i], shadow.state.q[i], beta);
    s.w[i] = between(felt.state.w[i], shadow.state.w[i], beta);
  }
  for (std::uint32_t j = 0; j < m.n_branches; ++j) {
    s.p[j] = between(felt.state.p[j], shadow.state.p[j], beta);
    s.f[j] = between(felt.state.f[j], shadow.state.f[j], beta);
  }
  s.rest = between(modal_surface(felt.step.model(), felt.state),
                   modal_surface(shadow.step.model(), shadow.state), beta) -
           modal_way(m, s);
  return s;
}

/// A mixture without its step, which is dear: what is asked of it is only energy and force.
struct Tried {
  TissueModel model;
  TissueState state;
  HeldTissue held;
};

Tried tried(const TissueCopy& felt, const TissueCopy& shadow, const Vec3& x, double beta) noexcept {
  Tried t{mixed(felt.step.model(), shadow.step.model(), beta), {}, {}};
  t.state = mixed(felt, shadow, t.model, beta);
  t.held = held_tissue(t.model, t.state, felt.step.spring(), x);
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

/// The damper's part of F stays as it was: what is compared are the springs.
double ModelFade::pass(TissueCopy& felt, const TissueCopy& shadow, const Vec3& x, double force_step,
                       WorkTank& tank, double age, bool doubted) noexcept {
  const double h = felt.step.h();
  const HeldTissue before = felt.step.held(felt.state, x);
  const auto fits = [&](const Tried& t) {
    return t.held.energy - before.energy <= tank.level() &&
           (t.held.contact.force - before.contact.force).norm() <= force_step;
  };
  double beta = -std::expm1(-h / (doubted ? doubtful : std::clamp(over_age * age, least, slow)));
  const bool event =
      is_event(pressed(felt.step.model(), felt.state), pressed(shadow.step.model(), shadow.state), h);
  if (event && !doubted) {
    const double fast = -std::expm1(-h / quick);
    const Tried t = tried(felt, shadow, x, fast);
    if (t.held.energy <= before.energy &&
        t.held.contact.force.squaredNorm() <= before.contact.force.squaredNorm())
      beta = fast;
  }
  Tried t = tried(felt, shadow, x, beta);
  if (!fits(t)) {
    beta = largest_share(beta, halvings, [&](double share) { return fits(tried(felt, shadow, x, share)); });
    if (beta <= 0) return 0;
    t = tried(felt, shadow, x, beta);
  }
  const Vec3 force = felt.state.force;
  felt = mixed(felt, shadow, beta);
  const bool stays = before.contact.touching && t.held.contact.touching;
  felt.state.force = t.held.contact.force + (stays ? Vec3(force - before.contact.force) : Vec3(Vec3::Zero()));
  if (pressed(felt.step.model(), felt.state) <= 0) felt.state.force.setZero();
  tank.book(t.held.energy - before.energy);
  return t.held.energy - before.energy;
}

}  // namespace palpate::haptic
