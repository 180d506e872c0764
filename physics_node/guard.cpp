#include "physics_node/guard.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr std::int64_t frames_between_saves = 50;
// Kinetic and elastic energy over what was ever put in. A sound step lets them swing: with symplectic Euler by
// 1 / (1 - w dt / 2), more than this only for waves of a few cells at steps near the stable one.
constexpr double largest_growth = 4;       // before the guard acts
constexpr double suspicious_growth = 1.5;  // before it measures anew
// Put in since the last frame, as a ratio. Why: a blow, and what it stores in the step it lands in shows only one
// step later.
constexpr double blow = 1.2;
// Of the spacing, in a step. Why: what is about to be torn or turned inside out holds little until the step in which
// it is; nothing that a hand does comes near that.
constexpr double far_in_a_step = 0.25;
// That are measured after a start. Why: the step is chosen for the shape at rest, and what is shaken may outgrow it at once.
constexpr int first_frames = 2;
constexpr double sound_growth = 2;           // between two saves, for the first of them to be good
constexpr double negligible_energy = 1e-12;  // [J]
constexpr int most_recoveries =
    6;  // Why: each halves the step; at a 64th nothing that can be stepped still grows

std::size_t fastest_of(const BodyModels& bodies) noexcept {
  std::size_t fastest = 0;
  for (std::size_t b = 1; b < bodies.size(); ++b)
    if (bodies[b]->watch().speed > bodies[fastest]->watch().speed) fastest = b;
  return fastest;
}

}  // namespace

Guard::Verdict Guard::look(const BodyModels& bodies, double dt, EnergyAccount& account,
                           StepReport& report) noexcept {
  double energy = 0, fallen = 0;
  bool far = false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Watch watch = bodies[b]->watch();
    if (!watch.is_finite() || unusable_work_) {
      ++report.nonfinite;
      unusable_work_ = false;
      culprit_ = b;
      return Verdict::go_back;
    }
    energy += watch.energy();
    far = far || watch.speed * dt > far_in_a_step * bodies[b]->body().spacing();
    fallen += watch.fallen;
  }
  const double put_in = account.put_in(fallen, report);
  const bool struck = put_in > blow * last_put_in_ + negligible_energy;
  last_put_in_ = put_in;
  // The kernels saw elastic energy before the last step; what grows fast is looked at once more, as it is now.
  if (first_ > 0 || struck || far || !(energy <= suspicious_growth * put_in + negligible_energy)) {
    energy = 0;
    for (const auto& body : bodies) energy += body->energy_now();
  }
  first_ = std::max(0, first_ - 1);
  if (!(energy <= largest_growth * put_in + negligible_energy)) {
    ++report.grown;
    culprit_ = fastest_of(bodies);
    return Verdict::go_back;
  }
  account.note(fallen);
  sound_ = sound_ && energy <= sound_growth * put_in + negligible_energy;
  return report.frames % frames_between_saves == frames_between_saves - 1 ? Verdict::save : Verdict::sound;
}

void Guard::begin() noexcept {
  first_ = first_frames;
  last_put_in_ = 0;
}

bool Guard::may_try_again() noexcept {
  if (recoveries_ == most_recoveries) {
    given_up_ = culprit_;
    return false;
  }
  ++recoveries_;
  return true;
}

void Guard::reset() noexcept {
  recoveries_ = 0;
  given_up_.reset();
}

}  // namespace palpate::physics
