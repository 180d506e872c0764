#include "bench/fem/multigrid_cost.h"

#include <algorithm>
#include <memory>

#include "bench/problems/median.h"
#include "bench/problems/stopwatch.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/lattice/stable_step.h"
#include "physics_node/step/multigrid/conjugate_gradients.h"

namespace palpate::bench {
namespace {

using physics::Index;

constexpr double frame = FrameCost::frame;

/// Of one thread its CPU time, so that what else the machine does counts less; of several the wall time.
double seconds(const Stopwatch& watch, int threads) { return threads == 1 ? watch.cpu_s() : watch.wall_s(); }

/// Nodes that are free and lie highest, those nearest to the middle first.
std::vector<Index> highest(const physics::Body& body, std::size_t count) {
  std::vector<std::pair<double, Index>> far;
  for (const Index node : body.nodes()) {
    if (body.inverse_mass[static_cast<std::size_t>(node)] == 0) continue;
    const Vec3 x = body.rest_position(node);
    far.emplace_back(-x.z() + 1e-3 * x.head<2>().norm(), node);
  }
  std::sort(far.begin(), far.end());
  std::vector<Index> nodes;
  for (std::size_t n = 0; n < std::min(count, far.size()); ++n) nodes.push_back(far[n].second);
  return nodes;
}

}  // namespace

CycleCost measure_cycles(const SolidKind& kind, int threads, int rounds) {
  const physics::Body body = make_solid(kind);
  physics::Hierarchy<float> hierarchy(body);
  physics::ConjugateGradients<float> gradients(hierarchy);
  physics::Team team(threads);
  const physics::Crew crew{&team, threads};
  hierarchy.set_step(frame);
  const std::vector<Index> pushed = highest(body, 9);
  for (std::size_t n = 0; n < hierarchy.storage().size(); ++n)
    if (std::find(pushed.begin(), pushed.end(), hierarchy.storage()[n]) != pushed.end())
      gradients.b[2][n] = -0.01F, gradients.b[0][n] = 0.004F;
  CycleCost cost{.kind = kind, .threads = threads, .cells = n_cells_of(body)};
  constexpr int cycles = 6;
  for (int round = 0; round <= rounds; ++round) {  // the first does not count
    const Stopwatch tangent;
    hierarchy.linearise(crew, 1);
    const double tangent_ns = 1e9 * seconds(tangent, threads) / cost.cells;
    const Stopwatch watch;
    gradients.solve(hierarchy, crew, 0, cycles);
    const double cycle_ns = 1e9 * seconds(watch, threads) / (cycles * static_cast<double>(cost.cells));
    if (round == 0) continue;
    cost.cycle_ns = round == 1 ? cycle_ns : std::min(cost.cycle_ns, cycle_ns);
    cost.tangent_ns = round == 1 ? tangent_ns : std::min(cost.tangent_ns, tangent_ns);
  }
  cost.to_hundredth = gradients.solve(hierarchy, crew, 1e-2, 200).cycles;
  cost.to_ten_thousandth = gradients.solve(hierarchy, crew, 1e-4, 200).cycles;
  return cost;
}

FrameCost measure_frames(const SolidKind& kind, int threads) {
  constexpr int frames = 25;
  physics::Team team(threads);
  physics::Body solid = make_solid(kind);
  FrameCost cost{.kind = kind, .threads = threads, .cells = n_cells_of(solid)};
  cost.explicit_step =
      0.8 * physics::stable_step(physics::stiffest_mode(solid), Integrator::symplectic_euler);
  // A patch as wide as a third of the top; a force that would press it in by about a tenth.
  const double side = kind.edge * kind.cells;
  const auto patch = static_cast<std::size_t>(kind.cells * kind.cells / 9);
  const double force = 0.1 * kind.modulus * side / 3 * side;
  std::vector<physics::NodalForce> push;
  for (const Index node : highest(solid, patch)) push.push_back({node, Vec3::Zero()});
  auto body = physics::make_body_model(make_solid(kind), Precision::single_, Integrator::backward_euler);
  std::vector<double> ns;
  for (int n = 1; n <= frames; ++n) {
    for (auto& nodal : push) nodal.force.z() = -force * n / frames / static_cast<double>(push.size());
    const Stopwatch watch;
    const physics::StepOutcome outcome =
        body->advance({.dt = frame, .team = &team, .threads = threads, .watch = true}, push);
    if (n == 1) continue;
    ns.push_back(1e9 * seconds(watch, threads) / cost.cells);
    cost.newton += outcome.newton_iterations / (frames - 1.0);
    cost.cycles += outcome.cg_iterations / (frames - 1.0);
  }
  cost.implicit_ns = median(ns);
  auto stepped = physics::make_body_model(std::move(solid), Precision::single_, Integrator::symplectic_euler);
  ns.clear();
  for (int n = 0; n < frames; ++n) {
    const Stopwatch watch;
    for (int step = 0; step < 4; ++step)
      stepped->advance({.dt = cost.explicit_step, .team = &team, .threads = threads, .watch = step == 3},
                       push);
    if (n > 0) ns.push_back(1e9 * seconds(watch, threads) / (4.0 * cost.cells));
  }
  cost.explicit_ns = median(ns);
  return cost;
}

}  // namespace palpate::bench
