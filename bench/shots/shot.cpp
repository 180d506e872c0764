#include "bench/shots/shot.h"

#include <algorithm>
#include <cmath>

#include "bench/problems/dice.h"
#include "bench/shots/inside.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

constexpr double slowest = 0.1;      // [m/s]
constexpr double target_size = 0.1;  // [m]
constexpr double radius_of_target = 0.04;

/// Log-uniform; not Dice::decades, whose last digits differ: a shot that was told by its seed stays that shot.
double decades(Dice& dice, double lo, double hi) { return lo * std::pow(hi / lo, dice.between(0, 1)); }

MaterialSpec material(const char* name, double mass, double k1) {
  MaterialSpec m;
  m.name = name;
  m.mass = mass;
  m.k1 = k1;
  m.viscosity = 0.05;
  return m;
}

/// @return how far it reaches towards the bullet [m]
double choose_target(BodySpec& target, std::string& name, Dice& dice) {
  const double L = dice.between(0.005, 0.01);
  target.name = "target";
  target.material = "soft";
  target.spacing = L;
  switch (static_cast<int>(dice.between(0, 3))) {
    case 0:
      name = "plate";
      target.shape = BoxShape{Vec3(target_size, target_size, L * dice.between(0.8, 2))};
      target.fixed_faces[0] = target.fixed_faces[1] = true;
      return L;
    case 1:
      name = "tube";
      target.shape = TubeShape{radius_of_target, radius_of_target - 1.5 * L, target_size, 0, {}};
      target.fixed_faces[0] = target.fixed_faces[1] = true;
      return radius_of_target;
    default:
      name = "sphere";
      target.shape = SphereShape{radius_of_target};
      return radius_of_target;
  }
}

}  // namespace

Shot random_shot(std::uint64_t seed, double fastest, ContactDistance distance) {
  Dice dice(seed);
  Shot shot;
  shot.seed = seed;
  shot.speed = decades(dice, slowest, fastest);
  Scene& scene = shot.scene;
  scene.title = "shot";
  scene.gravity = Vec3::Zero();
  scene.physics->threads = 1;
  scene.contact->distance = distance;
  scene.contact->count_passages = true;

  BodySpec target, bullet;
  const double reach = choose_target(target, shot.target, dice);
  const double l = *target.spacing * dice.between(0.4, 1.5), radius = l * dice.between(1.2, 3);
  bullet.name = "bullet";
  bullet.material = "hard";
  bullet.spacing = l;
  bullet.shape = SphereShape{radius};
  const double start = reach + *target.spacing + radius + dice.between(0.012, 0.017);
  const Vec3 way(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), -1);
  bullet.at = -start * way + Vec3(dice.between(-0.01, 0.01), dice.between(-0.01, 0.01), 0);
  bullet.velocity = shot.speed * way.normalized();
  scene.bodies = {target, bullet};
  scene.materials = {material("soft", 1e-3, decades(dice, 30, 1e4)),
                     material("hard", decades(dice, 1e-4, 1e-2), decades(dice, 100, 1e4))};
  return shot;
}

ShotResult run_shot(const Shot& shot) {
  physics::World world(shot.scene);
  const double seconds = std::min(0.6, 0.15 / shot.speed) + 0.02;
  while (world.t() < seconds && !world.has_stopped()) world.frame({});
  const physics::CollisionTally& tally = world.collisions()->tally();
  const physics::BodyModel &target = world.body(0), &bullet = world.body(1);
  ShotResult result;
  result.seed = shot.seed;
  result.speed = shot.speed;
  result.target = shot.target;
  result.collisions = tally.collisions;
  result.stopped = tally.stopped;
  result.passages = tally.passages;
  result.overflows = tally.overflows;
  result.restored = world.report().restored;
  const auto skin = surface_of(bullet);
  const int of_bullet = count_inside(bullet, skin, target);
  result.inside = of_bullet + count_inside(target, surface_of(target), bullet);
  result.spilled = count_inside(bullet, bullet.body().lattice.masses, target) - of_bullet;
  return result;
}

}  // namespace palpate::bench
