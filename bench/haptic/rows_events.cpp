#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/haptic/rows.h"

namespace palpate::bench {
namespace {

constexpr double limit_step = 0.1;  // beyond the hand's own motion [N]

Case pressed_case() {
  Case c;
  c.device = device_models[3];
  c.hand = hand_springs[1];
  return c;
}

/// The same facets, turned to face +x, with the plane x = at.
void turn_to_x(ContactPatch& patch, double at) {
  for (PatchFacet& facet : patch.facets) {
    for (Array3& corner : facet.corners) corner = {at, corner[1], corner[0]};
    facet.point = {at, 0, 0};
    facet.normal = {1, 0, 0};
  }
}

struct Teleport {
  const char* name;
  std::function<void(ContactPatch&, double t)> change;
};

}  // namespace

Row teleports_push_gently() {
  constexpr double when = 2.0;
  const std::vector<Teleport> teleports = {{"jump of 20 mm",
                                            [](ContactPatch& p, double t) {
                                              if (t > when)
                                                p = flat_square(p.tick, 0.02, 0.02, p.facets[0].stiffness);
                                            }},
                                           {"appears 10 mm above the hand",
                                            [](ContactPatch& p, double t) {
                                              p = flat_square(p.tick, 0.01, 0.01, p.facets[0].stiffness);
                                              if (t < when) p.n_facets = 0;
                                            }},
                                           {"stiffness x 10",
                                            [](ContactPatch& p, double t) {
                                              if (t > when)
                                                for (PatchFacet& facet : p.facets)
                                                  facet.stiffness =
                                                      std::min(10 * facet.stiffness, rigid_stiffness);
                                            }},
                                           {"normal turns by 90 deg", [](ContactPatch& p, double t) {
                                              if (t > when) turn_to_x(p, 0.0);
                                            }}};
  double step = -1, excess = -1, surplus = 0;
  std::string worst;
  for (const Teleport& teleport : teleports)
    for (const ObjectModel& object : {object_models[0], object_models[1]})
      for (const double rate : {20.0, 150.0, 1000.0}) {
        Case c = pressed_case();
        c.object = object;
        c.rate_Hz = rate;
        Trial trial(c, press_path(c));
        trial.alter_patch = [&](ContactPatch& p, const Vec3&) { teleport.change(p, trial.t()); };
        trial.run(4.0);
        excess = std::max(excess, trial.energy().plane_excess());
        surplus = std::max(surplus, trial.energy().surplus());
        if (trial.force_step_beyond_motion() > step) worst = teleport.name;
        step = std::max(step, trial.force_step_beyond_motion());
      }
  return {"S7", "plane jumps 20 mm, appears 10 mm above the hand, stiffens tenfold, turns by 90 deg",
          "steps <= K v T + 0.1 N, bound on plane work kept, G <= 0.1 mJ",
          fmt::format("beyond K v T {:.3f} N ({}); plane work {:+.3f} mJ of its bound; G {:.3f} mJ", step,
                      worst, 1e3 * excess, 1e3 * surplus),
          step <= limit_step * (1 + 1e-9) && excess <= 1e-9 && surplus <= EnergyBook::G_allowed};
}

Row silence_fades() {
  constexpr double when = 2.0;
  double latest = 0, step = -1, surplus = 0;
  bool monotone = true, stale_then_ready = true;
  for (const double rate : {20.0, 60.0, 150.0, 1000.0})
    for (const double delay : {0.0, 50e-3}) {
      Case c = pressed_case();
      c.device = device_models[0];
      c.object = object_models[1];
      c.rate_Hz = rate;
      c.link.delay = delay;
      Trial trial(c, press_path(c));
      trial.run(when);
      trial.physics_alive = false;
      const std::uint64_t taken = trial.controller().patches().taken();
      double last_message = when, last = 1e9, gone = 10;
      std::uint64_t seen = taken;
      bool stale = false;
      trial.run(when + 0.7, [&] {
        if (trial.controller().patches().taken() != seen) {
          seen = trial.controller().patches().taken();
          last_message = trial.t();
        }
        const bool now_stale = trial.controller().state() == haptic::HapticState::stale;
        const double f = trial.rendered().force.norm();
        if (now_stale && stale) monotone = monotone && f <= last;
        stale = stale || now_stale;
        last = f;
        if (f == 0) gone = std::min(gone, trial.t());
      });
      latest = std::max(latest, gone - last_message);
      stale_then_ready = stale_then_ready && stale;
      step = std::max(step, trial.force_step_beyond_motion());
      surplus = std::max(surplus, trial.energy().surplus());
    }
  return {"F1", "physics dies in contact, 20 to 1000 Hz, 0 and 50 ms",
          "stale; falls steadily to 0 N within 400 ms of the last patch; steps <= K v T + 0.1 N; G <= 0.1 mJ",
          fmt::format("0 N after {:.0f} ms at most, {}; beyond K v T {:.3f} N; G {:.3f} mJ", 1e3 * latest,
                      monotone ? "never rising" : "rising", step, 1e3 * surplus),
          latest <= 0.4 && monotone && stale_then_ready && step <= limit_step &&
              surplus <= EnergyBook::G_allowed};
}

Row return_is_no_kick() {
  double inside = 0, step = -1, excess = -1;
  bool runs_again = true;
  for (const double rate : {20.0, 150.0, 1000.0})
    for (const double away : {0.1, 0.2, 1.0}) {
      Case c = pressed_case();
      c.object = object_models[1];
      c.rate_Hz = rate;
      // Out at 4 s, in again at 5 s.
      const Path press = press_path(c, 1.0, 3.0);
      Trial trial(c, [press](double t) { return t < 5 ? press(t) : press(t - 5); });
      trial.run(2.0);
      trial.physics_alive = false;
      trial.run(2.0 + away);
      trial.restart_physics();
      trial.run(7.0, [&] {
        const bool out_since = trial.t() > 4;
        if (away > 0.5 && !out_since) inside = std::max(inside, trial.rendered().force.norm());
      });
      runs_again = runs_again && std::abs(trial.rendered().force.norm() - 1.0) < 0.05;
      step = std::max(step, trial.force_step_beyond_motion());
      excess = std::max(excess, trial.energy().plane_excess());
    }
  return {"F2", "physics returns after 0.1, 0.2 and 1 s with the tool inside",
          "after 1 s: 0 N until the tool has left; steps <= K v T + 0.1 N; bound on plane work kept; then as "
          "before",
          fmt::format("inside {:g} N; beyond K v T {:.3f} N; plane work {:+.3f} mJ of its bound; {}", inside,
                      step, 1e3 * excess, runs_again ? "1 N again" : "no force later"),
          inside == 0 && step <= limit_step && excess <= 1e-9 && runs_again};
}

}  // namespace palpate::bench
