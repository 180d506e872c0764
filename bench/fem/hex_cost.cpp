#include "bench/fem/hex_cost.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "bench/problems/stopwatch.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::bench {
namespace {

constexpr int steps_a_frame = 4;

struct HexCube {
  std::unique_ptr<physics::BodyModel> body;
  double stable_step = 0;

  void frame(physics::Team* team, int threads) {
    for (int n = 0; n < steps_a_frame; ++n)
      body->advance(
          {.dt = 0.5 * stable_step, .team = team, .threads = threads, .watch = n + 1 == steps_a_frame}, {});
  }
};

/// 10 kPa, Poisson's ratio 0.45, cells of 2.5 mm.
HexCube make(const HexCubeKind& kind) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = 10e3;
  tissue.poisson_ratio = 0.45;
  tissue.density = 1000;
  if (kind.damped) tissue.viscosity_bulk = 1;
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

}  // namespace

double HexCost::median_ns() const {
  std::vector<double> sorted = ns;
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? 0 : sorted[sorted.size() / 2];
}

double HexCost::least_ns() const { return ns.empty() ? 0 : *std::min_element(ns.begin(), ns.end()); }

double HexCost::cells_at_1_kHz() const {
  const double steps = std::ceil(1e-3 / (0.8 * stable_step) - 1e-9);
  return 1e-3 / (1e-9 * median_ns() * steps);
}

std::vector<HexCost> measure_hex_costs(const std::vector<HexCubeKind>& kinds, int rounds) {
  std::vector<HexCost> costs;
  std::vector<HexCube> cubes;
  int most_threads = 1;
  for (const HexCubeKind& kind : kinds) {
    cubes.push_back(make(kind));
    costs.push_back({.kind = kind, .stable_step = cubes.back().stable_step, .ns = {}});
    most_threads = std::max(most_threads, kind.threads);
  }
  physics::Team team(most_threads);
  for (int round = 0; round <= rounds; ++round)  // the first does not count
    for (std::size_t n = 0; n < kinds.size(); ++n) {
      const double cells = std::pow(kinds[n].cells, 3);
      const int frames = std::max(1, static_cast<int>(1e6 / cells));
      const Stopwatch watch;
      for (int frame = 0; frame < frames; ++frame)
        cubes[n].frame(kinds[n].threads > 1 ? &team : nullptr, kinds[n].threads);
      if (round > 0) costs[n].ns.push_back(1e9 * watch.wall_s() / (frames * steps_a_frame * cells));
    }
  return costs;
}

}  // namespace palpate::bench
