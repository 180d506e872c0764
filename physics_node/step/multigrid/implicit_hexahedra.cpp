#include "physics_node/step/multigrid/implicit_hexahedra.h"

#include <algorithm>

#include "physics_node/step/momentum_account.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {
namespace {

// Why: a mass that leaves a plane may not be thrown through its neighbours.
constexpr double farthest_thrown = 0.25;  // in a step [of a cell]

}  // namespace

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
void ImplicitHexahedra<Real>::take(const LatticeState<Real>& state, const Crew& crew) noexcept {
  newton_.each_node(crew, [&](std::size_t i) {
    const auto node = static_cast<std::size_t>(newton_.storage()[i]);
    for (std::size_t a = 0; a < 3; ++a) {
      newton_.u[a][i] = state.u[a][node];
      newton_.D[a][i] = newton_.coast[a][i] = 0;
    }
  });
}

template <class Real>
void ImplicitHexahedra<Real>::push(const Crew& crew, const Vec3& gravity, const StepForces& forces) noexcept {
  newton_.each_node(crew, [&](std::size_t i) {
    for (std::size_t a = 0; a < 3; ++a)
      newton_.push[a][i] = static_cast<Real>(mass_[i] * gravity[static_cast<Eigen::Index>(a)]);
  });
  for (const auto& list : {forces.tools, forces.contact})
    for (const NodalForce& nodal : list) {
      const Index i = node_of_[static_cast<std::size_t>(nodal.cell)];
      for (std::size_t a = 0; a < 3 && i >= 0; ++a)
        newton_.push[a][static_cast<std::size_t>(i)] +=
            static_cast<Real>(nodal.force[static_cast<Eigen::Index>(a)]);
    }
}

template <class Real>
double ImplicitHexahedra<Real>::work_of(std::span<const NodalForce> forces) const noexcept {
  double work = 0;
  for (const NodalForce& nodal : forces) {
    const Index i = node_of_[static_cast<std::size_t>(nodal.cell)];
    if (i >= 0 && mass_[static_cast<std::size_t>(i)] > 0) work += nodal.force.dot(vector_of(newton_.D, i));
  }
  return work;
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
  const double after = newton_.evaluate(crew, 0);
  const double viscous = task.beta > 0 ? work_of_elements(crew) - held : 0;
  state.ledger.front().viscous += viscous;
  state.ledger.front().numerical += inertia - held - (after - before) - viscous;
}

template <class Real>
void ImplicitHexahedra<Real>::bounce(LatticeState<Real>& state, const ExplicitStep& how,
                                     MomentumAccount& momentum) noexcept {
  if (how.planes.empty()) return;
  const double fastest = farthest_thrown * newton_.edge() / how.dt;
  // One thread: few nodes lie on planes, and momentum is summed in one order.
  newton_.each_node({}, [&](std::size_t i) {
    const PlaneSet by = newton_.held_by(i);
    if (by == 0) return;
    const auto node = static_cast<Index>(i);
    const Vec3 D = vector_of(newton_.D, node), R = vector_of(newton_.reaction, node);
    const PlaneImpact impact = impact_of(mass_[i], vector_of(newton_.coast, node) / how.dt, D, R,
                                         directions_of(by, how.planes), how.dt, how.restitution, fastest);
    const Vec3 x = newton_.rest(i) + vector_of(newton_.u, node);
    momentum.push(how.dt * R, x, how.dt);
    momentum.hit(mass_[i] * impact.dv, x + D);
    report_.contact_lost += impact.contact;
    state.ledger.front().numerical += impact.numerical;
    for (std::size_t a = 0; a < 3; ++a)
      state.v[a][static_cast<std::size_t>(newton_.storage()[i])] +=
          static_cast<Real>(impact.dv[static_cast<Eigen::Index>(a)]);
  });
}

template <class Real>
void ImplicitHexahedra<Real>::solve(const Body& body, const LatticeState<Real>& state,
                                    const ExplicitStep& how, const StepForces& forces, bool again) noexcept {
  const Crew crew{how.team, how.threads};
  if (!again) {
    report_ = {};
    take(state, crew);
    before_ = newton_.evaluate(crew, 0);  // D = 0
    newton_.each_node(crew, [&](std::size_t i) {
      const auto node = static_cast<std::size_t>(newton_.storage()[i]);
      for (std::size_t a = 0; a < 3 && mass_[i] > 0; ++a)
        newton_.D[a][i] = newton_.coast[a][i] =
            static_cast<Real>(how.dt * static_cast<double>(state.v[a][node]));
    });
  }
  push(crew, how.gravity, forces);
  const NewtonReport solved =
      newton_.solve(crew, {.dt = how.dt, .beta = body.solid->beta, .held = before_, .planes = how.planes});
  report_.newton_iterations += solved.iterations;
  report_.cg_iterations += solved.cycles;
  report_.converged = solved.converged;
}

template <class Real>
Vec3 ImplicitHexahedra<Real>::velocity(Index cell, double dt) const noexcept {
  const Index i = node_of_[static_cast<std::size_t>(cell)];
  return i < 0 ? Vec3(Vec3::Zero()) : Vec3(vector_of(newton_.D, i) / dt);
}

template <class Real>
ImplicitReport ImplicitHexahedra<Real>::finish(const Body& body, LatticeState<Real>& state,
                                               const ExplicitStep& how, const StepForces& forces,
                                               MomentumAccount& momentum) noexcept {
  const Crew crew{how.team, how.threads};
  report_.work = work_of(forces.tools);
  report_.contact_lost = -work_of(forces.contact);
  book(state, crew, {.dt = how.dt, .beta = body.solid->beta}, before_);
  give(state, crew, how.dt);
  bounce(state, how, momentum);
  return report_;
}

template class ImplicitHexahedra<float>;
template class ImplicitHexahedra<double>;

}  // namespace palpate::physics
