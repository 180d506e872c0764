#include "haptic_node/tissue/tissue_step.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {

TissueStep::TissueStep(const TissueModel& model, const ContactSpring& spring, double h) noexcept
    : model_(model), spring_(spring), h_(h) {
  double surface = 0, speed = 0;  // y+ and y+' by the load at the end
  for (std::uint32_t i = 0; i < model.n_modes; ++i) {
    modes_[i] = mode_response(model.modes[i], h);
    const double squared = model.modes[i].phi * model.modes[i].phi;
    surface += squared * modes_[i].c1;
    speed += squared * modes_[i].d1;
  }
  for (std::uint32_t j = 0; j < model.n_branches; ++j) {
    // p' = (y - p) / tau: a held y leaves 1 - e^-u, one that grows from 0 to 1 leaves 1 - (1 - e^-u) / u, u = h / tau
    const double u = h / model.branches[j].time;
    const double keep = std::exp(-u), mean = -std::expm1(-u) / u;
    branches_[j] = {keep, mean - keep, 1 - mean};
    relaxing_ += model.branches[j].stiffness * mean;
  }
  sigma_ = surface / (1 + surface * relaxing_);
  nu_ = speed * (1 - relaxing_ * sigma_);
}

void TissueStep::advance(TissueState& state, double x, double v) const noexcept {
  const double y = modal_surface(model_, state);
  const double load = state.force - relaxing_force(model_, state, y);
  // Without a load at the end
  double surface = state.rest, speed = 0;
  std::array<double, TissueModel::most_modes> q{}, w{};
  double by_load = 0, speed_by_load = 0;
  for (std::uint32_t i = 0; i < model_.n_modes; ++i) {
    const ModeResponse& m = modes_[i];
    const double phi = model_.modes[i].phi, g = phi * load;
    q[i] = m.a11 * state.q[i] + m.a12 * state.w[i] + m.c0 * g;
    w[i] = m.a21 * state.q[i] + m.a22 * state.w[i] + m.d0 * g;
    surface += phi * q[i];
    speed += phi * w[i];
    by_load += phi * phi * m.c1;
    speed_by_load += phi * phi * m.d1;
  }
  // F_r+ = relaxing y+ - lag
  double lag = 0;
  for (std::uint32_t j = 0; j < model_.n_branches; ++j)
    lag += model_.branches[j].stiffness * (branches_[j].keep * state.p[j] + branches_[j].first * y);
  const double alpha = (surface + by_load * lag) / (1 + by_load * relaxing_);
  const double v0 = speed + speed_by_load * (lag - relaxing_ * alpha);

  const double K = spring_.stiffness, B = spring_.damping, s = model_.residual, memory = B * s / h_;
  const double open =
      (K * (x - alpha) + B * (v - v0) + memory * state.force) / (1 + K * s + memory + K * sigma_ + B * nu_);
  const double most = (1 + ContactSpring::most_damping) * spring_.series(s);
  const double bound = most * (x - alpha) / (1 + most * sigma_);
  const double force = std::max(0.0, std::min(open, bound));

  const double y_end = alpha + sigma_ * force;
  const double load_end = force - (relaxing_ * y_end - lag);
  for (std::uint32_t i = 0; i < model_.n_modes; ++i) {
    const double g = model_.modes[i].phi * load_end;
    state.q[i] = q[i] + modes_[i].c1 * g;
    state.w[i] = w[i] + modes_[i].d1 * g;
  }
  for (std::uint32_t j = 0; j < model_.n_branches; ++j)
    state.p[j] = branches_[j].keep * state.p[j] + branches_[j].first * y + branches_[j].last * y_end;
  state.force = force;
}

StepWork TissueStep::advance(TissueState& state, double x_before, double x, double v) const noexcept {
  const double held = energy(state, x_before), force = state.force;
  advance(state, x, v);
  const double given = 0.5 * (force + state.force) * (x - x_before);
  return {given, given - (energy(state, x) - held)};
}

double TissueStep::spring_energy(const TissueState& state, double x) const noexcept {
  return spring_.energy(model_.residual, x - modal_surface(model_, state));
}

double TissueStep::energy(const TissueState& state, double x) const noexcept {
  return spring_energy(state, x) + tissue_energy(model_, state);
}

double TissueStep::force_at(const TissueState& state, double x, double v) const noexcept {
  return spring_.force(model_.residual, h_, x - modal_surface(model_, state), v - modal_speed(model_, state),
                       state.force);
}

}  // namespace palpate::haptic
