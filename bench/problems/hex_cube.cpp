#include "bench/problems/hex_cube.h"

#include <random>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::bench {
namespace {

constexpr int steps_a_frame = 4;

}  // namespace

void HexCube::step(int n_steps, physics::Team* team, int threads) {
  for (int n = 0; n < n_steps; ++n)
    body->advance({.dt = 0.5 * stable_step,
                   .team = team,
                   .threads = threads,
                   .watch = n % steps_a_frame + 1 == steps_a_frame},
                  {});
}

HexCube make_hex_cube(const HexCubeKind& kind) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = 10e3;
  tissue.poisson_ratio = 0.45;
  tissue.density = 1000;
  if (kind.damped) tissue.viscosity_bulk = 1;
  if (kind.relaxing) tissue.relaxation = {{.share = 0.5, .time = 0.1}};
  if (kind.breaking) tissue.break_ratio = 2;
  if (kind.yielding || kind.yielded) tissue.k2_ratio = 0.2, tissue.yield_ratio = kind.yielded ? 1.00001 : 1.5;
  BodySpec spec;
  spec.name = "cube";
  spec.lattice = LatticeKind::voxel;
  spec.model = ElementModel::fem;
  spec.hourglass = kind.hourglass;
  constexpr double edge = 0.0025;  // [m]
  spec.spacing = edge;
  spec.material = "tissue";
  spec.shape = BoxShape{Vec3::Constant(edge * kind.cells)};
  spec.fixed_faces[4] = true;  // -z
  physics::Body body = physics::build_body(spec, tissue);
  HexCube cube;
  cube.stable_step = physics::stable_step(physics::stiffest_mode(body), Integrator::symplectic_euler);
  cube.body = physics::make_body_model(std::move(body), kind.precision);
  std::mt19937_64 engine(1);
  const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  for (const physics::Index node : cube.body->body().nodes())
    cube.body->place(node, Vec3::Zero(), 0.01 * Vec3(dice(), dice(), dice()));
  return cube;
}

}  // namespace palpate::bench
