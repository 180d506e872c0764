#include "physics_node/forecast/speed_forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"

namespace palpate::physics {
namespace {

// A mass and step on one thread, docs/benchmarks.md, `palpate bench kernel`: damped, of the lattice that
// takes longer [s].
constexpr double elastic_s = 30e-9, plastic_s = 50e-9;
constexpr double of_double = 2;  // times as long
// Of finite elements a cell, `palpate bench fem`, damped; a term of relaxation is memory to read and write [s].
constexpr double physical_s = 14e-9, isotropic_s = 8e-9, term_s = 15e-9;

// Of a node of a mesh, damped, by TetElements: `palpate bench fem` [s].
constexpr double node_s[] = {28e-9, 46e-9, 19e-9};

bool any_yields(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const MaterialSpec& material) { return material.yield_ratio.has_value(); });
}

/// A mass of a body and step [s].
double mass_step_s(const Scene& scene, const BodySpec& body) {
  if (std::holds_alternative<MeshShape>(body.shape))
    return node_s[static_cast<std::size_t>(body.tet_elements)];
  if (body.model == ElementModel::springs) return any_yields(scene) ? plastic_s : elastic_s;
  double cell = body.hourglass == HourglassKind::physical ? physical_s : isotropic_s;
  for (const MaterialSpec& material : scene.materials)
    if (material.name == body.material) cell += term_s * static_cast<double>(material.relaxation.size());
  return cell;
}

/// Whose step is the shortest, and what would do.
struct Culprit {
  std::string place, advice;
  double step = 0;  // [s]
};

/// A wave crosses a spacing in h sqrt(rho / E), a damper lets it go in rho h^2 / eta: good to a factor of a few, as is
/// what it advises. Of materials that are given by the bulk; of others nothing is known here.
std::optional<Culprit> shortest_step(const Scene& scene) {
  constexpr double margin = 4;  // Why: a lattice is stable for about half the time that a wave takes
  const double shortest = margin / (scene.physics->frame_Hz * most_steps_a_frame);
  std::optional<Culprit> found;
  for (const BodySpec& body : scene.bodies)
    for (const MaterialSpec& material : scene.materials) {
      const bool of_region =
          std::any_of(body.regions.begin(), body.regions.end(),
                      [&](const RegionSpec& region) { return region.material == material.name; });
      if ((material.name != body.material && !of_region) || !material.density || !body.spacing) continue;
      const double rho = *material.density, h = *body.spacing, modulus = material.modulus.value_or(0),
                   eta = material.viscosity_bulk.value_or(0);
      const double elastic = modulus > 0 ? h * std::sqrt(rho / modulus) : HUGE_VAL,
                   viscous = eta > 0 ? rho * h * h / eta : HUGE_VAL, step = std::min(elastic, viscous);
      if (!std::isfinite(step) || (found && found->step <= step)) continue;
      const std::string most =
          elastic <= viscous
              ? fmt::format("modulus_kPa of at most about {:.2g}", 1e-3 * rho * std::pow(h / shortest, 2))
              : fmt::format("viscosity_Pa_s of at most about {:.2g}", rho * h * h / shortest);
      const double least = std::max(modulus * std::pow(shortest / h, 2), eta * shortest / (h * h));
      found = {material.place.text(),
               fmt::format(
                   "give [material.{}] of body \"{}\" a {}, or a density_kg_per_m3 of at least about {:.2g}",
                   material.name, body.name, most, least),
               step};
    }
  return found;
}

}  // namespace

double steps_a_frame(const Scene& scene, double stable_dt) {
  const double frame = 1 / scene.physics->frame_Hz,
               wanted = scene.physics->step.value_or(scene.physics->safety * stable_dt);
  const double steps = std::isfinite(wanted) ? std::max(1.0, std::ceil(frame / wanted - 1e-9)) : 1;
  if (steps <= most_steps_a_frame) return steps;
  const std::string numbers = fmt::format("a step of {:.2g} s would cut a frame into {:.2g}; {:g} may be",
                                          wanted, steps, most_steps_a_frame);
  if (!scene.physics->step)
    if (const auto culprit = shortest_step(scene))
      throw InputError(fmt::format("{}: {}: {}", culprit->place, numbers, culprit->advice));
  const bool placed = scene.physics->place.line != 0 || !scene.physics->place.file.empty();
  throw InputError(fmt::format("{}: {}: give softer or heavier material, a wider spacing, or a longer step",
                               placed ? scene.physics->place.text() : scene.path, numbers));
}

SpeedForecast forecast_speed(const Scene& scene, std::span<const double> masses, double stable_dt) {
  SpeedForecast forecast;
  forecast.steps_a_frame = steps_a_frame(scene, stable_dt);
  if (scene.physics->integrator == Integrator::backward_euler || !std::isfinite(stable_dt)) return forecast;
  double step_s = 0;
  for (std::size_t b = 0; b < masses.size(); ++b) step_s += masses[b] * mass_step_s(scene, scene.bodies[b]);
  if (scene.physics->precision == Precision::double_) step_s *= of_double;
  if (step_s > 0) forecast.real_time_factor = 1 / (scene.physics->frame_Hz * forecast.steps_a_frame * step_s);
  return forecast;
}

}  // namespace palpate::physics
