// A free body that flies, spins and is shaken, without weight. Nothing acts on it from outside:
//
//   P = sum m v = const,   M = sum m x cross v = const
//
// Error: change of each over the flight, relative to its own size at the start.

#include <random>

#include "bench/problems/problems.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {

Drift free_flight(const Settings& settings, LatticeKind lattice, int steps) {
  Scene scene = empty_scene();
  scene.materials[0].mass = 1e-3;
  scene.materials[0].k1 = 200;
  scene.bodies = {box_body(lattice, Vec3(0.021, 0.021, 0.021), lattice == LatticeKind::fcc ? 0.01 : 0.007)};
  scene.bodies[0].at = Vec3::Zero();
  const int frames = 50;
  apply(settings, settings.step * steps, frames, scene);
  physics::World world(scene);
  physics::BodyModel& body = world.body(0);
  std::mt19937_64 engine(7);
  const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  const Vec3 flight(0.02, -0.01, 0.03), spin(3, 5, -4);  // [m/s], [rad/s]
  for (const physics::Index cell : body.body().lattice.masses)
    body.place(
        cell, Vec3::Zero(),
        flight + spin.cross(body.body().lattice.rest_position(cell)) + 0.02 * Vec3(dice(), dice(), dice()));
  world.restart_ledger();
  const physics::Momenta before = body.momenta();
  Drift drift;
  drift.outcome = run(world, frames);
  const physics::Momenta after = body.momenta();
  drift.linear = (after.linear - before.linear).norm() / before.linear.norm();
  drift.angular = (after.angular - before.angular).norm() / before.angular.norm();
  drift.outcome.error = std::max(drift.linear, drift.angular);
  return drift;
}

}  // namespace palpate::bench
