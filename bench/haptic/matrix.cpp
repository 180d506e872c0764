#include "bench/haptic/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/problems/side_by_side.h"

namespace palpate::bench {
namespace {

Path stay_above(double height) {
  return [height](double) { return Aim{{0, 0, height}, Vec3::Zero()}; };
}

/// Since when the force has been within 5 % of what it ends at [s after the approach].
double settling_time(const std::vector<double>& forces, double end_force) {
  std::size_t n = forces.size();
  while (n > 0 && std::abs(forces[n - 1] - end_force) <= 0.05 * std::abs(end_force)) --n;
  return 1e-3 * static_cast<double>(n);
}

}  // namespace

CaseResult run_case(const Case& c, const std::function<void(Tissue&, double)>& move_object) {
  const bool held = c.hand.stiffness > 0;
  Trial trial(c, held ? press_path(c, 1.0, hold_end) : stay_above(0.02));
  trial.move_object = move_object;
  CaseResult result;
  result.c = c;
  result.force_least = c.device.force_limit;
  std::vector<double> forces;
  Eigen::Array3d low(1, 1, 1), high(-1, -1, -1);
  double sum = 0, tissue = 0;
  int n = 0;
  const double end = held ? hold_end : 6.0;
  if (!held) trial.run(0);
  if (!held) trial.push = {0, 0, -1};
  trial.run(6.0, [&] {
    const double t = trial.t(), z = trial.plant().x().z(), f = trial.rendered().force.z();
    if (t > approach_end && t <= end) forces.push_back(f);
    if (z > 5e-3) result.force_outside = std::max(result.force_outside, trial.rendered().force.norm());
    if (t < end - 1.0 || t > end) return;
    low = low.min(trial.plant().x().array());
    high = high.max(trial.plant().x().array());
    if (trial.world() != nullptr) tissue += trial.world()->world().tool(0).raw_wrench().force.z();
    result.force_least = std::min(result.force_least, f);
    result.force_most = std::max(result.force_most, f);
    sum += f;
    ++n;
    result.unready += c.mode == RenderMode::local && trial.controller().state() != haptic::HapticState::run;
  });
  result.swing = high.z() - low.z();
  result.sideways = (high - low).head<2>().maxCoeff();
  result.tissue_force = tissue / n;
  result.force = sum / n;
  result.settled = settling_time(forces, result.force);
  result.surplus = trial.energy().surplus();
  result.plane_excess = trial.energy().plane_excess();
  result.force_step = trial.force_step();
  result.step_beyond = trial.force_step_beyond_motion();
  return result;
}

std::vector<Case> over_links(const std::vector<Case>& bases, const MatrixSize& size) {
  std::vector<Case> cases;
  for (Case c : bases)
    for (const double rate : size.rates_Hz)
      for (const double delay : size.delays)
        for (const double loss : size.losses) {
          c.rate_Hz = rate;
          c.link.delay = delay;
          c.link.loss = loss;
          c.seed = cases.size() + 1;
          cases.push_back(c);
        }
  return cases;
}

std::vector<Case> matrix(const DeviceModel& device, const MatrixSize& size, RenderMode mode) {
  std::vector<Case> bases;
  for (const double stiffness : size.stiffnesses)
    for (const HandSpring& hand : holding_hands)
      for (const ObjectModel& object : object_models) {
        Case c;
        c.device = device;
        c.hand = hand;
        c.object = object;
        c.stiffness = stiffness;
        c.mode = mode;
        bases.push_back(c);
      }
  return over_links(bases, size);
}

std::vector<Case> all_devices(const MatrixSize& size, RenderMode mode) {
  std::vector<Case> cases;
  for (const DeviceModel& device : device_models) {
    const std::vector<Case> more = matrix(device, size, mode);
    cases.insert(cases.end(), more.begin(), more.end());
  }
  return cases;
}

std::vector<Case> without_a_hand(const MatrixSize& size, RenderMode mode) {
  std::vector<Case> cases;
  for (Case c : all_devices(size, mode))
    if (c.hand.name == hand_springs[0].name) {
      c.hand = hand_springs[3];
      cases.push_back(c);
    }
  return cases;
}

std::vector<Case> chosen(std::vector<Case> cases, Effort effort, std::size_t wanted) {
  if (effort == Effort::full || cases.size() <= wanted) return cases;
  const std::size_t stride =
      cases.size() / wanted + (cases.size() / wanted) % 2 + 1;  // odd: no factor is skipped
  std::vector<Case> some;
  for (std::size_t i = 0; i < cases.size(); i += stride) some.push_back(cases[i]);
  return some;
}

std::vector<CaseResult> run_cases(const std::vector<Case>& cases, int jobs,
                                  const std::function<void(std::size_t)>& done) {
  std::vector<CaseResult> results(cases.size());
  side_by_side(
      cases.size(), jobs, [&](std::size_t i) { results[i] = run_case(cases[i]); }, done);
  return results;
}

Tally tally(const std::vector<CaseResult>& results) {
  Tally all;
  for (const CaseResult& r : results) {
    all.cases += 1;
    const double swing = std::max(r.swing, r.sideways);
    all.above_100_um += swing > 100e-6;
    all.above_200_um += swing > 200e-6;
    all.above_300_um += swing > 300e-6;
    all.energy_broken += !r.energy_kept();
    all.unfelt += !r.felt();
    all.swing_most = std::max(all.swing_most, swing);
    all.surplus_most = std::max(all.surplus_most, r.surplus);
    all.plane_excess_most = std::max(all.plane_excess_most, r.plane_excess);
    all.force_step_most = std::max(all.force_step_most, r.force_step);
    all.step_beyond_most = std::max(all.step_beyond_most, r.step_beyond);
    if (r.c.device.friction <= 0)
      all.force_error_most = std::max(all.force_error_most, std::abs(r.force - 1.0));
  }
  return all;
}

bool keeps_S2(const Tally& t) noexcept {
  return t.above_200_um == 0 && t.above_100_um * 100 <= t.cases && t.energy_broken == 0 && t.unfelt == 0;
}

Case against_wall(Case c) noexcept {
  c.stiffness = c.device.friction > 0.1 ? 1000.0 : 500.0;
  c.damping = damping_for(c.stiffness);
  return c;
}

bool is_still(const CaseResult& r) noexcept {
  return std::max(r.swing, r.sideways) <= std::max(2 * r.c.device.resolution, 100e-6);
}

std::string text_of(const Case& c) {
  return fmt::format("{} {} {} {:g} Hz {:g} ms {:g} % K {:g} seed {}", c.device.name, c.hand.name,
                     c.slab != nullptr ? c.slab->name : c.object.name, c.rate_Hz, 1e3 * c.link.delay,
                     100 * c.link.loss, c.stiffness, c.seed);
}

}  // namespace palpate::bench
