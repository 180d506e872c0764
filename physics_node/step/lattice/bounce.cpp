#include "physics_node/step/lattice/bounce.h"

#include "physics_node/step/rebound.h"

namespace palpate::physics {
template <class Real>
Bounces bounce(const Body& body, LatticeState<Real>& state, const Three<Real>& moving, Three<Real>& before,
               const Plane& plane, double e, double dt, MomentumAccount& momentum) noexcept {
  Bounces sum;
  const bool verlet = state.v_half[0].size() > 0;
  // A mass that rests at `at`, `rest` above the plane.
  const auto meet = [&](Index cell, double rest, const auto& at) {
    const auto c = static_cast<std::size_t>(cell);
    const Vec3 u = vector_of(state.u, cell);
    const Vec3 v_move = vector_of(moving, cell);
    if (rest + plane.n.dot(u - dt * v_move) >= 0 || state.inverse_mass[c] == 0 || body.is_beyond(cell))
      return;
    const double v_n = plane.n.dot(Vec3(0.5 * (v_move + vector_of(before, cell))));
    if (v_n >= 0) return;
    const double dv = rebound(e, v_n, plane.n.dot(v_move));
    for (std::size_t a = 0; a < 3; ++a) {
      const Real d = static_cast<Real>(dv * plane.n[static_cast<Eigen::Index>(a)]);
      state.v[a][c] += d;
      state.u[a][c] += static_cast<Real>(dt) * d;
      if (verlet) state.v_half[a][c] += d;
      before[a][c] += d;
    }
    const double mass = 1 / static_cast<double>(state.inverse_mass[c]);
    const Vec3 J = mass * dv * plane.n;
    ++sum.masses;
    momentum.push(J, at() + u - dt * v_move, dt);
    sum.lost -= mass * (dv * v_n + 0.5 * dv * dv);
  };
  for (std::size_t r = 0; r < body.lattice.rows.size(); ++r) {
    if (state.row_state[r] != RowState::awake) continue;
    const RowSegment& row = body.lattice.rows[r];
    const Vec3 first = body.lattice.rest_position(row.first);
    // Masses of a row rest two steps of x apart.
    const Vec3 along = body.lattice.rest_position(row.first + 1) - first;
    const double rest = plane.n.dot(first) - plane.height;
    const double per_mass = plane.n.dot(along);
    for (Index i = 0; i < row.count; ++i)
      meet(row.first + i, rest + per_mass * i, [&] { return Vec3(first + i * along); });
  }
  body.each_copy([&](Index copy) {
    const Vec3 at = body.rest_position(copy);
    meet(copy, plane.n.dot(at) - plane.height, [&] { return at; });
  });
  return sum;
}

template Bounces bounce(const Body&, LatticeState<float>&, const Three<float>&, Three<float>&, const Plane&,
                        double, double, MomentumAccount&) noexcept;
template Bounces bounce(const Body&, LatticeState<double>&, const Three<double>&, Three<double>&,
                        const Plane&, double, double, MomentumAccount&) noexcept;

}  // namespace palpate::physics
