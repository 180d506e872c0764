#include "bench/peers/drop.h"

#include <cmath>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"

namespace palpate::bench {

Drop make_drop(int masses) {
  constexpr double spacing = 0.005;  // [m]
  // A mass of the face-centred lattice takes L^3 / sqrt(2).
  const double side = spacing * std::cbrt(masses / std::sqrt(2.0));
  Drop drop;
  Scene& scene = drop.scene;
  scene.title = "peers";
  scene.physics->frame_Hz = 1 / frame_seconds;
  scene.physics->sleep = false;  // the peers step every mass
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = 10e3;
  tissue.density = 1000;
  scene.materials = {tissue};
  BodySpec cube;
  cube.name = "cube";
  cube.lattice = LatticeKind::fcc;
  cube.spacing = spacing;
  cube.material = tissue.name;
  cube.shape = BoxShape{Vec3::Constant(side)};
  cube.fixed_faces[4] = true;  // -z
  scene.bodies = {cube};
  const physics::World world(scene);
  drop.body = spring_body(world.body(0).body(), scene.gravity);
  drop.stable_step = world.stable_step_seconds();
  return drop;
}

}  // namespace palpate::bench
