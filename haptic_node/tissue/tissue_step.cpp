#include "haptic_node/tissue/tissue_step.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {

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
  for (std::uint32_t j = 0; j < model.n_branches; ++j) {
    // p' = (d - p) / tau: a held d leaves 1 - e^-u, one that grows from 0 to 1 leaves 1 - (1 - e^-u) / u, u = h / tau
    const double u = h / model.branches[j].time;
    const double keep = std::exp(-u), mean = -std::expm1(-u) / u;
    branches_[j] = {keep, mean - keep, 1 - mean};
    relaxing_ += model.branches[j].stiffness * mean;
  }
  pushed_ = D * n;
  sped_ = E * n;
  held_ = 1 / (1 + relaxing_ * n.dot(pushed_));
  // F_r+ = held (relaxing (d_f - D n . F+) - lag)
  D -= held_ * relaxing_ * pushed_ * pushed_.transpose();
  E -= held_ * relaxing_ * sped_ * pushed_.transpose();
  const double K = spring.stiffness;
  const Mat3 R = model.compliance(), still = Mat3::Identity() / K + R;
  residual_by_h_ = R / h;
  compliance_ = still + D + spring.damping / K * n * (n.transpose() * (residual_by_h_ + E));
  inverse_ = compliance_.inverse();
  bound_ = still / (1 + ContactSpring::most_damping) + D;
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
    lag += model_.branches[j].stiffness * (branches_[j].keep * state.p[j] + branches_[j].first * d);
  const double relaxed = held_ * (-relaxing_ * n.dot(way) - lag);  // F_r+ without F+
  const Vec3 stretch = tip.x - state.rest - way - relaxed * pushed_;
  const Vec3 across = stretch - n.dot(stretch) * n;

  Vec3 force = Vec3::Zero();
  if (n.dot(stretch) < 0) {
    const Vec3 late = tip.v - speed - relaxed * sped_ + residual_by_h_ * state.force;
    const Vec3 e = stretch + spring_.damping / spring_.stiffness * n.dot(late) * n;
    const FrictionContact contact = solve_contact(compliance_, inverse_, e, n, model_.friction);
    const double in = -n.dot(contact.force);
    if (in > 0) {
      const Vec3 along = contact.force / in;
      const double most = n.dot(stretch) / n.dot(bound_ * along);
      force = most > 0 && most < in ? Vec3(most * along) : contact.force;
      state.rest += contact.gap;
    } else {
      state.rest += across;
    }
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
  for (std::uint32_t j = 0; j < model_.n_branches; ++j)
    state.p[j] = branches_[j].keep * state.p[j] + branches_[j].first * d + branches_[j].last * d_end;
  state.force = force;
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
  const Mat3 C = Mat3::Identity() / spring.stiffness + model.compliance();
  held.contact = solve_contact(C, x - modal_surface(model, state), model.normal, model.friction);
  held.spring_energy = 0.5 * held.contact.force.dot(C * held.contact.force);
  held.energy = held.spring_energy + tissue_energy(model, state);
  return held;
}

}  // namespace palpate::haptic
