#include "bench/outcomes/fragment_cost.h"

#include <algorithm>
#include <random>
#include <stdexcept>

#include "bench/problems/stopwatch.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {
namespace {

/// Glass: what is stretched by a thousandth breaks.
std::unique_ptr<physics::BodyModel> make_cube() {
  MaterialSpec glass;
  glass.name = "glass";
  glass.mass = 1e-3;
  glass.k1 = 200;
  glass.yield_ratio = 1.0005;
  glass.break_ratio = 1.001;
  BodySpec cube;
  cube.name = "cube";
  cube.spacing = 0.01;
  cube.material = glass.name;
  cube.shape = BoxShape{Vec3::Constant(0.41)};
  return physics::make_body_model(physics::build_body(cube, glass), Precision::single_);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

FragmentCost measure(int torn, int steps) {
  const auto body = make_cube();
  physics::Fragments followed(*body), flooded(*body);
  body->advance({.dt = 0}, {});
  const auto& masses = body->body().lattice.masses;
  std::mt19937_64 engine(1);
  FragmentCost cost;
  cost.torn = torn;
  cost.masses = body->body().lattice.n_masses();
  std::vector<double> follow, flood;
  for (int n = 0; n < steps; ++n) {
    for (int k = 0; k < torn; ++k)
      body->place(masses[engine() % masses.size()], Vec3(0.003, 0.001, 0), Vec3::Zero());
    body->advance({.dt = 0}, {});
    const Stopwatch first;
    followed.update(*body);
    follow.push_back(1e6 * first.cpu_s());
    const Stopwatch second;
    flooded.recompute(*body);
    flood.push_back(1e6 * second.cpu_s());
  }
  if (followed.count() != flooded.count()) throw std::runtime_error("fragments followed and counted differ");
  cost.breaks = static_cast<double>(body->breaks()) / steps;
  cost.follow_us = median(follow);
  cost.flood_us = median(flood);
  cost.fragments = followed.count();
  return cost;
}

}  // namespace

std::vector<FragmentCost> measure_fragment_cost(int steps) {
  std::vector<FragmentCost> costs;
  for (const int torn : {1, 10, 100}) costs.push_back(measure(torn, steps));
  return costs;
}

}  // namespace palpate::bench
