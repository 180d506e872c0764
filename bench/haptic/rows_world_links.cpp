// More rows in three dimensions with the real physics library: a stiffer hand spring, a wall, an edge, links that misbehave.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/haptic/rows.h"
#include "bench/haptic/world_cases.h"

namespace palpate::bench {

/// Every mass held: physics has nothing to step, the facets are as stiff as can be.
Row world_wall_is_stable(Runs& runs) {
  std::vector<Case> bases;
  for (const DeviceModel& device : {device_models[0], device_models[1], device_models[2]})
    for (const HandSpring& hand : holding_hands) {
      Case c = case_of(held_slab);
      c.device = device;
      c.hand = hand;
      bases.push_back(against_wall(c));
    }
  MatrixSize size;
  size.losses = {0, 0.1};
  const auto results = run_cases(chosen(over_links(bases, size), runs.effort, 18), runs.jobs);
  const Tally t = tally(results);
  const bool quiet = std::all_of(results.begin(), results.end(), is_still);
  return {"S1", "real physics, 3-D: a slab whose masses are all held, as S1",
          "p-p <= max(2 resolution, 100 um), G <= 0.1 mJ, steps <= K (v T + q) + 0.1 N", world_figure(t),
          quiet && t.energy_broken == 0 && t.unfelt == 0 && t.step_beyond_most <= world_step_limit};
}

Row world_bears_a_stiff_spring(Runs& runs) {
  std::vector<Case> cases;
  for (Case c : world_cases(runs.effort, RenderMode::local, device_models[0])) {
    if (c.link.loss <= 0) continue;
    c.stiffness = 1000;
    c.damping = damping_for(c.stiffness);
    cases.push_back(c);
  }
  const Tally t = tally(run_cases(cases, runs.jobs));
  return {"S3", "real tissue, Touch, 10 % loss, K 1000, B 2",
          "<= 1 % above 300 um, energy bounds in all, steps <= K (v T + q) + 0.1 N", world_figure(t),
          t.above_300_um * 100 <= t.cases && t.energy_broken == 0 && t.unfelt == 0 &&
              t.step_beyond_most <= world_step_limit};
}

Row world_bears_unruly_links(Runs& runs) {
  std::vector<Case> cases;
  for (Case c : world_cases(runs.effort, RenderMode::local, device_models[0])) {
    c.link.loss = 0;
    if (cases.size() % 2 == 0) {
      c.link.loss = 0.01;
      c.link.jitter = 25e-3;
      c.link.duplicate = 0.2;
    } else {
      c.link.gap = 0.1;
    }
    cases.push_back(c);
  }
  const Tally t = tally(run_cases(cases, runs.jobs));
  return {"N1",
          "real tissue, Touch, K 500: 0 to 25 ms of jitter, 20 % duplicates, 1 % loss; gaps of 100 ms once a "
          "second",
          "as S2", world_figure(t), keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

/// A held slab of 16 mm leaps 6 mm into the hand; slabs are told of only when the hand is in them, nearer to the side below.
Row world_teleports_push_gently() {
  constexpr double when = 2.0;
  double step = -1, excess = -1, surplus = 0, least = 1e9;
  std::vector<const SlabModel*> slabs{nullptr, &held_slab};  // null: the leap
  for (const SlabModel& slab : slab_models) slabs.push_back(&slab);
  for (const SlabModel* slab : slabs)
    for (const double rate : {20.0, 1000.0}) {
      Case c = case_of(slab == nullptr ? held_slab : *slab);
      c.device = device_models[3];
      c.rate_Hz = rate;
      Trial trial(c, press_path(c));
      if (slab == nullptr)
        trial.move_object = [](Tissue& table, double t) { table.set_base(t > when ? 0.006 : 0.0); };
      else
        trial.alter_patch = [&](ContactPatch& patch, const Vec3&) {
          if (trial.t() < when) patch.n_facets = 0;
        };
      trial.run(4.0);
      step = std::max(step, trial.force_step_beyond_motion());
      excess = std::max(excess, trial.energy().plane_excess());
      surplus = std::max(surplus, trial.energy().surplus());
      least = std::min(least, trial.rendered().force.norm());
    }
  return {
      "S7",
      "real physics: a held slab leaps 6 mm into the hand; slabs appear around a hand that is deep in them",
      "steps <= K (v T + q) + 0.1 N, bound on plane work kept, G <= 0.1 mJ; felt in the end",
      fmt::format("beyond K v T {:.3f} N; plane work {:+.3f} mJ of its bound; G {:.3f} mJ; {:.2f} N at least "
                  "after 2 s",
                  step, 1e3 * excess, 1e3 * surplus, least),
      step <= world_step_limit && excess <= 1e-9 && surplus <= EnergyBook::G_allowed && least > 0.1};
}

/// 2 mm deep along a held slab, over its edge and down beside it, 10 mm off; the ball of the tool has a radius of 5 mm.
Row world_edge_has_no_ghost(const Runs& runs) {
  constexpr double edge = 0.042, radius = 5e-3, down = 0.5, depth = 2e-3;
  double beside = 0, on_top = 1e9, step = -1, surplus = 0;
  const std::vector<double> rates =
      runs.effort == Effort::full ? std::vector<double>{20, 60, 150, 1000} : std::vector<double>{20, 1000};
  for (const double rate : rates)
    for (const double delay : {0.0, 50e-3}) {
      Case c = case_of(held_slab);
      c.device = device_models[3];
      c.rate_Hz = rate;
      c.link.delay = delay;
      constexpr double speed = 0.05, over = edge + radius + 5e-3, slid = down + over / speed;
      Trial trial(c, [&](double t) {
        Aim aim;
        if (t < down) {
          aim.q = {0, 0, 0.02 - (0.02 + depth) * t / down};
          aim.q_dot = {0, 0, -(0.02 + depth) / down};
        } else if (t < slid) {
          aim.q = {speed * (t - down), 0, -depth};
          aim.q_dot = {speed, 0, 0};
        } else {
          aim.q = {over, 0, -depth - 0.05 * std::min(t - slid, 0.2)};
          if (t < slid + 0.2) aim.q_dot = {0, 0, -0.05};
        }
        return aim;
      });
      trial.kinematic = true;
      trial.run(slid + 0.3, [&] {
        const double t = trial.t(), force = trial.rendered().force.norm();
        if (t > down + 0.2 && trial.plant().x().x() < edge - 2 * radius) on_top = std::min(on_top, force);
        if (t > slid) beside = std::max(beside, force);
      });
      step = std::max(step, trial.force_step_beyond_motion());
      surplus = std::max(surplus, trial.energy().surplus());
    }
  return {"S8", "real physics: 2 mm deep along a held slab, over its edge and down beside it",
          "felt on top, 0 N beside the edge; steps <= K (v T + q) + 0.1 N; G <= 0.1 mJ",
          fmt::format("on top {:.2f} N at least, beside {:g} N; {:.3f} N beyond K v T; G {:.3f} mJ", on_top,
                      beside, step, 1e3 * surplus),
          on_top > 0.5 && beside == 0 && step <= world_step_limit && surplus <= EnergyBook::G_allowed};
}

}  // namespace palpate::bench
