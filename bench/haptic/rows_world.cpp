// The rows of the matrix again, in three dimensions, with the real physics library in place of a mass on a spring.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/haptic/dead_physics.h"
#include "bench/haptic/rows.h"
#include "bench/haptic/world_cases.h"

namespace palpate::bench {

Row world_is_stable(Runs& runs) {
  std::vector<Case> cases;
  for (const double stiffness : {300.0, 500.0})
    for (const DeviceModel& device : {device_models[0], device_models[1]})
      for (Case c : world_cases(runs.effort, RenderMode::local, device)) {
        c.stiffness = stiffness;
        cases.push_back(c);
      }
  const auto results = run_cases(cases, runs.jobs);
  runs.world.insert(runs.world.end(), results.begin(), results.end());
  const Tally t = tally(results);
  return {"S2",
          "real tissue, 3-D: slabs of 30 and 100 kPa and one that yields; Touch and Premium, 3 hands, K 300 "
          "and 500",
          "none above 200 um, <= 1 % above 100 um, energy bounds in all, steps <= K (v T + q) + 0.1 N",
          world_figure(t), keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

Row world_raw_is_unstable(Runs& runs) {
  const std::vector<Case> cases = world_cases(runs.effort, RenderMode::raw_planes, device_models[0]);
  const Tally t = tally(run_cases(cases, runs.jobs));
  return {"S0", "negative control on real tissue: raw planes, K 500, Touch",
          "more than 5 % of the cases above 200 um",
          fmt::format("{} of {} cases above 200 um", t.above_200_um, t.cases), t.above_200_um * 20 > t.cases};
}

/// Against the same press at 1 kHz without delay; and that against the spring of the hand, which must hold it.
Row world_force_is_true(Runs& runs) {
  double worst = 0, at_rest = 0, least = 1e9;
  int cases = 0;
  for (const SlabModel& slab : slab_models) {
    Case c = case_of(slab);
    c.device = device_models[3];
    c.rate_Hz = 1000;
    const CaseResult reference = run_case(c);
    least = std::min(least, reference.force);
    at_rest = std::max(at_rest, std::abs(reference.force_most / reference.force_least - 1));
    for (const double rate :
         runs.effort == Effort::full ? std::vector<double>{20, 60, 150} : std::vector<double>{60})
      for (const double delay : {5e-3, 50e-3}) {
        c.rate_Hz = rate;
        c.link.delay = delay;
        worst = std::max(worst, std::abs(run_case(c).force / reference.force - 1));
        ++cases;
      }
  }
  return {"S4", "real tissue: the force held at other rates and delays against 1 kHz without delay",
          "within 2 %",
          fmt::format("{} cases: off by {:.2f} %; at 1 kHz it holds still within {:.2f} %, {:.2f} N at least",
                      cases, 100 * worst, 100 * at_rest, least),
          worst <= 0.02 && at_rest <= 0.02 && least > 0.5};
}

Row world_silence_fades() {
  std::vector<Case> cases;
  for (const SlabModel& slab : slab_models)
    for (const double rate : {20.0, 1000.0}) {
      cases.push_back(case_of(slab));
      cases.back().rate_Hz = rate;
    }
  const Silence s = silence_in(cases);
  return {"F1", "real tissue: physics dies in contact, 20 and 1000 Hz",
          "stale; falls steadily to 0 N within 400 ms; steps <= K (v T + q) + 0.1 N; G <= 0.1 mJ; ready "
          "within 0.1 s of "
          "its return",
          text_of(s), fades(s, world_step_limit)};
}

Row world_return_is_no_kick() {
  std::vector<Case> cases;
  for (const SlabModel& slab : slab_models) {
    cases.push_back(case_of(slab));
    cases.back().rate_Hz = 150;
  }
  const Return r = return_in(cases, {0.1, 1.0});
  const double least_again = *std::min_element(r.again.begin(), r.again.end());
  return {
      "F2", "real tissue: physics falls silent for 0.1 and 1 s with the tool inside",
      "after 1 s: 0 N until the tool has left; steps <= K (v T + q) + 0.1 N; bound on plane work kept; felt "
      "again later",
      fmt::format(
          "inside {:g} N; beyond K v T {:.3f} N; plane work {:+.3f} mJ of its bound; {:.2f} N again at least",
          r.inside, r.step, 1e3 * r.excess, least_again),
      r.inside == 0 && r.step <= world_step_limit && r.excess <= 1e-9 && least_again > 0.3};
}

namespace {

struct StickTally {
  int cases = 0, above_200_um = 0;
  double swing = 0, surplus = 0, excess = -1, step = -1, untrue = 0;
};
/// A stick pressed into a slab by all hands. @param torque_limit  of the device [N m]
StickTally press_stick(const Runs& runs, double torque_limit) {
  std::vector<Case> bases;
  for (const HandSpring& hand : holding_hands) {
    bases.push_back(case_of(stick_slab));
    bases.back().hand = hand;
    bases.back().torque_limit = torque_limit;
  }
  MatrixSize size;
  size.losses = {0.1};
  if (runs.effort == Effort::quick) size = {{60, 1000}, {0, 50e-3}, {0.1}, {}};
  StickTally t;
  for (const CaseResult& r : run_cases(chosen(over_links(bases, size), runs.effort, 6), runs.jobs)) {
    const double swing = std::max(r.swing, r.sideways);
    t.cases += 1;
    t.above_200_um += swing > 200e-6;
    t.swing = std::max(t.swing, swing);
    t.surplus = std::max(t.surplus, r.surplus);
    t.excess = std::max(t.excess, r.plane_excess);
    t.step = std::max(t.step, r.step_beyond);
    t.untrue = std::max(t.untrue, std::abs(r.force / r.tissue_force - 1));
  }
  return t;
}

Row steady_stick(const Runs& runs, const char* what, double torque_limit) {
  const StickTally t = press_stick(runs, torque_limit);
  return {
      "S12", what,
      "none above 200 um, along or sideways; energy bounds; steps <= K (v T + q) + 0.1 N; what is felt is "
      "what the "
      "tissue presses with, within 2 %",
      fmt::format(
          "{} cases: {} above 200 um, most {:.0f} um; G {:.3f} mJ, work {:+.3f} mJ of its bound; {:.3f} N "
          "beyond K v T; force off by {:.2f} %",
          t.cases, t.above_200_um, 1e6 * t.swing, 1e3 * t.surplus, 1e3 * t.excess, t.step, 100 * t.untrue),
      t.above_200_um == 0 && t.surplus <= EnergyBook::G_allowed && t.excess <= 1e-9 &&
          t.step <= world_step_limit && t.untrue <= 0.02};
}

}  // namespace

/// By the plane under it.
Row stick_is_steady(Runs& runs) {
  return steady_stick(
      runs, "real tissue: a stick pressed into a slab of 100 kPa, 3 hands, 10 % loss; device without torques",
      0);
}

/// By the spring of six dimensions that stands there before it is touched.
Row stick_with_torques_is_steady(Runs& runs) {
  return steady_stick(runs, "the same on a device with torques, which end at 0.02 N m", 0.02);
}

}  // namespace palpate::bench
