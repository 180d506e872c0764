// One element led through loading and unloading; l_max the longest that it has been:
//
//   l >= l_max      f_s = envelope(l) = k1 (l - L) up to y_p L, then k1 (y_p - 1) L + k2 (l - y_p L)
//   l <  l_max      f_s = envelope(l_max) - k1 (l_max - l)
//   f = f_s + c l'
//
// The mass is placed, the tension read from its change of speed in one step, which also commits the
// memory at the length that it started from.

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/problems/problems.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {
namespace {

constexpr double k1 = 1000, k2 = 200, c = 2, y_p = 1.05, L = 1;

double envelope(double l) { return l <= y_p * L ? k1 * (l - L) : k1 * (y_p - 1) * L + k2 * (l - y_p * L); }

}  // namespace

double bilinear_loop_error(double speed, int steps, Precision precision) {
  constexpr double m = 1e-3, dt = 1e-3;  // a step turns 1 N into 1 m/s
  Scene scene = pair_scene();
  scene.materials[0].mass = m;
  scene.materials[0].k2_ratio = k2 / k1;
  scene.materials[0].yield_ratio = y_p;
  scene.materials[0].break_ratio = 1.5;
  scene.materials[0].viscosity = c;
  scene.physics->precision = precision;
  scene.physics->threads = 1;
  physics::World world(scene);
  physics::BodyModel& body = world.body(0);
  const auto mass = free_mass(world);

  constexpr std::array turns{1.0, 1.10, 1.02, 1.15, 0.98, 1.20, 1.04};  // lengths
  double l_max = L, worst = 0;
  for (std::size_t turn = 1; turn < turns.size(); ++turn) {
    const double from = turns[turn - 1], to = turns[turn];
    const double rate = to > from ? speed : -speed;
    for (int n = 1; n <= steps; ++n) {
      const double l = from + (to - from) * n / steps;
      const Vec3 u = (l - L) * pair_axis();
      body.place(mass, u, rate * pair_axis());
      body.advance({.dt = dt}, {});
      const double f = (rate - body.velocity(mass).dot(pair_axis())) * m / dt;
      l_max = std::max(l_max, l);
      const double exact = envelope(l_max) - k1 * (l_max - l) + c * rate;
      worst = std::max(worst, std::abs(f - exact));
    }
  }
  return worst / (k1 * L);
}

}  // namespace palpate::bench
