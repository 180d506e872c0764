#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/haptic/rows.h"
#include "bench/haptic/world_cases.h"

namespace palpate::bench {
namespace {

void beat(Tissue& tissue, double t) {
  tissue.set_base(1e-3 * std::sin(2 * std::numbers::pi * 1.2 * std::max(t, 0.0)));
}

}  // namespace

Row force_is_true(Runs& runs) {
  MatrixSize size;
  size.losses = {0};
  std::vector<Case> cases = matrix(device_models[3], size, RenderMode::local);
  if (runs.effort == Effort::quick) {
    std::vector<Case> some;
    for (std::size_t i = 0; i < cases.size(); i += 11) some.push_back(cases[i]);
    cases = some;
  }
  const auto results = run_cases(cases, runs.jobs);
  runs.seen.insert(runs.seen.end(), results.begin(), results.end());
  double error = 0, late = -10;
  int slow = 0;
  for (const CaseResult& r : results) {
    error = std::max(error, std::abs(r.force - 1.0));
    const double over = r.settled - (0.5 + 2 * r.c.link.delay + 2 / r.c.rate_Hz);
    late = std::max(late, over);
    slow += over > 0;
  }
  return {"S4", "1 N held without friction, all hands, objects, rates, delays",
          "force within 2 % of 1 N; within 5 % after 0.5 s + 2 d + 2 / f",
          fmt::format("{} cases: off by {:.2f} %; {} settle late, the last by {:.2f} s", results.size(),
                      100 * error, slow, std::max(late, 0.0)),
          error <= 0.02 && slow == 0};
}

namespace {

Row beat_against(Runs& runs, const Case& base, const char* what) {
  Case c = base;
  c.hand = hand_springs[2];
  c.stiffness = 1000;
  c.damping = 2;
  Case ideal = c;
  ideal.mode = RenderMode::raw_planes;
  ideal.rate_Hz = 1000;
  const CaseResult reference = run_case(ideal, beat);
  const double range = reference.force_most - reference.force_least;
  double worst = 0, worst_slow = 0;
  for (const double rate : {20.0, 60.0, 150.0, 1000.0})
    for (const double delay : {0.0, 5e-3, 20e-3, 50e-3}) {
      c.rate_Hz = rate;
      c.link.delay = delay;
      const CaseResult r = run_case(c, beat);
      runs.seen.push_back(r);
      const double error = std::abs((r.force_most - r.force_least) / range - 1);
      double& most = rate < 60 ? worst_slow : worst;
      most = std::max(most, error);
    }
  return {"S5", what, "range of force within 10 % (15 % at 20 Hz)",
          fmt::format("reference {:.2f} to {:.2f} N; off by {:.1f} % (20 Hz: {:.1f} %)",
                      reference.force_least, reference.force_most, 100 * worst, 100 * worst_slow),
          worst <= 0.10 && worst_slow <= 0.15};
}

}  // namespace

Row pulse_is_felt(Runs& runs) {
  return beat_against(
      runs, {},
      "wall that beats by 1 mm at 1.2 Hz, K 1000, B 2, firm hand, Touch, against a plane without lag");
}
Row world_pulse_is_felt(Runs& runs) {
  return beat_against(runs, case_of(held_slab),
                      "the same with a held slab of real physics on a table that beats");
}

Row force_steps_are_small(const Runs& runs) {
  const Tally t = tally(runs.seen);
  return {"S6", "force steps in a tick, in all cases above", "<= K (v T + q) + 0.1 N, <= 0.3 N",
          fmt::format("{} cases: most {:.3f} N, beyond K v T {:.3f} N", t.cases, t.force_step_most,
                      t.step_beyond_most),
          t.force_step_most <= 0.3 && t.step_beyond_most <= 0.1};
}

namespace {

Row wave_above(const Case& base, const char* what) {
  double most = 0, energy = 0;
  int ticks = 0, unready = 0;
  for (const DeviceModel& device : device_models) {
    Case c = base;
    c.device = device;
    Trial trial(c, [](double t) {
      Aim aim;
      aim.q = {0.01 * std::sin(5 * t), 0, 0.01 + 0.008 * std::cos(7 * t)};
      aim.q_dot = {0.05 * std::cos(5 * t), 0, -0.056 * std::sin(7 * t)};
      return aim;
    });
    trial.run(5.0, [&] {
      most = std::max(most, trial.rendered().force.norm());
      if (trial.t() < 0) return;  // the lead-in, in which it arms
      ++ticks;
      unready += trial.controller().state() != haptic::HapticState::run;
    });
    energy = std::max(energy, std::abs(trial.energy().port()));
  }
  // A controller that never arms gives no force either: without `run` the row would say nothing.
  return {"S10", what, "force and energy exactly 0, always in state run",
          fmt::format("{:g} N, {:g} J, {} of {} ticks not in run", most, energy, unready, ticks),
          most == 0 && energy == 0 && ticks > 0 && unready == 0};
}

Row press_too_hard(const Case& base, const char* what) {
  double swing = 0, turned = 0, surplus = 0, over = 0, reached = 1;
  for (const DeviceModel& device : device_models)
    for (const HandSpring& hand : holding_hands) {
      Case c = base;
      c.device = device;
      c.hand = hand;
      const double pushed = 2 * device.force_limit;
      const double depth = pushed * (1 / c.stiffness + 1 / hand.stiffness);
      // From 3 cm above and aside: the hand comes in at 45 degrees and rests.
      const double down = 0.1 + depth / 0.3;
      Trial trial(c, [depth, down](double t) {
        const double s = std::min(t / down, 1.0);
        Aim aim;
        aim.q = {0.02 * s, 0, 0.02 - (0.02 + depth) * s};
        if (s < 1) aim.q_dot = Vec3(0.02, 0, -(0.02 + depth)) / down;
        return aim;
      });
      double low = 1, high = -1, most = 0;
      const double end = down + 3;
      trial.run(end, [&] {
        const Vec3 f = trial.rendered().force;
        most = std::max(most, f.norm() / device.force_limit);
        if (f.z() > 0) turned = std::max(turned, std::atan2(std::hypot(f.x(), f.y()), f.z()));
        if (trial.t() < end - 1) return;
        low = std::min(low, trial.plant().x().z());
        high = std::max(high, trial.plant().x().z());
      });
      swing = std::max(swing, high - low);
      over = std::max(over, most - 1);
      reached = std::min(reached, most);
      surplus = std::max(surplus, trial.energy().surplus());
    }
  return {"S11", what, "limit reached and kept, direction within 0.1 deg, p-p <= 200 um, G <= 0.1 mJ",
          fmt::format("{:.1f} % of the limit at least, over it by {:.1g}, {:.2g} deg, {:.0f} um, G {:.3f} mJ",
                      100 * reached, std::max(over, 0.0), turned * 180 / std::numbers::pi, 1e6 * swing,
                      1e3 * surplus),
          reached > 0.99 && over <= 1e-12 && turned * 180 / std::numbers::pi <= 0.1 && swing <= 200e-6 &&
              surplus <= EnergyBook::G_allowed};
}

}  // namespace

Row free_space_is_free(double loss) {
  Case c;
  c.link.loss = loss;
  return wave_above(c, "a hand that waves 2 to 18 mm above the surface, all devices");
}
Row world_free_space_is_free() {
  Case c = case_of(slab_models[0]);
  c.link.loss = 0.01;
  return wave_above(c, "the same above real tissue");
}

Row saturation_is_quiet() {
  return press_too_hard({}, "twice the peak force pressed, all devices and hands, K 500");
}
Row world_saturation_is_quiet() {
  return press_too_hard(case_of(held_slab), "the same on a slab of real physics whose masses are all held");
}

}  // namespace palpate::bench
