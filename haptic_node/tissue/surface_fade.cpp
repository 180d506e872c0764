#include "haptic_node/tissue/surface_fade.h"

#include <cmath>

#include "haptic_node/tissue/largest_share.h"

namespace palpate::haptic {
namespace {

constexpr int rounds = 12;  // beta to 1 / 4096 of its range

}  // namespace

SurfaceState mixed(const SurfaceState& felt, const SurfaceState& shadow, double beta) noexcept {
  SurfaceState s = felt;
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    s.q[i] += beta * (shadow.q[i] - felt.q[i]);
    s.w[i] += beta * (shadow.w[i] - felt.w[i]);
  }
  s.xi += beta * (shadow.xi - felt.xi);
  s.rest += beta * (shadow.rest - felt.rest);
  return s;
}

/// The damper's part of F stays as it was: what is compared are the springs.
double SurfaceFade::pass(const SurfaceModel& model, const SurfaceStep& step, SurfaceState& felt,
                         const SurfaceState& shadow, const Vec3& x, double force_step,
                         WorkTank& tank) noexcept {
  const HeldSurface before = held_surface(model, felt, step.spring(), x);
  const auto tried = [&](double beta) {
    return held_surface(model, mixed(felt, shadow, beta), step.spring(), x);
  };
  const auto fits = [&](const HeldSurface& held) {
    return held.energy - before.energy <= tank.level() &&
           (held.contact.force - before.contact.force).norm() <= force_step;
  };
  double beta = -std::expm1(-step.h() / tau);
  HeldSurface after = tried(beta);
  if (!fits(after)) {
    beta = largest_share(beta, rounds, [&](double share) { return fits(tried(share)); });
    if (beta <= 0) return 0;
    after = tried(beta);
  }
  felt = mixed(felt, shadow, beta);
  if (after.contact.touching && before.contact.touching)
    felt.force += after.contact.force - before.contact.force;
  else
    felt.force = after.contact.force;
  const double pressed = -after.point.normal.dot(felt.force);
  if (pressed <= 0) felt.force.setZero();
  tank.book(after.energy - before.energy);
  return after.energy - before.energy;
}

}  // namespace palpate::haptic
