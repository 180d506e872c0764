#pragma once
// What is felt of a surface, on its way to what physics knows, as model_fade.h has it along a normal:
//
//   (q, w, r, xi) += beta ((q, w, r, xi)* - (q, w, r, xi)),    beta the largest in [0, 1 - exp(-h / tau)] for which
//   H rises by no more than the tank holds, and F changes by no more than a given step
//
// Both states are of one model: as long as a tip touches, modes are the same ones. In the air it pays as well.
// Deviation: no quick fall after events; a cut changes the modes, which is not told yet.

#include "haptic_node/contact/work_tank.h"
#include "haptic_node/tissue/surface_step.h"

namespace palpate::haptic {

SurfaceState mixed(const SurfaceState& felt, const SurfaceState& shadow, double beta) noexcept;

struct SurfaceFade {
  static constexpr double tau = 50e-3;  // [s]

  /// One tick: moves `felt` towards `shadow`, both with the tip at x.
  /// @param force_step  most change of F [N]
  /// @return energy that it put into the felt state, taken from the tank [J]
  static double pass(const SurfaceModel& model, const SurfaceStep& step, SurfaceState& felt,
                     const SurfaceState& shadow, const Vec3& x, double force_step, WorkTank& tank) noexcept;
};

}  // namespace palpate::haptic
