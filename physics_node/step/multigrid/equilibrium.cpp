#include "physics_node/step/multigrid/equilibrium.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr int most_steps = 24;
// Why not less: what buckles has an equilibrium that nothing stands in; it is left again below this.
constexpr NewtonTask at_once{.tolerance = 1e-4, .most_iterations = 40, .most_cycles = 300};
constexpr double first_step = 0.01, longest_step = 1;  // [s]

void load(const Body& body, const Vec3& gravity, Newton<double>& newton) {
  newton.each_node({}, [&](std::size_t i) {
    const Index node = newton.storage()[i];
    const double mass = body.inverse_mass[static_cast<std::size_t>(node)] > 0 ? node_mass(body, node) : 0;
    for (std::size_t a = 0; a < 3; ++a) newton.push[a][i] = mass * gravity[static_cast<Eigen::Index>(a)];
  });
}

/// Goes on from where the last search ended, or back to where it began.
void go_on(Newton<double>& newton, const Crew& crew, bool keep) {
  newton.each_node(crew, [&](std::size_t i) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (keep) newton.u[a][i] += newton.D[a][i];
      newton.D[a][i] = 0;
    }
  });
}

}  // namespace

Equilibrium equilibrium(const Body& body, const Vec3& gravity, const Crew& crew) {
  Newton<double> newton(body);
  load(body, gravity, newton);
  Equilibrium found;
  double dt = 0;
  for (int n = 0; n < most_steps; ++n) {
    const NewtonReport now =
        newton.solve(crew, dt > 0 ? NewtonTask{.dt = dt, .tolerance = 1e-2, .most_iterations = 8} : at_once);
    NewtonReport& all = found.report;
    all = {all.iterations + now.iterations,
           all.cycles + now.cycles,
           all.halvings + now.halvings,
           now.residual,
           now.scale,
           now.energy,
           now.converged && dt == 0};
    go_on(newton, crew, all.converged || dt > 0);
    if (all.converged) break;
    if (dt == 0)
      dt = first_step;
    else if (!now.converged)
      dt *= 0.25;
    else
      dt = dt > longest_step ? 0 : 2 * dt;
  }
  std::vector<Vec3> by_storage(static_cast<std::size_t>(body.capacity()), Vec3::Zero());
  newton.each_node({}, [&](std::size_t i) {
    by_storage[static_cast<std::size_t>(newton.storage()[i])] =
        Vec3(newton.u[0][i], newton.u[1][i], newton.u[2][i]);
  });
  for (const Index node : body.nodes())
    found.displacement.push_back(by_storage[static_cast<std::size_t>(node)]);
  return found;
}

}  // namespace palpate::physics
