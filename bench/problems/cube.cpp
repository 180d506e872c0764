#include "bench/problems/cube.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/step/body_model.h"

#include <cmath>
#include <random>

#include "physics_node/step/lattice/stable_step.h"

namespace palpate::bench {
namespace {

constexpr double yielding_ratio = 1.0001;

MaterialSpec tissue(Work work) {
  MaterialSpec material;
  material.name = "tissue";
  material.modulus = 10e3;
  material.density = 1000;
  if (work == Work::damped) material.viscosity_bulk = 5;
  if (work == Work::plastic) material.k2_ratio = 0.2, material.yield_ratio = 1.5, material.break_ratio = 3;
  if (work == Work::yielding)
    material.k2_ratio = 0.01, material.yield_ratio = yielding_ratio, material.break_ratio = 10;
  return material;
}

}  // namespace

const char* name_of(Work work) {
  switch (work) {
    case Work::undamped:
      return "undamped";
    case Work::damped:
      return "damped";
    case Work::plastic:
      return "plastic";
    case Work::yielding:
      return "yielding";
  }
  return "unknown";
}

Cube make_cube(const CubeKind& kind) {
  constexpr double spacing = 0.005;  // [m]
  BodySpec spec;
  spec.name = "cube";
  spec.lattice = kind.lattice;
  spec.spacing = spacing;
  spec.material = "tissue";
  // A mass of the face-centred lattice takes L^3 / sqrt(2); n^3 masses of the voxel lattice have (n - 1)^3 cells between.
  const double side = kind.lattice == LatticeKind::fcc
                          ? spacing * (std::cbrt(kind.masses / std::sqrt(2.0)) - 0.5)
                          : spacing * (std::round(std::cbrt(kind.masses)) - 1);
  spec.shape = BoxShape{Vec3::Constant(side)};
  spec.fixed_faces[4] = true;  // -z
  physics::Body body = physics::build_body(spec, tissue(kind.work));
  Cube cube;
  cube.stable_step = physics::stable_step(physics::stiffest_mode(body), Integrator::symplectic_euler);
  cube.step = 0.5 * cube.stable_step;
  cube.body = physics::make_body_model(std::move(body), kind.precision);
  return cube;
}

void set_moving(const CubeKind& kind, Cube& cube, int threads) {
  cube.body->reset();
  if (threads > (cube.team ? cube.team->threads() : 1)) cube.team = std::make_unique<physics::Team>(threads);
  std::mt19937_64 engine(1);
  const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  constexpr double expansion = 0.02;  // [1/s]: 1 % of a millimetre in a hundred steps
  for (const physics::Index cell : cube.body->body().lattice.masses) {
    const Vec3 shake = 0.01 * Vec3(dice(), dice(), dice());
    const Vec3 rest = cube.body->body().lattice.rest_position(cell);
    if (kind.work == Work::yielding)
      cube.body->place(cell, 2 * (yielding_ratio - 1) * rest, expansion * rest);
    else
      cube.body->place(cell, Vec3::Zero(), shake);
  }
  for (int n = 0; n < 10; ++n) step(cube, threads);
}

}  // namespace palpate::bench
