// Rows of the coupling that feels a copy of tissue: hands that give, over all devices and links, with models that are wrong.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/haptic/rows_touch.h"
#include "bench/haptic/world_cases.h"

namespace palpate::bench {
namespace {

/// Each error on cases of its own: the k-th of n on every n-th case, and on all of them in a full run.
std::vector<CaseResult> run_with(Runs& runs, const std::vector<ModelError>& errors, std::size_t wanted,
                                 std::size_t full) {
  std::vector<Case> cases;
  const std::size_t each = runs.effort == Effort::full ? full : wanted / errors.size() + 1;
  for (const ModelError& error : errors)
    for (Case c : chosen(all_devices({}, RenderMode::copy), Effort::quick, each)) {
      c.told = error;
      cases.push_back(c);
    }
  return run_cases(cases, runs.jobs);
}

constexpr const char* limit_of_S2 =
    "none above 200 um, <= 1 % above 100 um, energy bounds in all, steps <= K (v T + q) + 0.1 N";

}  // namespace

Row copy_is_stable(Runs& runs) {
  const auto results = run_cases(chosen(all_devices({}, RenderMode::copy), runs.effort, 96), runs.jobs);
  runs.copied = results;
  const Tally t = tally(results);
  return {"S2", "copy of tissue: the matrix of S2", limit_of_S2, world_figure(t),
          keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

Row copy_gains_nothing_without_a_hand(Runs& runs) {
  MatrixSize size;
  size.losses = {0, 0.1};
  const std::vector<Case> cases = without_a_hand(size, RenderMode::copy);
  const Tally t = tally(run_cases(chosen(cases, runs.effort, 96), runs.jobs));
  return {"S2", "copy of tissue, no hand: the handle falls 20 mm under 1 N and bounces",
          "energy bounds in all",
          fmt::format("{} cases: {} break an energy bound, {} not felt; G {:.3f} mJ", t.cases,
                      t.energy_broken, t.unfelt, 1e3 * t.surplus_most),
          t.energy_broken == 0 && t.unfelt == 0};
}

Row copy_bears_wrong_models(Runs& runs) {
  std::vector<ModelError> errors;
  for (const double factor : {0.75, 1.33}) {
    errors.push_back({factor, 1, 1});
    errors.push_back({1, factor, 1});
    errors.push_back({1, 1, factor});
    errors.push_back({factor, factor, factor});
  }
  const Tally t = tally(run_with(runs, errors, 96, 420));
  return {"T6", "S2 with mass, damping and stiffness told wrong by 0.75 and 1.33, one and all", limit_of_S2,
          world_figure(t), keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

Row copy_bears_a_wrong_first_touch(Runs& runs) {
  std::vector<ModelError> errors;
  for (const double factor : {0.5, 2.0, 4.0}) errors.push_back({1, 1, factor, 0.15});
  const Tally t = tally(run_with(runs, errors, 48, 420));
  return {"T6",
          "S2 with a stiffness told wrong by 0.5, 2 and 4 at first touch and right after 0.15 s of contact",
          limit_of_S2, world_figure(t), keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

Row copy_keeps_energy_with_any_model(Runs& runs) {
  std::vector<ModelError> errors;
  for (const double m : {0.5, 1.0, 2.0})
    for (const double c : {0.5, 1.0, 2.0})
      for (const double k : {0.5, 1.0, 2.0})
        if (m != 1 || c != 1 || k != 1) errors.push_back({m, c, k});
  const Tally t = tally(run_with(runs, errors, 104, 104));
  return {"T7", "S2 with mass, damping and stiffness told wrong by factors of 2, all 26 of them",
          "energy bounds in all",
          fmt::format("{} cases: {} break an energy bound, G {:.3f} mJ; {} swing or creep by more than 200 "
                      "um, most {:.2f} "
                      "mm (not judged)",
                      t.cases, t.energy_broken, 1e3 * t.surplus_most, t.above_200_um, 1e3 * t.swing_most),
          t.energy_broken == 0};
}

Row extrapolated_force_is_unstable(Runs& runs) {
  const Tally t = tally(run_cases(chosen(all_devices({}, RenderMode::extrapolated), Effort::quick,
                                         runs.effort == Effort::full ? 1536 : 96),
                                  runs.jobs));
  return {"T8", "negative control: the force that tissue bore, continued with its stiffness, without a tank",
          "more than 5 % of the cases above 200 um",
          fmt::format("{} of {} cases above 200 um, most {:.1f} mm; G {:.0f} mJ", t.above_200_um, t.cases,
                      1e3 * t.swing_most, 1e3 * t.surplus_most),
          t.above_200_um * 20 > t.cases};
}

Row pulse_is_felt_by_copy(Runs&) {
  Case c;
  c.hand = hand_springs[2];
  c.stiffness = 1000;
  c.damping = damping_for(c.stiffness);
  const auto beat = [](Tissue& tissue, double t) {
    tissue.set_base(1e-3 * std::sin(2 * std::numbers::pi * 1.2 * std::max(t, 0.0)));
  };
  Case ideal = c;
  ideal.mode = RenderMode::raw_planes;
  ideal.rate_Hz = 1000;
  c.mode = RenderMode::copy;
  const CaseResult reference = run_case(ideal, beat);
  const double range = reference.force_most - reference.force_least;
  double worst = 0, worst_slow = 0, surplus = 0;
  for (const double rate : {20.0, 60.0, 150.0, 1000.0})
    for (const double delay : {0.0, 5e-3, 20e-3, 50e-3}) {
      c.rate_Hz = rate;
      c.link.delay = delay;
      const CaseResult r = run_case(c, beat);
      double& most = rate < 60 ? worst_slow : worst;
      most = std::max(most, std::abs((r.force_most - r.force_least) / range - 1));
      surplus = std::max(surplus, r.surplus);
    }
  return {
      "T9", "copy of tissue: S5, a wall that beats by 1 mm at 1.2 Hz, K 1000, B 2, firm hand, Touch",
      "range of force within 10 % (15 % at 20 Hz), G <= 0.1 mJ",
      fmt::format("reference {:.2f} to {:.2f} N; off by {:.1f} % (20 Hz: {:.1f} %); G {:.3f} mJ",
                  reference.force_least, reference.force_most, 100 * worst, 100 * worst_slow, 1e3 * surplus),
      worst <= 0.10 && worst_slow <= 0.15 && surplus <= EnergyBook::G_allowed};
}

}  // namespace palpate::bench
