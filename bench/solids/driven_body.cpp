#include "bench/solids/driven_body.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/stable_step.h"

namespace palpate::bench {

using physics::Index;

DrivenBody::DrivenBody(physics::Body body, Precision precision)
    : stable_step_(physics::stable_step(physics::stiffest_mode(body), Integrator::symplectic_euler)) {
  model_ = physics::make_body_model(std::move(body), precision);
  model_->prepare_for(physics::Disturbance::impulses);
}

void DrivenBody::drive(const std::function<unsigned(const Vec3&)>& axes_of) {
  led_.clear();
  for (const Index node : model_->body().nodes())
    if (const unsigned axes = axes_of(model_->body().rest_position(node)); axes != 0)
      led_.push_back({.node = node, .axes = axes, .u = model_->displacement(node)});
}

/// As the frame of the product divides itself.
double DrivenBody::next_dt(double part) const { return part * stable_step_ / std::max(1.0, stiffening_); }

void DrivenBody::step(const std::function<Vec3(const Vec3& rest)>& target, double dt) {
  stiffening_ = model_->advance({.dt = dt, .watch = true}, {}).stiffening;
  most_elastic_ = std::max(most_elastic_, model_->watch().elastic);
  if (after_step) after_step(dt);
  for (Led& led : led_) {
    const Vec3 rest = model_->body().rest_position(led.node), to = target(rest);
    Vec3 u = model_->displacement(led.node), v = model_->velocity(led.node);
    const double mass = node_mass(model_->body(), led.node);
    for (Eigen::Index a = 0; a < 3; ++a) {
      if ((led.axes >> a & 1) == 0) continue;
      const double led_v = (to[a] - led.u[a]) / dt;
      led.force[a] = mass * (led_v - v[a]) / dt;
      led.u[a] = u[a] = to[a];
      v[a] = led_v;
    }
    model_->place(led.node, u, v);
  }
  ++steps_;
}

void DrivenBody::run(double seconds, const Way& way) {
  for (double t = 0; t < seconds;) {
    const double dt = next_dt(share);
    t = std::min(seconds, t + dt);
    step([&](const Vec3& rest) { return way(rest, t); }, dt);
  }
}

/// Of what is not led; the led, which stand, have what the cells gave them in the step taken from them again.
double DrivenBody::kinetic() const {
  double sum = 0;
  for (const Index node : model_->body().nodes())
    sum += 0.5 * node_mass(model_->body(), node) * model_->velocity(node).squaredNorm();
  return sum;
}

void DrivenBody::stop() {
  for (const Index node : model_->body().nodes())
    model_->place(node, model_->displacement(node), Vec3::Zero());
}

bool DrivenBody::settle(double enough, int most_steps) {
  std::vector<Vec3> stays;
  for (const Led& led : led_) stays.push_back(led.u);
  // Why half of the step: a stop comes a step after the peak, and what swings in three steps would be stopped beyond where it began.
  double before = 0;  // kinetic energy
  stop();
  for (int n = 0; n < most_steps; ++n) {
    std::size_t next = 0;
    step([&](const Vec3&) { return stays[next++]; }, next_dt(0.5 * share));
    const double now = kinetic();
    if (now < before) {
      if (before < enough * most_elastic_) return true;
      stop();
      before = 0;
    } else {
      before = now;
    }
  }
  return false;
}

Vec3 DrivenBody::force(const std::function<bool(const Vec3&)>& picks) const {
  Vec3 sum = Vec3::Zero();
  for (const Led& led : led_)
    if (picks(model_->body().rest_position(led.node))) sum += led.force;
  return sum;
}

Vec3 DrivenBody::moment(const Vec3& about, const std::function<bool(const Vec3&)>& picks) const {
  Vec3 sum = Vec3::Zero();
  for (const Led& led : led_)
    if (picks(model_->body().rest_position(led.node)))
      sum += (model_->position(led.node) - about).cross(led.force);
  return sum;
}

}  // namespace palpate::bench
