#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/haptic/dead_physics.h"
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

/// Tissue appears 10 mm above a hand that stands still: its planes begin at the hand, where they do not push, and move out as
/// fast as the tank pays.
struct Appearance {
  double first = 0;    // force in the first tick that has one [N]
  double unpaid = -1;  // S above what the tank may have paid since [J]
  bool pushed = true;  // there was a force in the end
};
Appearance appear_around(const ObjectModel& object, double rate_Hz) {
  constexpr double when = 2.0;
  Case c = pressed_case();
  c.object = object;
  c.rate_Hz = rate_Hz;
  Trial trial(c, [](double) { return Aim{}; });
  trial.kinematic = true;
  trial.alter_patch = [&](ContactPatch& p, const Vec3&) {
    p = flat_square(p.tick, 0.01, 0.01, p.facets[0].stiffness);
    if (trial.t() < when) p.n_facets = 0;
  };
  Appearance seen;
  double since = -1;
  trial.run(4.0, [&] {
    const double f = trial.rendered().force.norm();
    if (f <= 0) return;
    if (since < 0) since = trial.t(), seen.first = f;
    const double paid = EnergyBook::cap + EnergyBook::allowance * (trial.t() - since + 1e-3);
    seen.unpaid = std::max(seen.unpaid, trial.controller().contact().stored - paid);
  });
  seen.pushed = since >= 0;
  return seen;
}

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
  double first = 0, unpaid = -1;
  bool pushed = true;
  for (const ObjectModel& object : {object_models[0], object_models[1]})
    for (const double rate : {20.0, 150.0, 1000.0}) {
      const Appearance seen = appear_around(object, rate);
      first = std::max(first, seen.first);
      unpaid = std::max(unpaid, seen.unpaid);
      pushed = pushed && seen.pushed;
    }
  return {
      "S7", "plane jumps 20 mm, appears 10 mm above the hand, stiffens tenfold, turns by 90 deg",
      "steps <= K v T + 0.1 N, bound on plane work kept, G <= 0.1 mJ; around a hand that stands still they "
      "begin at 0 N and store no more than the tank has paid",
      fmt::format("beyond K v T {:.3f} N ({}); plane work {:+.3f} mJ of its bound; G {:.3f} mJ; begins with "
                  "{:.3f} N, {:+.3f} mJ of what was paid",
                  step, worst, 1e3 * excess, 1e3 * surplus, first, 1e3 * unpaid),
      step <= limit_step * (1 + 1e-9) && excess <= 1e-9 && surplus <= EnergyBook::G_allowed && pushed &&
          first <= limit_step && unpaid <= 1e-9};
}

Row silence_fades() {
  std::vector<Case> cases;
  for (const double rate : {20.0, 60.0, 150.0, 1000.0})
    for (const double delay : {0.0, 50e-3}) {
      Case c = pressed_case();
      c.device = device_models[0];
      c.object = object_models[1];
      c.rate_Hz = rate;
      c.link.delay = delay;
      cases.push_back(c);
    }
  const Silence s = silence_in(cases);
  return {"F1", "physics dies in contact, 20 to 1000 Hz, 0 and 50 ms",
          "stale; falls steadily to 0 N within 400 ms of the last patch; steps <= K v T + 0.1 N; G <= 0.1 "
          "mJ; ready within 0.1 s of "
          "its return",
          text_of(s), fades(s, limit_step)};
}

Row return_is_no_kick() {
  std::vector<Case> cases;
  for (const double rate : {20.0, 150.0, 1000.0}) {
    cases.push_back(pressed_case());
    cases.back().object = object_models[1];
    cases.back().rate_Hz = rate;
  }
  const Return r = return_in(cases, {0.1, 0.2, 1.0});
  const bool runs_again =
      std::all_of(r.again.begin(), r.again.end(), [](double f) { return std::abs(f - 1.0) < 0.05; });
  return {"F2", "physics returns after 0.1, 0.2 and 1 s with the tool inside",
          "after 1 s: 0 N until the tool has left; steps <= K v T + 0.1 N; bound on plane work kept; then as "
          "before",
          fmt::format("inside {:g} N; beyond K v T {:.3f} N; plane work {:+.3f} mJ of its bound; {}",
                      r.inside, r.step, 1e3 * r.excess, runs_again ? "1 N again" : "no force later"),
          r.inside == 0 && r.step <= limit_step && r.excess <= 1e-9 && runs_again};
}

}  // namespace palpate::bench
