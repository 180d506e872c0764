#include <fmt/format.h>

#include <algorithm>

#include "bench/haptic/rows.h"

namespace palpate::bench {
namespace {

std::vector<CaseResult> run(Runs& runs, const std::vector<Case>& cases) {
  std::vector<CaseResult> results = run_cases(cases, runs.jobs);
  runs.seen.insert(runs.seen.end(), results.begin(), results.end());
  return results;
}

std::string figure_of(const Tally& t) {
  return fmt::format(
      "{} cases: {} above 200 um, {} above 100 um, {} break an energy bound, {} not felt; most {:.0f} um, G "
      "{:.3f} "
      "mJ",
      t.cases, t.above_200_um, t.above_100_um, t.energy_broken, t.unfelt, 1e6 * t.swing_most,
      1e3 * t.surplus_most);
}

/// Stiffest wall that a hand can hold still, to 1 % [N/m]; up to 8000.
double stiffest(Case c) {
  double low = 100, high = 8000;
  while (high / low > 1.01) {
    c.stiffness = std::sqrt(low * high);
    const CaseResult pressed = run_case(c);
    const bool still = pressed.swing < 100e-6 && pressed.felt();
    (still ? low : high) = c.stiffness;
  }
  return low;
}

}  // namespace

Row direct_and_raw_are_unstable(Runs& runs) {
  Case direct;
  direct.mode = RenderMode::direct;
  direct.stiffness = 1000;
  direct.object = object_models[0];
  direct.rate_Hz = 20;
  direct.link.delay = 20e-3;
  const double swing = run_case(direct).swing;
  MatrixSize size;
  size.losses = {0, 0.1};
  size.stiffnesses = {500};
  const auto cases = chosen(matrix(device_models[0], size, RenderMode::raw_planes), runs.effort, 48);
  runs.raw = run_cases(cases, runs.jobs);
  const Tally raw = tally(runs.raw);
  return {"S0", "negative controls: direct force, K 1000, 20 Hz, 20 ms; raw planes, K 500, Touch",
          "both unstable: > 200 um; > 100 of 384 cases",
          fmt::format("direct {:.1f} mm; raw planes {} of {} cases above 200 um", 1e3 * swing,
                      raw.above_200_um, raw.cases),
          swing > 200e-6 && raw.above_200_um * 384 > 100 * raw.cases};
}

Row wall_is_stable(Runs& runs) {
  std::vector<Case> cases;
  for (const DeviceModel& device : {device_models[0], device_models[1], device_models[2]}) {
    MatrixSize size;
    size.stiffnesses = {1000};
    for (const Case& c : matrix(device, size, RenderMode::local))
      if (c.object.mass <= 0) cases.push_back(against_wall(c));
  }
  const auto results = run(runs, chosen(cases, runs.effort, 36));
  const Tally t = tally(results);
  const bool quiet = std::all_of(results.begin(), results.end(), is_still);
  return {"S1",
          "static wall; K 1000, B 2 Touch and omega, K 500, B 1 Premium; all hands, rates, delays, losses",
          "p-p <= max(2 resolution, 100 um), G <= 0.1 mJ", figure_of(t),
          quiet && t.energy_broken == 0 && t.unfelt == 0};
}

Row stiffest_wall(Runs& runs) {
  std::vector<Case> cases;
  for (const double rate : {20.0, 1000.0})
    for (const double delay : {0.0, 50e-3}) {
      Case c;
      c.device = device_models[1];
      c.rate_Hz = rate;
      c.link.delay = delay;
      cases.push_back(c);
    }
  if (runs.effort == Effort::quick) cases.erase(cases.begin() + 1, cases.begin() + 3);
  double low = 1e9, high = 0;
  for (const Case& c : cases) {
    const double k = stiffest(c);
    low = std::min(low, k);
    high = std::max(high, k);
  }
  return {"S1", "stiffest static wall, Premium, pinch, 20 and 1000 Hz, 0 and 50 ms",
          "varies by < 5 % over rate and delay",
          fmt::format("{:.0f} to {:.0f} N/m ({:.1f} %)", low, high, 100 * (high / low - 1)),
          high / low < 1.05 && low > 100};  // 100: none was held still and felt
}

Row matrix_is_stable(Runs& runs) {
  const Tally t = tally(run(runs, chosen(all_devices({}), runs.effort, 96)));
  return {"S2", "4 devices x 3 hands x 4 objects x 4 rates x 4 delays x 3 losses, K 300 and 500",
          "none above 200 um, <= 1 % above 100 um, energy bounds in all", figure_of(t), keeps_S2(t)};
}

Row push_without_a_hand_gains_nothing(Runs& runs) {
  MatrixSize size;
  size.losses = {0};
  const std::vector<Case> cases = without_a_hand(size);
  const Tally t = tally(run_cases(chosen(cases, runs.effort, 24), runs.jobs));
  return {"S2", "no hand: the handle falls 20 mm under 1 N and bounces; K 300 and 500",
          "energy bounds in all",
          fmt::format("{} cases: {} break an energy bound, {} not felt; G {:.3f} mJ", t.cases,
                      t.energy_broken, t.unfelt, 1e3 * t.surplus_most),
          t.energy_broken == 0 && t.unfelt == 0};
}

Row stiff_matrix_is_stable(Runs& runs) {
  MatrixSize size;
  size.stiffnesses = {1000};
  std::vector<Case> cases = chosen(all_devices(size), runs.effort, 48);
  for (Case& c : cases) c.damping = damping_for(c.stiffness);
  const Tally t = tally(run(runs, cases));
  return {"S3", "the same at K 1000, B 2", "<= 1 % above 300 um, energy bounds in all",
          fmt::format("{} cases: {} above 300 um, {} break an energy bound, {} not felt; most {:.0f} um, G "
                      "{:.3f} mJ",
                      t.cases, t.above_300_um, t.energy_broken, t.unfelt, 1e6 * t.swing_most,
                      1e3 * t.surplus_most),
          t.above_300_um * 100 <= t.cases && t.energy_broken == 0 && t.unfelt == 0};
}

Row unruly_links_are_borne(Runs& runs) {
  MatrixSize size;
  size.losses = {0.01};
  std::vector<Case> cases = chosen(all_devices(size), runs.effort, 48);
  for (Case& c : cases) {
    c.link.jitter = 25e-3;
    c.link.duplicate = 0.2;
  }
  const Tally t = tally(run(runs, cases));
  return {"N1", "S2 with 0 to 25 ms of jitter (which reorders), 20 % duplicates, 1 % loss", "as S2",
          figure_of(t), keeps_S2(t)};
}

/// Nothing for 100 ms once a second, then all at once: the hand lives through it on the planes that it has.
Row gaps_are_borne(Runs& runs) {
  MatrixSize size;
  size.losses = {0};
  std::vector<Case> cases = chosen(all_devices(size), runs.effort, 48);
  for (Case& c : cases) c.link.gap = 0.1;
  const Tally t = tally(run(runs, cases));
  return {"N1", "S2 with gaps of 100 ms once a second, each way, after which all comes at once", "as S2",
          figure_of(t), keeps_S2(t)};
}

/// Stamps of another machine mean nothing to the hand: ages are of its own clock.
Row clocks_may_differ(const Runs& runs) {
  MatrixSize size;
  size.losses = {0.1};
  std::vector<Case> cases = chosen(matrix(device_models[0], size, RenderMode::local), runs.effort, 12);
  int differ = 0, unfelt = 0;
  for (const double ahead : {-5.0, 5.0}) {
    std::vector<Case> moved = cases;
    for (Case& c : moved) c.clock_ahead = ahead;
    const auto a = run_cases(cases, runs.jobs), b = run_cases(moved, runs.jobs);
    unfelt += tally(a).unfelt;
    for (std::size_t i = 0; i < a.size(); ++i)
      differ += a[i].swing != b[i].swing || a[i].force != b[i].force || a[i].surplus != b[i].surplus;
  }
  return {"N1", "the clock of physics 5 s behind and 5 s ahead of the hand's",
          "the same bits as with one clock",
          fmt::format("{} of {} pairs of cases differ, {} not felt", differ, 2 * cases.size(), unfelt),
          differ == 0 && unfelt == 0};
}

}  // namespace palpate::bench
