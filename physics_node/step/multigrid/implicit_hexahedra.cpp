#include "physics_node/step/multigrid/implicit_hexahedra.h"

#include <algorithm>

#include "physics_node/step/node_motion.h"

namespace palpate::physics {

template <class Real>
ImplicitHexahedra<Real>::ImplicitHexahedra(const Body& body)
    : newton_(body), node_of_(static_cast<std::size_t>(body.capacity()), -1) {
  const std::vector<Index>& storage = newton_.storage();
  mass_ = ZeroedArray<double>(storage.size());
  for (std::size_t i = 0; i < storage.size(); ++i) {
    if (storage[i] < 0) continue;
    const auto node = static_cast<std::size_t>(storage[i]);
    node_of_[node] = static_cast<Index>(i);
    if (body.inverse_mass[node] > 0) mass_[i] = 1 / body.inverse_mass[node];
  }
}

template <class Real>
void ImplicitHexahedra<Real>::take(const LatticeState<Real>& state, const Crew& crew,
                                   const Vec3& gravity) noexcept {
  newton_.each_node(crew, [&](std::size_t i) {
    const auto node = static_cast<std::size_t>(newton_.storage()[i]);
    for (std::size_t a = 0; a < 3; ++a) {
      newton_.u[a][i] = state.u[a][node];
      newton_.push[a][i] = static_cast<Real>(mass_[i] * gravity[static_cast<Eigen::Index>(a)]);
      newton_.D[a][i] = newton_.coast[a][i] = 0;
    }
  });
}

template <class Real>
void ImplicitHexahedra<Real>::give(LatticeState<Real>& state, const Crew& crew, double dt) noexcept {
  newton_.each_node(crew, [&](std::size_t i) {
    if (mass_[i] == 0) return;
    const auto node = static_cast<std::size_t>(newton_.storage()[i]);
    for (std::size_t a = 0; a < 3; ++a) {
      state.u[a][node] = newton_.u[a][i] + newton_.D[a][i];
      state.v[a][node] = dt > 0 ? static_cast<Real>(static_cast<double>(newton_.D[a][i]) / dt) : Real(0);
    }
  });
}

template <class Real>
double ImplicitHexahedra<Real>::work_of_elements(const Crew& crew) noexcept {
  return newton_.sum(crew, [&](std::size_t i) {
    double work = 0;
    for (std::size_t a = 0; a < 3 && mass_[i] > 0; ++a)
      work += static_cast<double>(newton_.force[a][i]) * static_cast<double>(newton_.D[a][i]);
    return work;
  });
}

template <class Real>
void ImplicitHexahedra<Real>::book(LatticeState<Real>& state, const Crew& crew, const NewtonTask& task,
                                   double before) noexcept {
  // A step takes (1/2) m |v' - v|^2 and what the elements held back beyond the energy that they took up. What the solver left over
  // does work, too: it is not booked, so that the balance of the ledger shows it.
  const double inertia = newton_.sum(crew, [&](std::size_t i) {
    double less = 0;
    for (std::size_t a = 0; a < 3 && mass_[i] > 0; ++a) {
      const double change =
          (static_cast<double>(newton_.D[a][i]) - static_cast<double>(newton_.coast[a][i])) / task.dt;
      less += 0.5 * mass_[i] * change * change;
    }
    return less;
  });
  const double held = work_of_elements(crew);
  const double after = newton_.evaluate(crew, 1);
  const double viscous = task.beta > 0 ? work_of_elements(crew) - held : 0;
  state.ledger.front().viscous += viscous;
  state.ledger.front().numerical += inertia - held - (after - before) - viscous;
}

template <class Real>
ImplicitReport ImplicitHexahedra<Real>::step(const Body& body, LatticeState<Real>& state,
                                             const ExplicitStep& how,
                                             std::span<const NodalForce> forces) noexcept {
  const Crew crew{how.team, how.threads};
  take(state, crew, how.gravity);
  for (const NodalForce& nodal : forces) {
    const Index i = node_of_[static_cast<std::size_t>(nodal.cell)];
    for (std::size_t a = 0; a < 3 && i >= 0; ++a)
      newton_.push[a][static_cast<std::size_t>(i)] +=
          static_cast<Real>(nodal.force[static_cast<Eigen::Index>(a)]);
  }
  const double before = newton_.evaluate(crew, 1);  // D = 0
  newton_.each_node(crew, [&](std::size_t i) {
    const auto node = static_cast<std::size_t>(newton_.storage()[i]);
    for (std::size_t a = 0; a < 3 && mass_[i] > 0; ++a)
      newton_.D[a][i] = newton_.coast[a][i] =
          static_cast<Real>(how.dt * static_cast<double>(state.v[a][node]));
  });
  const NewtonTask task{.dt = how.dt, .beta = body.solid->beta};
  const NewtonReport solved = newton_.solve(crew, task);
  ImplicitReport report{
      .newton_iterations = solved.iterations, .cg_iterations = solved.cycles, .converged = solved.converged};
  for (const NodalForce& nodal : forces) {
    const Index i = node_of_[static_cast<std::size_t>(nodal.cell)];
    for (std::size_t a = 0; a < 3 && i >= 0 && mass_[static_cast<std::size_t>(i)] > 0; ++a)
      report.work += nodal.force[static_cast<Eigen::Index>(a)] *
                     static_cast<double>(newton_.D[a][static_cast<std::size_t>(i)]);
  }
  book(state, crew, task, before);
  give(state, crew, how.dt);
  return report;
}

template class ImplicitHexahedra<float>;
template class ImplicitHexahedra<double>;

}  // namespace palpate::physics
