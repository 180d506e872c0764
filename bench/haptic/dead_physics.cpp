#include "bench/haptic/dead_physics.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::bench {
namespace {

constexpr double silent_from = 2.0;   // physics falls silent [s]
constexpr double watched = 0.7;       // [s]
constexpr double long_silence = 0.5;  // [s]

std::uint64_t taken(const Trial& trial) {
  return trial.controller().patches().taken() + trial.controller().wrenches().taken();
}

}  // namespace

Silence silence_in(const std::vector<Case>& cases) {
  Silence all;
  for (const Case& c : cases) {
    Trial trial(c, press_path(c));
    trial.run(silent_from);
    trial.physics_alive = false;
    double last_message = silent_from, last = 1e9, gone = 10;
    std::uint64_t seen = taken(trial);
    bool stale = false;
    trial.run(silent_from + watched, [&] {
      if (taken(trial) != seen) seen = taken(trial), last_message = trial.t();
      const bool now_stale = trial.controller().state() == haptic::HapticState::stale;
      const double f = trial.rendered().force.norm();
      if (now_stale && stale) all.monotone = all.monotone && f <= last * (1 + 1e-12);
      stale = stale || now_stale;
      last = f;
      if (f == 0) gone = std::min(gone, trial.t());
    });
    trial.restart_physics();
    double ready = 10;
    trial.run(silent_from + watched + 0.5, [&] {
      if (trial.controller().state() == haptic::HapticState::ready) ready = std::min(ready, trial.t());
    });
    all.found = std::max(all.found, ready - (silent_from + watched) - c.link.delay);
    all.latest = std::max(all.latest, gone - last_message);
    all.went_stale = all.went_stale && stale;
    all.step = std::max(all.step, trial.force_step_beyond_motion());
    all.surplus = std::max(all.surplus, trial.energy().surplus());
  }
  return all;
}

Return return_in(const std::vector<Case>& cases, const std::vector<double>& away) {
  Return all;
  for (const Case& c : cases)
    for (const double silent : away) {
      const Path press = press_path(c, 1.0, 3.0);
      Trial trial(c, [press](double t) { return t < 5 ? press(t) : press(t - 5); });
      trial.run(silent_from);
      trial.physics_alive = false;
      trial.run(silent_from + silent);
      trial.restart_physics();
      trial.run(7.0, [&] {
        if (silent > long_silence && trial.t() <= 4)
          all.inside = std::max(all.inside, trial.rendered().force.norm());
      });
      all.again.push_back(trial.rendered().force.norm());
      all.step = std::max(all.step, trial.force_step_beyond_motion());
      all.excess = std::max(all.excess, trial.energy().plane_excess());
    }
  return all;
}

bool fades(const Silence& silence, double limit_step) noexcept {
  return silence.latest <= 0.4 && silence.monotone && silence.went_stale && silence.step <= limit_step &&
         silence.surplus <= EnergyBook::G_allowed && silence.found <= 0.1;
}

std::string text_of(const Silence& silence) {
  return fmt::format(
      "0 N after {:.0f} ms at most, {}; beyond K v T {:.3f} N; G {:.3f} mJ; ready after {:.0f} ms",
      1e3 * silence.latest, silence.monotone ? "never rising" : "rising", silence.step, 1e3 * silence.surplus,
      1e3 * silence.found);
}

}  // namespace palpate::bench
