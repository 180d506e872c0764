#include "physics_node/step/multigrid/equilibrium.h"

#include <algorithm>
#include <limits>

namespace palpate::physics {
namespace {

constexpr int most_steps = 24, most_steps_free = 60;
// Why not less: what buckles has an equilibrium that nothing stands in; it is left again below this.
constexpr NewtonTask at_once{.tolerance = 1e-4, .most_iterations = 40, .most_cycles = 300};
constexpr double first_step = 0.01, longest_step = 1;  // [s]

/// Adds up what was tried; the residual is the last one's.
void add(NewtonReport& all, const NewtonReport& now) {
  all = {all.iterations + now.iterations,
         all.cycles + now.cycles,
         all.halvings + now.halvings,
         now.residual,
         now.scale,
         now.energy,
         now.converged};
}

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

/// What something holds.
void settle(Newton<double>& newton, std::span<const Plane> planes, const Crew& crew, NewtonReport& all) {
  NewtonTask task = at_once;
  task.planes = planes;
  for (int n = 0; n < most_steps; ++n) {
    const NewtonReport now = newton.solve(crew, task);
    add(all, now);
    all.converged = now.converged && task.dt == 0;
    go_on(newton, crew, all.converged || task.dt > 0);
    if (all.converged) return;
    double dt = task.dt;
    if (dt == 0)
      dt = first_step;
    else if (!now.converged)
      dt *= 0.25;
    else
      dt = dt > longest_step ? 0 : 2 * dt;
    task = dt > 0 ? NewtonTask{.dt = dt, .tolerance = 1e-2, .most_iterations = 8} : at_once;
    task.planes = planes;
  }
}

/// What nothing but planes holds: until the forces alone, without inertia, are in balance.
void settle_free(Newton<double>& newton, std::span<const Plane> planes, const Crew& crew, NewtonReport& all) {
  NewtonTask look = at_once;
  look.most_iterations = 0;
  look.planes = planes;
  double dt = first_step;
  for (int n = 0; n < most_steps_free; ++n) {
    const NewtonTask task{
        .dt = dt, .tolerance = 0.1 * at_once.tolerance, .most_iterations = 20, .planes = planes};
    const NewtonReport now = newton.solve(crew, task);
    go_on(newton, crew, true);
    const NewtonReport left = newton.solve(crew, look);
    go_on(newton, crew, false);
    add(all, now);
    all.residual = left.residual, all.scale = left.scale, all.converged = left.converged;
    if (left.converged) return;
    dt = now.converged ? std::min(longest_step, 2 * dt) : 0.25 * dt;
  }
}

}  // namespace

double way_down(const Body& body, const Vec3& gravity, std::span<const Plane> planes) {
  double way = std::numeric_limits<double>::infinity();
  if (gravity.isZero()) return way;
  const Vec3 down = gravity.normalized();
  for (const Plane& plane : planes) {
    const double against = -plane.n.dot(down);
    if (against < 1e-6) continue;  // upright
    for (const Index node : body.nodes())
      if (!body.lattice.is_beyond(node))
        way = std::min(way, (plane.n.dot(body.rest_position(node)) - plane.height) / against);
  }
  return way;
}

Equilibrium equilibrium(const Body& body, const Vec3& gravity, std::span<const Plane> planes,
                        const Crew& crew) {
  Newton<double> newton(body);
  load(body, gravity, newton);
  Equilibrium found;
  if (body.n_held > 0) {
    settle(newton, planes, crew, found.report);
  } else {
    const Vec3 down = way_down(body, gravity, planes) * gravity.normalized();
    newton.each_node(crew, [&](std::size_t i) {
      for (std::size_t a = 0; a < 3; ++a) newton.u[a][i] = down[static_cast<Eigen::Index>(a)];
    });
    settle_free(newton, planes, crew, found.report);
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
