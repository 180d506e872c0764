// One element without damper: a mass on a spring whose other end is held.
//
//   m x'' = -k x,  x(0) = A,  x'(0) = 0:   x(t) = A cos(w t),  w = sqrt(k / m)
//
// Along its axis the element is linear at any stretch. Error: largest difference in x over ten periods, relative to A.

#include <cmath>
#include <numbers>

#include "bench/problems/problems.h"
#include "common/scene/scene.h"

namespace palpate::bench {

Outcome oscillation(const Settings& settings) {
  constexpr double A = 0.1;  // [m]
  const double w = std::sqrt(1000.0);
  constexpr int frames = 320;
  const double T = 10 * 2 * std::numbers::pi / w;
  Scene scene = pair_scene();
  apply(settings, T, frames, scene);
  physics::World world(scene);
  const auto mass = free_mass(world);
  world.body(0).place(mass, A * pair_axis(), Vec3::Zero());
  world.restart_ledger();
  double worst = 0;
  Outcome outcome = run(world, frames, [&](int frame) {
    const double x = world.body(0).displacement(mass).dot(pair_axis());
    worst = std::max(worst, std::abs(x - A * std::cos(w * T * frame / frames)));
  });
  outcome.error = worst / A;
  return outcome;
}

}  // namespace palpate::bench
