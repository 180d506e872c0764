#include "bench/fem/lump_cost.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "bench/problems/median.h"
#include "bench/problems/stopwatch.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

constexpr double edge = 0.0025, modulus = 10e3;  // [m, Pa]

MaterialSpec material(const char* name, double stiffness, double lag) {
  MaterialSpec of;
  of.name = name;
  of.modulus = stiffness;
  of.poisson_ratio = 0.45;
  of.density = 1000;
  of.viscosity_bulk = lag * stiffness;
  return of;
}

std::unique_ptr<physics::World> make_world(const LumpKind& kind, int along) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.physics->threads = 1;
  scene.physics->sleep = false;
  scene.physics->subcycle = kind.subcycle;
  scene.materials = {material("soft", modulus, kind.lag),
                     material("hard", kind.contrast * modulus, kind.lag)};
  BodySpec spec;
  spec.name = "cube";
  spec.lattice = LatticeKind::voxel;
  spec.model = ElementModel::fem;
  spec.spacing = edge;
  spec.material = "soft";
  const double side = edge * along;
  spec.shape = BoxShape{Vec3::Constant(side)};
  spec.fixed_faces[4] = true;  // -z
  RegionSpec ball;
  ball.material = "hard";
  ball.where = BallRegion{Vec3::Zero(), side * std::cbrt(kind.share * 0.75 / std::numbers::pi)};
  spec.regions.push_back(ball);
  scene.bodies.push_back(spec);
  auto world = std::make_unique<physics::World>(scene);
  std::mt19937_64 engine(1);
  const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  physics::BodyModel& body = world->body(0);
  for (const physics::Index node : body.body().nodes())
    body.place(node, Vec3::Zero(), 0.01 * Vec3(dice(), dice(), dice()));
  world->restart_ledger();
  return world;
}

}  // namespace

double LumpCost::median_ns() const { return median(ns); }

std::vector<LumpCost> measure_lumps(const std::vector<LumpKind>& kinds, int along, int rounds) {
  std::vector<LumpCost> costs;
  std::vector<std::unique_ptr<physics::World>> worlds;
  for (const LumpKind& kind : kinds) {
    worlds.push_back(make_world(kind, along));
    const physics::World& world = *worlds.back();
    LumpCost cost{.kind = kind, .cells = static_cast<std::size_t>(along * along * along), .ns = {}};
    cost.fast_cells = world.body(0).body().solid->fast.cells.size();
    cost.step = world.step_seconds();
    costs.push_back(cost);
  }
  for (int round = 0; round <= rounds; ++round)  // the first does not count
    for (std::size_t n = 0; n < kinds.size(); ++n) {
      const Stopwatch watch;
      worlds[n]->frame({});
      if (round > 0) costs[n].ns.push_back(1e9 * watch.wall_s() / static_cast<double>(costs[n].cells));
    }
  return costs;
}

}  // namespace palpate::bench
