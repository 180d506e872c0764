#include "bench/problems/settings.h"

#include <cmath>
#include <numbers>

#include "bench/problems/stopwatch.h"
#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {

const char* name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::symplectic_euler:
      return "symplectic_euler";
    case Integrator::velocity_verlet:
      return "velocity_verlet";
    case Integrator::backward_euler:
      return "backward_euler";
    case Integrator::automatic:
      return "auto";
  }
  return "unknown";
}

const char* name_of(Precision precision) { return precision == Precision::single_ ? "single" : "double"; }

Scene empty_scene() {
  Scene scene;
  scene.title = "reference problem";
  scene.gravity = Vec3::Zero();
  scene.physics->sleep = false;
  MaterialSpec material;
  material.name = "m";
  material.mass = 1.0;
  material.k1 = 1.0;
  scene.materials = {material};
  return scene;
}

BodySpec box_body(LatticeKind lattice, const Vec3& size, double spacing) {
  BodySpec body;
  body.name = "body";
  body.lattice = lattice;
  body.spacing = spacing;
  body.material = "m";
  body.shape = BoxShape{size};
  body.at = 0.5 * size;
  return body;
}

Vec3 pair_axis() { return Vec3(1, 1, 0) / std::numbers::sqrt2; }

Scene pair_scene() {
  Scene scene = empty_scene();
  scene.materials[0].k1 = 1000;
  // A face diagonal of the cubic lattice, one layer thick.
  scene.bodies = {box_body(LatticeKind::fcc, Vec3(0.72, 0.72, 0.1), 1.0)};
  scene.bodies[0].fixed_boxes = {{Vec3::Constant(-0.1), Vec3::Constant(0.1)}};
  return scene;
}

physics::Index free_mass(const physics::World& world) {
  const physics::Body& body = world.body(0).body();
  for (const physics::Index cell : body.lattice.masses)
    if (body.inverse_mass[static_cast<std::size_t>(cell)] > 0) return cell;
  PALPATE_CHECK(false, "no mass is free");
}

void apply(const Settings& settings, double seconds, int frames, Scene& scene) {
  const double frame = seconds / frames;
  scene.physics->integrator = settings.integrator;
  scene.physics->precision = settings.precision;
  scene.physics->threads = settings.threads;
  scene.physics->frame_Hz = 1 / frame;
  scene.physics->step = frame / std::ceil(frame / settings.step - 1e-9);
}

Outcome run(physics::World& world, int frames, const std::function<void(int)>& look) {
  Outcome outcome;
  const std::int64_t before = world.report().steps;
  for (int frame = 1; frame <= frames; ++frame) {
    const Stopwatch watch;
    world.frame({});
    outcome.cpu_s += watch.cpu_s();
    if (look) look(frame);
  }
  outcome.steps = world.report().steps - before;
  for (std::size_t b = 0; b < world.n_bodies(); ++b)
    outcome.masses += world.body(b).body().lattice.n_masses();
  return outcome;
}

}  // namespace palpate::bench
