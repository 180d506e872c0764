#include "haptic_node/tissue/surface_step.h"

#include <algorithm>
#include <cmath>

namespace palpate::haptic {

SurfaceStep::SurfaceStep(const SurfaceModel& model, const ContactSpring& spring, double h) noexcept
    : spring_(spring), h_(h) {
  for (std::uint32_t i = 0; i < model.n_modes; ++i)
    modes_[i] = mode_response(model.modes[i].stiffness, model.modes[i].damping, h);
}

void SurfaceStep::advance(const SurfaceModel& model, SurfaceState& state,
                          const TipSample& tip) const noexcept {
  const double K = spring_.stiffness, B_by_K = spring_.damping / K;
  SurfacePlace xi = on_patch(model, state.xi);
  // Without a force at the end
  std::array<double, SurfaceModel::most_modes> q{}, w{};
  if (model.n_modes > 0) {
    const SurfacePoint begin = surface_point(model, state.q, state.rest, xi, state.force);
    for (std::uint32_t i = 0; i < model.n_modes; ++i) {
      const double g = begin.psi[i].dot(state.force);
      q[i] = modes_[i].a11 * state.q[i] + modes_[i].a12 * state.w[i] + modes_[i].c0 * g;
      w[i] = modes_[i].a21 * state.q[i] + modes_[i].a22 * state.w[i] + modes_[i].d0 * g;
    }
  }
  Vec3 force = state.force;
  for (int move = 0;; ++move) {
    const SurfacePoint point = surface_point(model, q, state.rest, xi, force);
    const Vec3& n = point.normal;
    Mat3 give = point.residual, give_speed = point.residual / h_;
    Vec3 speed = tip.v + point.residual * state.force / h_;
    for (std::uint32_t i = 0; i < model.n_modes; ++i) {
      const Mat3 squared = point.psi[i] * point.psi[i].transpose();
      give += modes_[i].c1 * squared;
      give_speed += modes_[i].d1 * squared;
      speed -= w[i] * point.psi[i];
    }
    const Vec3 stretch = tip.x - point.modal;
    if (n.dot(stretch) >= 0) {
      force.setZero();
      if (move == moves) break;
      xi = on_patch(model, xi + point.places_along(stretch - n.dot(stretch) * n));
      continue;
    }
    const Mat3 damped = Mat3::Identity() / K + give + B_by_K * n * (n.transpose() * give_speed);
    const Vec3 e = stretch + B_by_K * n.dot(speed) * n;
    const FrictionContact contact = solve_contact(damped, e, n, model.friction);
    force = contact.force;
    const double pressed = -n.dot(force);
    if (pressed > 0) {
      const Mat3 most =
          (Mat3::Identity() / K + point.residual) / (1 + ContactSpring::most_damping) + give - point.residual;
      const Vec3 d = force / pressed;
      const double bound = n.dot(stretch) / n.dot(most * d);
      if (bound > 0 && bound < pressed) force = bound * d;
    }
    if (move == moves) {
      for (std::uint32_t i = 0; i < model.n_modes; ++i) {
        const double g = point.psi[i].dot(force);
        q[i] += modes_[i].c1 * g;
        w[i] += modes_[i].d1 * g;
      }
      break;
    }
    xi = on_patch(model, xi + share_moved * point.places_along(contact.gap));
  }
  state.q = q, state.w = w;
  state.xi = xi;
  state.force = force;
}

StepWork SurfaceStep::advance(const SurfaceModel& model, SurfaceState& state, const Vec3& before,
                              const TipSample& tip) const noexcept {
  const double held = held_surface(model, state, spring_, before).energy;
  const Vec3 force = state.force;
  advance(model, state, tip);
  const double given = 0.5 * (force + state.force).dot(tip.x - before);
  return {given, given - (held_surface(model, state, spring_, tip.x).energy - held)};
}

HeldSurface held_surface(const SurfaceModel& model, const SurfaceState& state, const ContactSpring& spring,
                         const Vec3& x) noexcept {
  HeldSurface held;
  held.point = surface_point(model, state.q, state.rest, on_patch(model, state.xi), state.force);
  const Mat3 C = Mat3::Identity() / spring.stiffness + held.point.residual;
  held.contact = solve_contact(C, x - held.point.modal, held.point.normal, model.friction);
  held.spring_energy = 0.5 * held.contact.force.dot(C * held.contact.force);
  double twice = 0;
  for (std::uint32_t i = 0; i < model.n_modes; ++i)
    twice += state.w[i] * state.w[i] + model.modes[i].stiffness * state.q[i] * state.q[i];
  held.energy = held.spring_energy + 0.5 * twice;
  return held;
}

}  // namespace palpate::haptic
