// Rows of tissue that the hand's motion presses, in three dimensions, with the real physics library and the real controller.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "bench/haptic/rows.h"
#include "bench/haptic/world_cases.h"
#include "physics_node/contact/tissue_tool.h"

namespace palpate::bench {
namespace {

constexpr std::array elastic_slabs{&slab_models[0], &slab_models[1], &solid_slabs[0], &solid_slabs[1]};
constexpr std::array all_slabs{&slab_models[0], &slab_models[1], &slab_models[2], &solid_slabs[0],
                               &solid_slabs[1]};

/// 2 mm deep, and from 0.5 s on 0.5 mm to and fro.
Path swing_path(double frequency) {
  return [omega = 2 * std::numbers::pi * frequency](double t) {
    constexpr double from = 5e-3, depth = 2e-3, by = 0.5e-3, in = 0.4, begin = 0.5;
    if (t < in) return Aim{{0, 0, from - (from + depth) * t / in}, {0, 0, -(from + depth) / in}};
    if (t < begin) return Aim{{0, 0, -depth}, Vec3::Zero()};
    const double phase = omega * (t - begin);
    return Aim{{0, 0, -depth - by * std::sin(phase)}, {0, 0, -by * omega * std::cos(phase)}};
  };
}

struct SameSample {
  double off = 0;  // root mean square of felt less borne over that of what swings of borne
  double step = -1, surplus = 0;
};

/// Felt and borne at the same samples of the hand.
SameSample swing(Case c, double frequency) {
  c.feels = ForceModel::tissue;
  Trial trial(c, swing_path(frequency));
  trial.kinematic = true;
  std::map<std::uint64_t, double> felt, borne;
  trial.run(4.0, [&] {
    const haptic::PointTouch& touch = *trial.controller().tissue();
    if (trial.t() < 1.5) return;
    felt[touch.history().newest()] = touch.felt().norm();
    const auto& tool = dynamic_cast<const physics::TissueTool&>(trial.world()->world().tool(0));
    borne[tool.sample()] = tool.borne().norm();
  });
  double mean = 0, off2 = 0, swing2 = 0;
  std::vector<std::pair<double, double>> both;
  for (const auto& [sample, force] : borne)
    if (const auto at = felt.find(sample); at != felt.end()) both.emplace_back(at->second, force);
  for (const auto& pair : both) mean += pair.second / static_cast<double>(both.size());
  for (const auto& [f, b] : both) off2 += (f - b) * (f - b), swing2 += (b - mean) * (b - mean);
  return {std::sqrt(off2 / swing2), trial.force_step_beyond_motion(), trial.energy().surplus()};
}

struct Age {
  const char* name;
  double rate_Hz;
  LinkModel link;
};
std::vector<Age> ages() {
  LinkModel near, far;
  near.delay = 6e-3;
  far.delay = 25e-3;
  far.loss = 0.1;
  return {{"2 ms", 1000, {}}, {"20 ms", 150, near}, {"100 ms", 20, far}};
}

}  // namespace

Row world_tissue_is_stable(Runs& runs) {
  std::vector<Case> bases;
  for (const SlabModel* slab : all_slabs)
    for (const HandSpring& hand : holding_hands)
      for (const double stiffness : {300.0, 500.0}) {
        Case c = case_of(*slab);
        c.feels = ForceModel::tissue;
        c.hand = hand;
        c.stiffness = stiffness;
        bases.push_back(c);
      }
  MatrixSize size;
  size.losses = {0, 0.1};
  if (runs.effort == Effort::quick) size = {{60, 1000}, {5e-3, 50e-3}, {0.1}, {}};
  const Tally t = tally(run_cases(chosen(over_links(bases, size), runs.effort, 6), runs.jobs));
  return {"S2",
          "real tissue pressed by the hand's motion, 3-D: three slabs of springs, two of elements; Touch, 3 "
          "hands",
          "none above 200 um, <= 1 % above 100 um, energy bounds in all, steps <= K (v T + q) + 0.1 N",
          world_figure(t), keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

Row world_tissue_is_true(Runs& runs) {
  double worst = 0, step = -1, surplus = 0;
  std::string figure;
  for (const Age& age : ages()) {
    figure += fmt::format("{}{}:", figure.empty() ? "" : "; ", age.name);
    for (const double frequency :
         runs.effort == Effort::full ? std::vector<double>{1, 5, 10, 20} : std::vector<double>{5}) {
      double off = 0;
      for (const SlabModel* slab : elastic_slabs) {
        Case c = case_of(*slab);
        c.rate_Hz = age.rate_Hz;
        c.link = age.link;
        const SameSample same = swing(c, frequency);
        off = std::max(off, same.off);
        step = std::max(step, same.step);
        surplus = std::max(surplus, same.surplus);
      }
      figure += fmt::format(" {:.1f} % at {:g} Hz", 100 * off, frequency);
      worst = std::max(worst, off);
    }
  }
  return {"T1",
          "real tissue pressed by the hand's motion: 0.5 mm about 2 mm, felt less borne at the same sample",
          "root mean square within 8 % of what swings; G <= 0.1 mJ",
          fmt::format("{}; {:.3f} N beyond K v T; G {:.3f} mJ", figure, step, 1e3 * surplus),
          worst <= 0.08 && surplus <= EnergyBook::G_allowed};
}

}  // namespace palpate::bench
