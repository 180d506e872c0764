#include "bench/fem/tet_cost.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "bench/fem/tet_work.h"
#include "bench/problems/median.h"
#include "bench/problems/stopwatch.h"
#include "physics_node/mesh/renumber.h"
#include "physics_node/mesh/tet_box.h"
#include "physics_node/step/fem/tet_spectrum.h"
#include "physics_node/step/fem/tetrahedra.h"

namespace palpate::bench {
namespace {

constexpr int steps_a_tet_frame = 4;

class TetCube {
 public:
  virtual ~TetCube() = default;
  virtual void frame(physics::Team* team, int threads) = 0;
};

template <class Real>
class TetCubeOf final : public TetCube {
 public:
  TetCubeOf(const physics::TetModel& model, double dt) : body_(model), dt_(dt) {
    std::mt19937_64 engine(1);
    const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
    for (physics::Index n = 0; n < static_cast<physics::Index>(body_.n_nodes()); ++n)
      if (body_.inverse_mass(n) > 0) body_.place(n, Vec3::Zero(), 0.01 * Vec3(dice(), dice(), dice()));
  }
  void frame(physics::Team* team, int threads) override {
    for (int n = 0; n < steps_a_tet_frame; ++n)
      body_.step({.dt = dt_, .team = team, .threads = threads, .watch = n + 1 == steps_a_tet_frame});
  }

 private:
  physics::Tetrahedra<Real> body_;
  double dt_;
};

/// 10 kPa, Poisson's ratio 0.45, cells of 2.5 mm, of second order 5 mm, inner nodes jittered by 0.15 of that.
physics::TetModel model_of(const TetCubeKind& kind) {
  const bool second_order = kind.element == TetElement::second_order;
  physics::TetModel model;
  model.mesh = physics::make_tet_box(
      {.cells = {kind.cells, kind.cells, kind.cells}, .edge = second_order ? 0.005 : 0.0025, .jitter = 0.15});
  if (second_order) physics::add_middles(model.mesh);
  physics::renumber(model.mesh);
  model.materials = {{.nodal_pressure = kind.element == TetElement::nodal}};
  model.beta = kind.damped ? 1e-4 : 0;
  for (const Vec3& x : model.mesh.nodes) model.held.push_back(x.z() < 1e-9);
  return model;
}

}  // namespace

double TetCost::median_ns() const { return median(ns); }

double TetCost::least_ns() const { return ns.empty() ? 0 : *std::min_element(ns.begin(), ns.end()); }

double TetCost::tets_at_1_kHz() const {
  const double steps = std::ceil(1e-3 / (0.8 * stable_step) - 1e-9);
  return 1e-3 / (1e-9 * median_ns() * steps);
}

std::vector<TetCost> measure_tet_costs(const std::vector<TetCubeKind>& kinds, int rounds) {
  std::vector<TetCost> costs;
  std::vector<std::unique_ptr<TetCube>> cubes;
  int most_threads = 1;
  for (const TetCubeKind& kind : kinds) {
    const physics::TetModel model = model_of(kind);
    const physics::TetLayout layout = physics::lay_out(model);
    TetCost cost{.kind = kind, .ns = {}};
    cost.stable_step =
        physics::stable_step(physics::stiffest_mode_of_tetrahedra(model), Integrator::symplectic_euler);
    cost.flops = flops_per_tet(layout, kind.element, kind.damped);
    cost.bytes =
        bytes_per_tet(layout, kind.element, kind.precision == Precision::single_ ? 4 : 8, kind.damped);
    cost.nodes_per_tet = static_cast<double>(model.mesh.nodes.size()) / kind.tets();
    costs.push_back(cost);
    if (kind.precision == Precision::single_)
      cubes.push_back(std::make_unique<TetCubeOf<float>>(model, 0.5 * cost.stable_step));
    else
      cubes.push_back(std::make_unique<TetCubeOf<double>>(model, 0.5 * cost.stable_step));
    most_threads = std::max(most_threads, kind.threads);
  }
  physics::Team team(most_threads);
  for (int round = 0; round <= rounds; ++round)  // the first does not count
    for (std::size_t n = 0; n < kinds.size(); ++n) {
      const double tets = kinds[n].tets();
      const int frames = std::max(1, static_cast<int>(1e6 / tets));
      const Stopwatch watch;
      for (int frame = 0; frame < frames; ++frame)
        cubes[n]->frame(kinds[n].threads > 1 ? &team : nullptr, kinds[n].threads);
      if (round > 0) costs[n].ns.push_back(1e9 * watch.wall_s() / (frames * steps_a_tet_frame * tets));
    }
  return costs;
}

}  // namespace palpate::bench
