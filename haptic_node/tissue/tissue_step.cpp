#include "haptic_node/tissue/tissue_step.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {
namespace {

// Why: each squares the error, and two are enough in most ticks; at a first touch they begin far below.
constexpr int newton_steps = 8;
constexpr double newton_force = 1e-10;  // that the next one would change F by at most [N]

/// Newton's steps. @param solve  with the tangent of the law at a force: the contact @param from  F to begin with [N]
template <class Solve>
FrictionContact solve_growing(const FlowingContact& law, const Vec3& n, double from,
                              const Solve& solve) noexcept {
  FrictionContact contact;
  for (int i = 0; i < newton_steps; ++i) {
    contact = solve(law.tangent(from));
    const double next = std::max(0.0, -n.dot(contact.force));
    const bool over = law.is_enough(from, next, newton_force);
    from = next;
    if (over) break;
  }
  return contact;
}

/// In contact and branches, where F acts now: with U the integral of F dz, U(F_e) and for each branch
/// g (U(F_e) - U(f) - f (z(F_e) - z(f))), which is at least 0 and loses what it is not given; of a law that is linear
/// g R (F_e - f)^2 / 2.
double contact_energy(const TissueModel& model, const TissueState& state, double F) noexcept {
  const GrowingContact law = model.contact();
  const double stays = staying(model, state, F), stored = law.energy(stays);
  double energy = stored;
  for (std::uint32_t j = 0; j < model.n_branches; ++j)
    if (const double g = model.branches[j].share; g > 0) {
      const double f = state.f[j];
      energy += g * std::max(0.0, stored - law.energy(f) - f * (law.give(stays) - law.give(f)));
    }
  return energy;
}

}  // namespace

TissueStep::TissueStep(const TissueModel& model, const ContactSpring& spring, double h) noexcept
    : model_(model), spring_(spring), h_(h) {
  const Vec3& n = model.normal;
  Mat3 D = Mat3::Zero(), E = Mat3::Zero();
  for (std::uint32_t i = 0; i < model.n_modes; ++i) {
    const Vec3& psi = model.modes[i].psi;
    modes_[i] = mode_response(model.modes[i].stiffness, model.modes[i].damping, h);
    D += modes_[i].c1 * psi * psi.transpose();
    E += modes_[i].d1 * psi * psi.transpose();
  }
  double flowing = 1;
  for (std::uint32_t j = 0; j < model.n_branches; ++j) {
    branches_[j] = LagStep::over(h, model.branches[j].time);
    relaxing_ += model.branches[j].stiffness * branches_[j].mean;
    flowing += model.branches[j].share * branches_[j].mean;
  }
  flowing_ = 1 / flowing;
  pushed_ = D * n;
  sped_ = E * n;
  held_ = 1 / (1 + relaxing_ * n.dot(pushed_));
  // F_r+ = held (relaxing (d_f - D n . F+) - lag)
  D -= held_ * relaxing_ * pushed_ * pushed_.transpose();
  E -= held_ * relaxing_ * sped_ * pushed_.transpose();
  const double K = spring.stiffness;
  const Mat3 R = model.compliance(flowing_), still = Mat3::Identity() / K + R;
  compliance_ = still + D + spring.damping / K * n * (n.transpose() * (R / h + E));
  inverse_ = compliance_.inverse();
  bound_ = still / (1 + ContactSpring::most_damping) + D;
}

FrictionContact TissueStep::press(const Loose& loose, const FlowingContact& law) const noexcept {
  const Vec3& n = model_.normal;
  const double damper = spring_.damping / spring_.stiffness, lags = law.give(0);
  const Vec3 e = loose.stretch + (damper * (loose.late + lags / h_) + lags) * n;
  FrictionContact contact = solve_contact(compliance_, inverse_, e, n, model_.friction);
  const double in = -n.dot(contact.force);
  if (in <= 0) return contact;
  const Vec3 along = contact.force / in;
  const double most = (n.dot(loose.stretch) + lags) / n.dot(bound_ * along);
  if (most > 0 && most < in) contact.force = most * along;
  return contact;
}

FrictionContact TissueStep::press_growing(const Loose& loose, const FlowingContact& law,
                                          double before) const noexcept {
  const Vec3& n = model_.normal;
  const double damper = spring_.damping / spring_.stiffness, twice = 1 + damper / h_;
  const double gives = law.share * law.law.compliance;  // of the linear part
  const Vec3 left = n.transpose() * inverse_, right = inverse_ * n;
  FrictionContact contact = solve_growing(law, n, before, [&](const GrowingContact::Tangent& z) {
    const double less = twice * (z.slope - gives);
    const Mat3 C = compliance_ + less * n * n.transpose();
    const Mat3 inverse = inverse_ - less / (1 + less * n.dot(right)) * right * left.transpose();
    const Vec3 e = loose.stretch + (damper * loose.late + twice * z.offset) * n;
    return solve_contact(C, inverse, e, n, model_.friction);
  });
  const double in = -n.dot(contact.force);
  if (in <= 0) return contact;
  // (F / (3/2)) / K + z(F / (3/2)) + D F below the surface
  constexpr double share = 1 / (1 + ContactSpring::most_damping);
  const Vec3 along = contact.force / in;
  double most = in;
  for (int i = 0; i < newton_steps; ++i) {
    const GrowingContact::Tangent z = law.tangent(share * most);
    const double give = n.dot(bound_ * along) - share * (z.slope - gives);
    const double next = std::max(0.0, (n.dot(loose.stretch) + z.offset) / give);
    const bool over = law.is_enough(share * most, share * next, newton_force) || (i == 0 && next >= in);
    most = next;
    if (over) break;
  }
  if (most < in) contact.force = most * along;
  return contact;
}

void TissueStep::advance(TissueState& state, const TipSample& tip) const noexcept {
  const Vec3& n = model_.normal;
  const double d = -n.dot(modal_way(model_, state));
  const Vec3 load = state.force + relaxing_force(model_, state, d) * n;
  // Without a load at the end
  std::array<double, TissueModel::most_modes> q{}, w{};
  Vec3 way = Vec3::Zero(), speed = Vec3::Zero();
  for (std::uint32_t i = 0; i < model_.n_modes; ++i) {
    const ModeResponse& m = modes_[i];
    const Vec3& psi = model_.modes[i].psi;
    const double g = psi.dot(load);
    q[i] = m.a11 * state.q[i] + m.a12 * state.w[i] + m.c0 * g;
    w[i] = m.a21 * state.q[i] + m.a22 * state.w[i] + m.d0 * g;
    way += q[i] * psi;
    speed += w[i] * psi;
  }
  double lag = 0;
  for (std::uint32_t j = 0; j < model_.n_branches; ++j)
    lag += model_.branches[j].stiffness * branches_[j].begun(state.p[j], d);
  const double relaxed = held_ * (-relaxing_ * n.dot(way) - lag);  // F_r+ without F+
  const Vec3 stretch = tip.x - state.rest - way - relaxed * pushed_;
  const Vec3 across = stretch - n.dot(stretch) * n;
  const double before = pressed(model_, state), stays = staying(model_, state, before);
  FlowingContact law{model_.contact(), flowing_, 0};
  for (std::uint32_t j = 0; j < model_.n_branches; ++j)
    law.lag += model_.branches[j].share * branches_[j].begun(state.f[j], stays);

  Vec3 force = Vec3::Zero();
  if (n.dot(stretch) + law.give(0) < 0) {
    const Loose loose{stretch, n.dot(tip.v - speed - relaxed * sped_) - law.law.give(stays) / h_};
    const FrictionContact contact = model_.growth > 0 ? press_growing(loose, law, before) : press(loose, law);
    force = contact.force;
    state.rest += n.dot(force) < 0 ? contact.gap : across;
  } else {
    state.rest += across;
  }

  const double relaxing_end = relaxed - held_ * relaxing_ * pushed_.dot(force);
  const Vec3 load_end = force + relaxing_end * n;
  for (std::uint32_t i = 0; i < model_.n_modes; ++i) {
    const double g = model_.modes[i].psi.dot(load_end);
    state.q[i] = q[i] + modes_[i].c1 * g;
    state.w[i] = w[i] + modes_[i].d1 * g;
  }
  const double d_end = model_.n_branches > 0 ? -n.dot(modal_way(model_, state)) : 0.0;
  const double stays_end = law.staying(std::max(0.0, -n.dot(force)));
  for (std::uint32_t j = 0; j < model_.n_branches; ++j) {
    state.p[j] = branches_[j].passed(state.p[j], d, d_end);
    state.f[j] = branches_[j].passed(state.f[j], stays, stays_end);
  }
  state.force = force;
}

/// z' = dz/dF_e F_e', F_e' = flowing (F' + sum g f'), f' of F_e as it is now.
double TissueStep::rising(const TissueState& state, double speed) const noexcept {
  const double stays = staying(model_, state, pressed(model_, state));
  double relaxes = 0;
  for (std::uint32_t j = 0; j < model_.n_branches; ++j)
    relaxes += model_.branches[j].share * (1 - branches_[j].keep) / h_ * (stays - state.f[j]);
  const double slope = flowing_ * model_.contact().slope(stays);
  return spring_.series(slope) * (speed - slope * relaxes);
}

StepWork TissueStep::advance(TissueState& state, const Vec3& before, const TipSample& tip) const noexcept {
  const double began = held(state, before).energy;
  const Vec3 force = state.force;
  advance(state, tip);
  const double given = 0.5 * (force + state.force).dot(tip.x - before);
  return {given, given - (held(state, tip.x).energy - began)};
}

HeldTissue held_tissue(const TissueModel& model, const TissueState& state, const ContactSpring& spring,
                       const Vec3& x) noexcept {
  HeldTissue held;
  const Vec3& n = model.normal;
  const FlowingContact law{model.contact(), 1 / model.stiffening(), flowed(model, state)};
  const double gives = law.share * model.residual;
  const Mat3 C = Mat3::Identity() / spring.stiffness + model.compliance(law.share);
  const Vec3 e = x - modal_surface(model, state);
  if (model.growth > 0)
    held.contact = solve_growing(law, n, pressed(model, state), [&](const GrowingContact::Tangent& z) {
      const Mat3 less = (z.slope - gives) * n * n.transpose();
      return solve_contact(C + less, e + z.offset * n, n, model.friction);
    });
  else
    held.contact = solve_contact(C, e + law.give(0) * n, n, model.friction);
  const Vec3& force = held.contact.force;
  const double in = std::max(0.0, -n.dot(force));
  held.spring_energy = 0.5 * (force.dot(C * force) - gives * in * in) + contact_energy(model, state, in);
  held.energy = held.spring_energy + tissue_energy(model, state);
  return held;
}

}  // namespace palpate::haptic
