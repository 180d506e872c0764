#include "physics_node/forecast/speed_forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"

namespace palpate::physics {
namespace {

// A mass and step on one thread, docs/benchmarks.md, `palpate bench kernel`: damped, of the lattice that
// takes longer [s].
constexpr double elastic_s = 30e-9, plastic_s = 50e-9;
constexpr double of_double = 2;  // times as long

bool any_yields(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const MaterialSpec& material) { return material.yield_ratio.has_value(); });
}

}  // namespace

double steps_a_frame(const Scene& scene, double stable_dt) {
  const double frame = 1 / scene.physics.frame_Hz,
               wanted = scene.physics.step.value_or(scene.physics.safety * stable_dt);
  const double steps = std::isfinite(wanted) ? std::max(1.0, std::ceil(frame / wanted - 1e-9)) : 1;
  if (steps <= most_steps_a_frame) return steps;
  throw InputError(fmt::format(
      "{}: a step of {:.2g} s would cut a frame into {:.2g}; {:g} may be: give softer or heavier material, a "
      "wider spacing, or a "
      "longer step",
      scene.physics.place.line == 0 && scene.physics.place.file.empty() ? scene.path
                                                                        : scene.physics.place.text(),
      wanted, steps, most_steps_a_frame));
}

SpeedForecast forecast_speed(const Scene& scene, double masses, double stable_dt) {
  SpeedForecast forecast;
  forecast.steps_a_frame = steps_a_frame(scene, stable_dt);
  if (scene.physics.integrator == Integrator::backward_euler || masses <= 0 || !std::isfinite(stable_dt))
    return forecast;
  const double step_s = masses * (any_yields(scene) ? plastic_s : elastic_s) *
                        (scene.physics.precision == Precision::double_ ? of_double : 1);
  forecast.real_time_factor = 1 / (scene.physics.frame_Hz * forecast.steps_a_frame * step_s);
  return forecast;
}

}  // namespace palpate::physics
