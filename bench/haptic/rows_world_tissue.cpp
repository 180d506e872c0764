// Rows of tissue that the hand's motion presses, in three dimensions, with the real physics library and the real controller.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench/haptic/rows.h"
#include "bench/haptic/same_samples.h"
#include "bench/haptic/world_cases.h"

namespace palpate::bench {
namespace {

constexpr std::array elastic_slabs{&slab_models[0], &slab_models[1], &solid_slabs[0], &solid_slabs[1]};
constexpr std::array all_slabs{&slab_models[0], &slab_models[1], &slab_models[2],
                               &solid_slabs[0], &solid_slabs[1], &stick_slab};

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

/// 2 mm deep, and from 0.5 s on 20 mm along x.
Path slide_path(double speed) {
  return [speed](double t) {
    constexpr double from = 5e-3, depth = 2e-3, in = 0.4, begin = 0.5, half = 10e-3;
    Aim aim{{-half, 0, -depth}, Vec3::Zero()};
    if (t < in) return Aim{{-half, 0, from - (from + depth) * t / in}, {0, 0, -(from + depth) / in}};
    const double way = speed * std::max(0.0, t - begin);
    aim.q.x() += std::min(way, 2 * half);
    if (way > 0 && way < 2 * half) aim.q_dot.x() = speed;
    return aim;
  };
}

/// Root mean square of felt less borne over that of what swings of borne.
double off_of_swing(const SameSamples& same) {
  double mean = 0, n = 0, off2 = 0, swing2 = 0;
  same.visit([&](const Vec3&, const Vec3& borne) { mean += borne.norm(), ++n; });
  same.visit([&](const Vec3& felt, const Vec3& borne) {
    off2 += (felt - borne).squaredNorm();
    swing2 += (borne.norm() - mean / n) * (borne.norm() - mean / n);
  });
  return std::sqrt(off2 / swing2);
}

/// Along an axis, over the root mean square of what is borne along z.
double off_along(const SameSamples& same, int axis) {
  double off2 = 0, normal2 = 0;
  same.visit([&](const Vec3& felt, const Vec3& borne) {
    off2 += (felt - borne)[axis] * (felt - borne)[axis];
    normal2 += borne.z() * borne.z();
  });
  return std::sqrt(off2 / normal2);
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
          "real tissue pressed by the hand's motion, 3-D: three slabs of springs, two of elements, one under "
          "a stick; "
          "Touch, 3 hands",
          "none above 200 um, <= 1 % above 100 um, energy bounds in all, steps <= K (v T + q) + 0.1 N",
          world_figure(t), keeps_S2(t) && t.step_beyond_most <= world_step_limit};
}

/// At every frame. Of a swing that has but one frame a half of it or fewer, frames see what they happen to: world_tissue_swings() has
/// these.
Row world_tissue_is_true(Runs& runs) {
  double worst = 0, step = -1, surplus = 0;
  std::string figure;
  for (const LinkAge& age : link_ages) {
    figure += fmt::format("{}{}:", figure.empty() ? "" : "; ", age.name);
    for (const double frequency :
         runs.effort == Effort::full ? std::vector<double>{1, 5, 10, 20} : std::vector<double>{5}) {
      if (2 * frequency >= age.rate_Hz) continue;
      double off = 0;
      for (const SlabModel* slab : elastic_slabs) {
        const Case c = slab_case(*slab, age);
        const SameSamples same = follow(c, swing_path(frequency), 1.5, 4.0);
        off = std::max(off, off_of_swing(same));
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

/// A stick that lies on a slab and stands: felt and borne, at three ages.
Row world_tissue_bears_a_stick(Runs&) {
  double off = 0, surplus = 0, step = -1;
  std::string figure;
  for (const LinkAge& age : link_ages) {
    const Case c = slab_case(stick_slab, age);
    const SameSamples same = follow(c, slide_path(0), 1.0, 1.2);
    double felt = 0, borne = 0;
    same.visit([&](const Vec3& f, const Vec3& b) { felt += f.norm(), borne += b.norm(); });
    off = std::max(off, borne > 0 ? std::abs(felt / borne - 1) : 1.0);
    figure += fmt::format("{}{}: {:.4f}", figure.empty() ? "" : "; ", age.name, felt / borne);
    surplus = std::max(surplus, same.surplus);
    step = std::max(step, same.step);
  }
  return {"T14", "a stick that lies on a slab of springs, pressed 2 mm deep and held: felt over borne",
          "within 2 %; G <= 0.1 mJ",
          fmt::format("{}; {:.3f} N beyond K v T; G {:.3f} mJ", figure, step, 1e3 * surplus),
          off <= 0.02 && surplus <= EnergyBook::G_allowed};
}

Row world_tissue_slides(Runs& runs) {
  std::string figure;
  double worst_normal = 0, worst_along = 0, step = -1, surplus = 0;
  for (const double friction : {0.0, 0.3})
    for (const double speed : runs.effort == Effort::full ? std::vector<double>{10e-3, 50e-3, 100e-3}
                                                          : std::vector<double>{50e-3}) {
      double normal = 0, along = 0;
      for (const LinkAge& age : link_ages)
        for (const SlabModel* slab : elastic_slabs) {
          if (runs.effort == Effort::quick && slab != &slab_models[0] && slab != &solid_slabs[1]) continue;
          Case c = slab_case(*slab, age);
          c.friction = friction;
          const SameSamples same = follow(c, slide_path(speed), 0.5, 0.5 + 20e-3 / speed);
          normal = std::max(normal, off_along(same, 2));
          along = std::max(along, off_along(same, 0));
          step = std::max(step, same.step);
          surplus = std::max(surplus, same.surplus);
        }
      figure += fmt::format("{}mu {}, {:.0f} mm/s: {:.1f} and {:.1f} %", figure.empty() ? "" : "; ", friction,
                            1e3 * speed, 100 * normal, 100 * along);
      worst_normal = std::max(worst_normal, normal);
      worst_along = std::max(worst_along, along);
    }
  return {"T11",
          "real tissue pressed 2 mm deep by the hand's motion, slid 20 mm along it, three ages: felt less "
          "borne at the "
          "same sample, normal and along",
          "root mean square within 15 % along the normal, of which most is what a sphere of 5 mm feels of "
          "cells of 4 mm, and within 5 % along the way; G <= 0.1 mJ",
          fmt::format("{}; {:.3f} N beyond K v T; G {:.3f} mJ", figure, step, 1e3 * surplus),
          worst_normal <= 0.15 && worst_along <= 0.05 && surplus <= EnergyBook::G_allowed};
}

}  // namespace palpate::bench
