#include "bench/outcomes/fall.h"

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "physics_node/world.h"

namespace palpate::bench {

Scene fall_scene(const Fall& fall) {
  Scene scene;
  scene.title = "fall";
  scene.gravity = Vec3::Zero();
  scene.physics->integrator = Integrator::velocity_verlet;
  scene.physics->step = 1e-4;
  scene.physics->threads = 1;
  scene.physics->sleep = false;
  MaterialSpec clay;
  clay.name = "clay";
  clay.mass = 1e-3;
  clay.k1 = 200;
  clay.k2_ratio = 0.2;
  clay.viscosity = 0.05;
  clay.yield_ratio = fall.y_p;
  clay.break_ratio = fall.y_p + fall.gap;
  scene.materials.push_back(clay);
  BodySpec ball;
  ball.name = "ball";
  ball.lattice = LatticeKind::fcc;
  ball.spacing = 0.01;
  ball.material = clay.name;
  ball.shape = SphereShape{0.06};
  ball.at = {0, 0, 0.061};
  ball.velocity = {0, 0, -fall.speed};
  scene.bodies.push_back(ball);
  scene.floor = FloorSpec{};
  scene.contact->distance = ContactDistance::paper;
  return scene;
}

FallResult run_fall(const Fall& fall, double seconds) {
  physics::World world(fall_scene(fall));
  while (world.t() < seconds - 1e-9) world.frame({});
  FallResult result;
  result.fall = fall;
  result.measures = physics::measure_outcome(world.body(0), world.fragments(0));
  result.outcome = physics::classify(result.measures);
  result.balance_error = world.ledger().balance_error();
  const physics::MomentumBalance balance = world.body(0).momentum_balance();
  result.momentum_error = balance.missing.linear.norm() / balance.linear;
  result.restored = world.report().restored;
  return result;
}

}  // namespace palpate::bench
