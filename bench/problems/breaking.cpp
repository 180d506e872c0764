// One element torn by a mass that flies off: elastic, plastic, gone.
//
//   elastic   m x'' = -k1 x                              until x = (y_p - 1) L
//   plastic   m x'' = -k1 (y_p - 1) L - k2 (x - (y_p - 1) L)   until x = (b_p - 1) L
//   free      x' = v_b,   m v_b^2 / 2 = m v_0^2 / 2 - work of the two triangles and the rectangle under the curve
//
// Error: difference in x some time after the break, relative to L. It has two events, so no integrator is better than
// of first order.

#include <cmath>

#include "bench/problems/problems.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {

Outcome breaking(const Settings& settings) {
  constexpr double m = 1, k1 = 1000, k2 = 200, x_y = 0.05, x_b = 0.3, v_0 = 8, T = 0.1;
  constexpr int frames = 10;
  Scene scene = pair_scene();
  scene.materials[0].k2_ratio = k2 / k1;
  scene.materials[0].yield_ratio = 1 + x_y;
  scene.materials[0].break_ratio = 1 + x_b;
  apply(settings, T, frames, scene);
  physics::World world(scene);
  const auto mass = free_mass(world);
  world.body(0).place(mass, Vec3::Zero(), v_0 * pair_axis());
  world.restart_ledger();

  const double w1 = std::sqrt(k1 / m), w2 = std::sqrt(k2 / m);
  const double t_y = std::asin(x_y * w1 / v_0) / w1;
  const double v_y = std::sqrt(v_0 * v_0 - k1 / m * x_y * x_y);
  // About its own middle x_m the plastic phase is an oscillation R cos(w2 t - phase).
  const double x_m = x_y - k1 * x_y / k2;
  const double R = std::hypot(x_y - x_m, v_y / w2);
  const double phase = std::atan2(v_y / w2, x_y - x_m);
  const double t_b = t_y + (phase - std::acos((x_b - x_m) / R)) / w2;
  const double work = 0.5 * k1 * x_y * x_y + (x_b - x_y) * (k1 * x_y + 0.5 * k2 * (x_b - x_y));
  const double v_b = std::sqrt(v_0 * v_0 - 2 * work / m);
  const double exact = x_b + v_b * (T - t_b);

  Outcome outcome = run(world, frames);
  outcome.error = std::abs(world.body(0).displacement(mass).dot(pair_axis()) - exact);  // L = 1 m
  return outcome;
}

}  // namespace palpate::bench
