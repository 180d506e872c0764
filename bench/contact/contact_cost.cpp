#include "bench/contact/contact_cost.h"

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

MaterialSpec material(double mass, double k1) {
  MaterialSpec m;
  m.name = "tissue";
  m.mass = mass;
  m.k1 = k1;
  return m;
}

Scene still_scene() {
  Scene scene;
  scene.title = "contact";
  scene.gravity = Vec3::Zero();
  scene.physics->threads = 1;
  scene.physics->sleep = false;
  return scene;
}

/// Cubes with some 10,000 candidates each; the upper one slides at 0.5 m/s and comes down at 0.05 m/s.
Scene cubes(double gap) {
  const double L = 0.002, size = 0.06;
  Scene scene = still_scene();
  scene.materials = {material(5e-6, 100)};
  scene.materials[0].viscosity = 0.001;
  for (const char* name : {"lower", "upper"}) {
    BodySpec cube;
    cube.name = name;
    cube.material = "tissue";
    cube.spacing = L;
    cube.shape = BoxShape{Vec3::Constant(size)};
    scene.bodies.push_back(cube);
  }
  scene.bodies[1].at = {0, 0, size + gap};
  scene.bodies[1].velocity = {0.5, 0, -0.05};
  return scene;
}

Scene smashed_ball() {
  Scene scene = still_scene();
  scene.physics->safety = 0.5;
  scene.materials = {material(1e-3, 200)};
  scene.materials[0].k2_ratio = 0.2;
  scene.materials[0].viscosity = 0.05;
  scene.materials[0].yield_ratio = 1.02;
  scene.materials[0].break_ratio = 1.03;
  BodySpec ball;
  ball.name = "ball";
  ball.material = "tissue";
  ball.spacing = 0.01;
  ball.shape = SphereShape{0.14};
  ball.at = {0, 0, 0.142};
  ball.velocity = {0, 0, -2.6};
  scene.bodies = {ball};
  scene.floor = FloorSpec{};
  return scene;
}

/// What the frames until `seconds` cost.
ContactCost run(physics::World& world, const std::string& name, double seconds) {
  using physics::Stage;
  physics::StepReport& report = world.report();
  const auto contact_ns = [&] {
    return report[Stage::contact_forces].total_ns + report[Stage::find_contacts].total_ns;
  };
  const auto contact = contact_ns(), kernel = report[Stage::element_forces].total_ns;
  const auto steps = report.steps, skipped = report[Stage::contact_forces].skipped;
  const auto before = world.collisions()->tally();
  ContactCost cost;
  std::int64_t frames = 0;
  while (world.t() < seconds - 1e-9) {
    world.frame({});
    cost.pairs += static_cast<std::int64_t>(world.collisions()->n_pairs());
    ++frames;
  }
  cost.pairs /= frames;
  cost.name = name;
  cost.steps = report.steps - steps;
  const auto per_step = 1e-3 / static_cast<double>(cost.steps);
  cost.contact_us = per_step * static_cast<double>(contact_ns() - contact);
  cost.kernel_us = per_step * static_cast<double>(report[Stage::element_forces].total_ns - kernel);
  cost.skipped = report[Stage::contact_forces].skipped - skipped;
  const auto& tally = world.collisions()->tally();
  cost.collisions = tally.collisions - before.collisions;
  cost.rebuilds_per_step =
      static_cast<double>(tally.rebuilds - before.rebuilds) / static_cast<double>(cost.steps);
  cost.candidates = static_cast<std::int64_t>(world.collisions()->n_candidates());
  for (std::size_t b = 0; b < world.n_bodies(); ++b) cost.masses += world.body(b).body().lattice.n_masses();
  return cost;
}

}  // namespace

std::vector<ContactCost> measure_contact_costs() {
  std::vector<ContactCost> costs;
  physics::World sliding(cubes(0.001)), apart(cubes(0.1)), ball(smashed_ball());
  run(sliding, "warm up", 0.005);
  costs.push_back(run(sliding, "two cubes, sliding", 0.06));
  costs.push_back(run(apart, "two cubes, apart", 0.05));
  costs.push_back(run(ball, "ball, being smashed", 0.1));
  run(ball, "the pieces part", 0.3);
  costs.push_back(run(ball, "ball, in pieces", 0.5));
  return costs;
}

}  // namespace palpate::bench
