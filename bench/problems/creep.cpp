// One element with a strong damper under a constant force: it creeps to its stretch (Kelvin and Voigt, with inertia).
//
//   m x'' + c x' + k x = F,  x(0) = x'(0) = 0
//   x(t) = F/k (1 - (s2 e^(s1 t) - s1 e^(s2 t)) / (s2 - s1)),   s1, s2 = (-c +- sqrt(c^2 - 4 m k)) / (2 m)
//
// The force is the free mass's weight along the element. Error: largest difference in x, relative to F/k.

#include <cmath>

#include "bench/problems/problems.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {

Outcome creep(const Settings& settings) {
  constexpr double m = 1, k = 1000, c = 120, F = 20, T = 0.6;
  constexpr int frames = 60;
  Scene scene = pair_scene();
  scene.materials[0].viscosity = c;
  scene.gravity = F / m * pair_axis();
  apply(settings, T, frames, scene);
  physics::World world(scene);
  const auto mass = free_mass(world);
  const double root = std::sqrt(c * c - 4 * m * k);
  const double s1 = (-c + root) / (2 * m), s2 = (-c - root) / (2 * m);
  double worst = 0;
  Outcome outcome = run(world, frames, [&](int frame) {
    const double t = T * frame / frames;
    const double exact = F / k * (1 - (s2 * std::exp(s1 * t) - s1 * std::exp(s2 * t)) / (s2 - s1));
    const double x = world.body(0).displacement(mass).dot(pair_axis());
    worst = std::max(worst, std::abs(x - exact));
  });
  outcome.error = worst / (F / k);
  return outcome;
}

}  // namespace palpate::bench
