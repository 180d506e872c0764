#include "bench/haptic/surface_trial.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/haptic/trial.h"

namespace palpate::bench {
namespace {

constexpr double tick_s = 1e-3, wait = 0.3;  // [s]

haptic::TouchSettings settings_of(const SurfaceCase& c) {
  haptic::TouchSettings settings;
  settings.spring = {c.stiffness, c.damping};
  settings.force_limit = c.device.force_limit;
  settings.resolution = c.device.resolution;
  return settings;
}

}  // namespace

SurfaceCase led_surface(const LinkAge& age, double friction) {
  SurfaceCase c;
  c.friction = friction;
  c.rate_Hz = age.rate_Hz;
  c.link.delay = age.delay;
  c.link.loss = age.loss;
  c.kinematic = true;
  return c;
}

SurfaceRun touch_surface(const SurfaceCase& c, const Path& path, double until) {
  const Vec3 start = path(0).q;
  Plant plant(c.device, c.hand, start);
  PressedBlock tissue({c.stiffness, c.damping}, c.friction, c.modes, c.told,
                      start.head<2>() / BlockModel::distance);
  haptic::SurfaceTouch touch(settings_of(c));
  Link<std::shared_ptr<const TipSamples>> up(c.link, 2 * c.seed);
  Link<std::shared_ptr<const haptic::SurfaceAnswer>> down(c.link, 2 * c.seed + 1);
  EnergyBook energy;
  SurfaceRun run;
  std::shared_ptr<const TipSamples> known;
  Vec3 in_flight = Vec3::Zero();  // on the handle, a tick on its way
  std::uint64_t frames = 0, taken = 0;
  double next_frame = -wait;
  const int ticks = static_cast<int>(std::lround((until + wait) / tick_s));
  const int waiting = static_cast<int>(std::lround(wait / tick_s));
  for (int n = 0; n < ticks; ++n) {
    const double t = -wait + tick_s * n;
    const std::int64_t now_ns = n * Trial::tick_ns;
    up.send(now_ns, newest_samples(touch.history(), [](const haptic::TipSample& tip) { return tip; }));
    if (t >= next_frame - 1e-9) {
      next_frame += 1 / c.rate_Hz;
      up.receive(now_ns, known);
      tissue.frame(known.get());
      if (tissue.stamp() > 0) down.send(now_ns, tissue.answer(++frames));
    }
    std::shared_ptr<const haptic::SurfaceAnswer> arrived;
    if (down.receive(now_ns, arrived) && arrived->tick > taken && is_sound(*arrived, 0)) {
      taken = arrived->tick;
      touch.take(*arrived);
    }
    const Vec3 force = -touch.tick(plant.measured(), 1.0);
    run.step_beyond =
        std::max(run.step_beyond, (force - in_flight).norm() -
                                      c.stiffness * (plant.v().norm() * tick_s + c.device.resolution));
    if (n >= waiting) run.samples.push_back({t, plant.x(), touch.felt(), Vec3::Zero(), touch.share()});
    const Vec3 acting = in_flight, before = plant.x();
    in_flight = force;
    energy.tick(tick_s, touch.stored() - force.dot(plant.x() - plant.measured()), touch.correction_work(),
                touch.touching());
    const int steps = static_cast<int>(std::lround(tick_s / Plant::step));
    const Vec3 push = t >= 0 && t < c.pushed ? c.push : Vec3(Vec3::Zero());
    for (int i = 0; i < steps; ++i) {
      const double now = t + i * Plant::step;
      const Aim aim = path(std::max(0.0, now));
      if (c.kinematic)
        plant.put(path(std::max(0.0, now + Plant::step)).q, aim.q_dot);
      else
        plant.advance(aim.q, now < 0 ? Vec3(Vec3::Zero()) : aim.q_dot, acting + push);
    }
    energy.moved(acting, plant.x() - before);
  }
  const auto first = static_cast<std::size_t>(waiting) + 1;
  const std::size_t come = tissue.stamp() >= first ? tissue.stamp() - first + 1 : 0;
  run.samples.resize(std::min(run.samples.size(), come));
  for (std::size_t i = 0; i < run.samples.size(); ++i) run.samples[i].borne = tissue.borne(first + i);
  run.surplus = energy.surplus();
  run.plane_excess = energy.plane_excess();
  run.made = touch.made();
  return run;
}

}  // namespace palpate::bench
