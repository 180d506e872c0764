#include "physics_node/step/lattice/node_kicks.h"

namespace palpate::physics {
namespace {

template <class Real>
Vec3 place_of(const Body& body, const LatticeState<Real>& state, Index cell) noexcept {
  return body.rest_position(cell) + vector_of(state.u, cell);
}

/// Nodes that are stepped on their own have moved as the last forces would have it: see hex_fast.h.
template <class Real>
void kick_fast(const Body& body, LatticeState<Real>& state, const NodalForce& nodal, double dt,
               MomentumAccount& momentum) noexcept {
  const auto c = static_cast<std::size_t>(nodal.cell);
  const auto w = static_cast<double>(state.inverse_mass[c]);
  std::array<Real, 3> a;
  for (std::size_t i = 0; i < 3; ++i) a[i] = static_cast<Real>(w * nodal.force[static_cast<Eigen::Index>(i)]);
  const std::array<Real, 3> left = state.fast.learn(nodal.cell, a);
  Vec3 done, late;
  for (std::size_t i = 0; i < 3; ++i) {
    late[static_cast<Eigen::Index>(i)] = dt / w * static_cast<double>(left[i]);
    done[static_cast<Eigen::Index>(i)] = dt / w * static_cast<double>(a[i] - left[i]);
  }
  const Vec3 x = place_of(body, state, nodal.cell), v = vector_of(state.v, nodal.cell);
  momentum.hit(done, x - dt * v);
  momentum.push(late, x - dt * (v + state.fast.lead(nodal.cell)), dt);
  for (std::size_t i = 0; i < 3; ++i) {
    state.v[i][c] += static_cast<Real>(dt) * left[i];
    state.u[i][c] += static_cast<Real>(dt * dt) * left[i];
  }
}

}  // namespace

template <class Real>
void kick_node(const Body& body, LatticeState<Real>& state, const NodalForce& nodal, double dt,
               MomentumAccount& momentum) noexcept {
  if (state.fast.has(nodal.cell)) return kick_fast(body, state, nodal, dt, momentum);
  const auto c = static_cast<std::size_t>(nodal.cell);
  const bool verlet = state.v_half[0].size() > 0;
  const Vec3 moving = vector_of(moving_velocity(state), nodal.cell);
  momentum.push(dt * nodal.force, place_of(body, state, nodal.cell) - dt * moving, dt);
  for (std::size_t a = 0; a < 3; ++a) {
    const Real dv = static_cast<Real>(dt * nodal.force[static_cast<Eigen::Index>(a)]) * state.inverse_mass[c];
    // With velocity_verlet v is half a step ahead of the velocity that moves the mass.
    state.v[a][c] += verlet ? Real(1.5) * dv : dv;
    state.u[a][c] += static_cast<Real>(dt) * dv;
    if (verlet) state.v_half[a][c] += dv;
  }
}

template <class Real>
void push_node(const Body& body, LatticeState<Real>& state, const NodalPush& push, double dt,
               Three<Real>& v_before, MomentumAccount& momentum) noexcept {
  const auto c = static_cast<std::size_t>(push.cell);
  const bool verlet = state.v_half[0].size() > 0;
  momentum.push(push.dv / static_cast<double>(state.inverse_mass[c]),
                place_of(body, state, push.cell) - dt * vector_of(moving_velocity(state), push.cell), dt);
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = push.dv[static_cast<Eigen::Index>(a)];
    state.v[a][c] += static_cast<Real>(d);
    state.u[a][c] += static_cast<Real>(dt * d);
    if (verlet) state.v_half[a][c] += static_cast<Real>(d);
    // The impulse acts before the elements do: who reads the mean of this and the velocity after them finds all of it.
    if (v_before[a].size() > 0) v_before[a][c] += static_cast<Real>(d);
  }
}

template void kick_node(const Body&, LatticeState<float>&, const NodalForce&, double,
                        MomentumAccount&) noexcept;
template void kick_node(const Body&, LatticeState<double>&, const NodalForce&, double,
                        MomentumAccount&) noexcept;
template void push_node(const Body&, LatticeState<float>&, const NodalPush&, double, Three<float>&,
                        MomentumAccount&) noexcept;
template void push_node(const Body&, LatticeState<double>&, const NodalPush&, double, Three<double>&,
                        MomentumAccount&) noexcept;

}  // namespace palpate::physics
