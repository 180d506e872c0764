#include "physics_node/step/lattice/implicit_step.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/element_step.h"
#include "physics_node/step/momentum_account.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {
namespace {

constexpr int most_newton = 30;
constexpr int most_halvings = 5;
constexpr int most_stalls = 4;  // iterations in a row that bring less than a tenth
constexpr int most_cg = 400;
constexpr double lies_on = 1e-6;  // a plane, if it is nearer [of a cell]
constexpr double deep = 0.25;     // where D would begin within a plane [of a cell]; then it begins at rest
constexpr double loose = 1e-3;    // of a linear system, relative to its right side
constexpr double tight = 1e-10;   // of the residual, relative to the forces in play

void make_field(Field& field, std::size_t n, std::size_t& colour) {
  for (auto& axis : field) axis = ZeroedArray<double>(n, colour++);
}

/// Calls visit(cell) for the cells of all rows.
template <class Visit>
void for_cells(const Body& body, const Visit& visit) {
  for (const RowSegment& row : body.lattice.rows)
    for (Index i = row.first; i < row.first + row.count; ++i) visit(static_cast<std::size_t>(i));
}

double dot(const Body& body, const Field& a, const Field& b) {
  double sum = 0;
  for_cells(body, [&](std::size_t i) { sum += a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i]; });
  return sum;
}

/// y := y + s x
void add(const Body& body, double s, const Field& x, Field& y) {
  for (std::size_t a = 0; a < 3; ++a) for_cells(body, [&](std::size_t i) { y[a][i] += s * x[a][i]; });
}

void zero(const Body& body, Field& field) {
  for (std::size_t a = 0; a < 3; ++a) for_cells(body, [&](std::size_t i) { field[a][i] = 0; });
}

}  // namespace

template <class Real>
ImplicitStep<Real>::ImplicitStep(const Body& body) : elements_(body) {
  const auto n = static_cast<std::size_t>(body.lattice.n_cells());
  std::size_t colour = 50;
  for (Field* field : {&D_, &trial_, &r_, &r_start_, &x_, &p_, &z_, &q_}) make_field(*field, n, colour);
  for (auto& part : inverse_) part = ZeroedArray<double>(n, colour++);
  at_.assign(n, 0);
  held_.reserve(body.lattice.masses.size());
  mass_ = ZeroedArray<double>(n, colour++);
  drag_ = ZeroedArray<double>(n, colour++);
  for (const Index cell : body.lattice.masses) {
    const auto i = static_cast<std::size_t>(cell);
    if (body.inverse_mass[i] == 0) continue;
    mass_[i] = 1 / body.inverse_mass[i];
    drag_[i] = law_at(body, cell).drag;
  }
}

template <class Real>
void ImplicitStep<Real>::find_drag(const Body& body, const LatticeState<Real>& state) noexcept {
  if (body.law.damper != Damper::drag) return;
  for (const Index cell : body.lattice.masses)
    drag_[static_cast<std::size_t>(cell)] = law_at(body, cell).drag;
  elements_.add_drag(body, state, drag_);
}

template <class Real>
double ImplicitStep<Real>::keep_out_of(const Body& body, const LatticeState<Real>& state,
                                       std::span<const Plane> planes) noexcept {
  double farthest = 0;
  const double near = lies_on * body.lattice.spacing();
  for (const Index cell : body.lattice.masses) {
    const auto i = static_cast<std::size_t>(cell);
    if (planes.empty() || mass_[i] == 0 || body.lattice.is_beyond(cell)) continue;
    const KeptOut kept = keep_out(body.lattice.rest_position(cell) + vector_of(state.u, cell),
                                  vector_at(D_, cell), planes, near);
    at_[i] = kept.at;
    if (!(kept.pushed > 0)) continue;
    for (std::size_t a = 0; a < 3; ++a) D_[a][i] = kept.D[static_cast<Eigen::Index>(a)];
    farthest = std::max(farthest, kept.pushed);
  }
  return farthest;
}

template <class Real>
void ImplicitStep<Real>::find_reactions(const Body& body, std::span<const Plane> planes) noexcept {
  held_.clear();
  if (planes.empty()) return;
  for (const Index cell : body.lattice.masses) {
    const auto i = static_cast<std::size_t>(cell);
    if (at_[i] == 0) continue;
    const Vec3 r = vector_at(r_, cell);
    const PlaneSet push = planes_that_push(at_[i], -r, planes);
    if (push == 0) continue;
    const HeldDirections held = directions_of(push, planes);
    const Vec3 R = held.part_of(r);
    held_.push_back({cell, held, R, Vec3::Zero()});
    for (std::size_t a = 0; a < 3; ++a) r_[a][i] -= R[static_cast<Eigen::Index>(a)];
  }
}

template <class Real>
void ImplicitStep<Real>::take_held(Field& field) const noexcept {
  for (const Held& one : held_) {
    const auto i = static_cast<std::size_t>(one.cell);
    const Vec3 part = one.directions.part_of(vector_at(field, one.cell));
    for (std::size_t a = 0; a < 3; ++a) field[a][i] -= part[static_cast<Eigen::Index>(a)];
  }
}

template <class Real>
double ImplicitStep<Real>::residual(const Body& body, const LatticeState<Real>& state,
                                    const ExplicitStep& how, const StepForces& forces) noexcept {
  const double dt = how.dt;
  zero(body, r_);
  elements_.evaluate(body, state, D_, dt, r_);  // r = f for now
  for (const auto& list : {forces.tools, forces.contact})
    for (const NodalForce& nodal : list)
      for (std::size_t a = 0; a < 3; ++a)
        r_[a][static_cast<std::size_t>(nodal.cell)] += nodal.force[static_cast<Eigen::Index>(a)];
  for (std::size_t a = 0; a < 3; ++a)
    for_cells(body, [&](std::size_t i) {
      const double inertia = mass_[i] * ((D_[a][i] / dt - static_cast<double>(state.v[a][i])) / dt -
                                         how.gravity[static_cast<Eigen::Index>(a)]);
      r_[a][i] = mass_[i] > 0 ? inertia + drag_[i] * D_[a][i] / dt - r_[a][i] : 0;
    });
  find_reactions(body, how.planes);
  return std::sqrt(dot(body, r_, r_));
}

template <class Real>
void ImplicitStep<Real>::make_preconditioner(const Body& body, double dt) noexcept {
  for (auto& part : inverse_) for_cells(body, [&](std::size_t i) { part[i] = 0; });
  elements_.add_blocks(body, inverse_);
  for_cells(body, [&](std::size_t i) {
    if (mass_[i] == 0) return;
    const double own = mass_[i] / (dt * dt) + drag_[i] / dt;
    const double xx = inverse_[0][i] + own, yy = inverse_[1][i] + own, zz = inverse_[2][i] + own;
    const double yz = inverse_[3][i], xz = inverse_[4][i], xy = inverse_[5][i];
    const double XX = yy * zz - yz * yz, XY = xz * yz - xy * zz, XZ = xy * yz - xz * yy;
    const double over = 1 / (xx * XX + xy * XY + xz * XZ);
    inverse_[0][i] = over * XX;
    inverse_[1][i] = over * (xx * zz - xz * xz);
    inverse_[2][i] = over * (xx * yy - xy * xy);
    inverse_[3][i] = over * (xy * xz - xx * yz);
    inverse_[4][i] = over * XZ;
    inverse_[5][i] = over * XY;
  });
  std::array<double*, 6> blocks{};
  for (std::size_t e = 0; e < 6; ++e) blocks[e] = inverse_[e].data();
  for (const Held& one : held_) hold_block(one.directions, blocks, static_cast<std::size_t>(one.cell));
}

template <class Real>
void ImplicitStep<Real>::apply(const Body& body, double dt, const Field& x, Field& y) const noexcept {
  for (std::size_t a = 0; a < 3; ++a)
    for_cells(body, [&](std::size_t i) { y[a][i] = (mass_[i] / (dt * dt) + drag_[i] / dt) * x[a][i]; });
  elements_.add_product(body, x, y);
  for (std::size_t a = 0; a < 3; ++a)
    for_cells(body, [&](std::size_t i) { y[a][i] = mass_[i] > 0 ? y[a][i] : 0; });
  take_held(y);
}

template <class Real>
int ImplicitStep<Real>::conjugate_gradients(const Body& body, double dt, double tolerance) noexcept {
  const auto precondition = [&] {
    for_cells(body, [&](std::size_t i) {
      const double x = r_[0][i], y = r_[1][i], z = r_[2][i];
      const double on = mass_[i] > 0 ? 1 : 0;
      z_[0][i] = on * (inverse_[0][i] * x + inverse_[5][i] * y + inverse_[4][i] * z);
      z_[1][i] = on * (inverse_[5][i] * x + inverse_[1][i] * y + inverse_[3][i] * z);
      z_[2][i] = on * (inverse_[4][i] * x + inverse_[3][i] * y + inverse_[2][i] * z);
    });
  };
  // A x = - r: r_ becomes the remainder - r - A x.
  for (std::size_t a = 0; a < 3; ++a)
    for_cells(body, [&](std::size_t i) { r_[a][i] = -r_[a][i], x_[a][i] = 0; });
  precondition();
  for (std::size_t a = 0; a < 3; ++a) for_cells(body, [&](std::size_t i) { p_[a][i] = z_[a][i]; });
  double rz = dot(body, r_, z_);
  int n = 0;
  for (; n < most_cg && std::sqrt(dot(body, r_, r_)) > tolerance; ++n) {
    apply(body, dt, p_, q_);
    const double pq = dot(body, p_, q_);
    if (!(pq > 0)) {
      // Compressed elements buckle this way: what was found so far still leads downhill (Nocedal & Wright, Newton-CG).
      if (n == 0) add(body, 1, z_, x_);
      break;
    }
    add(body, rz / pq, p_, x_);
    add(body, -rz / pq, q_, r_);
    precondition();
    const double next = dot(body, r_, z_);
    for (std::size_t a = 0; a < 3; ++a)
      for_cells(body, [&](std::size_t i) { p_[a][i] = z_[a][i] + next / rz * p_[a][i]; });
    rz = next;
  }
  take_held(x_);  // of the last digits, too
  return n;
}

template <class Real>
void ImplicitStep<Real>::solve(const Body& body, const LatticeState<Real>& state, const ExplicitStep& how,
                               const StepForces& forces, bool again) noexcept {
  const double dt = how.dt;
  if (!again) {
    report_ = {};
    find_drag(body, state);
    for (std::size_t a = 0; a < 3; ++a)
      for_cells(body, [&](std::size_t i) {
        D_[a][i] = mass_[i] > 0 ? dt * static_cast<double>(state.v[a][i]) : 0;
      });
    if (keep_out_of(body, state, how.planes) > deep * body.lattice.spacing()) {
      zero(body, D_);
      keep_out_of(body, state, how.planes);
    }
  }
  double r = residual(body, state, how, forces);
  // The forces in play: of the first residual, and never less than those of a hundred-thousandth of a cell.
  double k = 0;
  for (const ElementLaw& law : body.laws) k = std::max(k, law.k1[0]);
  const double enough = tight * std::max(r, 1e-5 * k * body.lattice.rest_length[0]);
  enough_ = again ? std::max(enough_, enough) : enough;
  int stalls = 0;
  for (int n = 0; n < most_newton && stalls < most_stalls && r > enough_; ++n) {
    make_preconditioner(body, dt);
    for (std::size_t a = 0; a < 3; ++a) for_cells(body, [&](std::size_t i) { r_start_[a][i] = r_[a][i]; });
    report_.cg_iterations += conjugate_gradients(body, dt, std::max(loose * r, 0.1 * enough_));
    for (std::size_t a = 0; a < 3; ++a) for_cells(body, [&](std::size_t i) { trial_[a][i] = D_[a][i]; });
    // Toward where the residual has no part along x any more (Matthies & Strang 1979).
    const double slope = dot(body, r_start_, x_);
    double s = 1;
    double next = 0;
    for (int halving = 0; halving <= most_halvings; ++halving, s *= 0.5) {
      for (std::size_t a = 0; a < 3; ++a)
        for_cells(body, [&](std::size_t i) { D_[a][i] = trial_[a][i] + s * x_[a][i]; });
      keep_out_of(body, state, how.planes);
      next = residual(body, state, how, forces);
      const double left = dot(body, r_, x_);
      if (next < r || left <= 0 || left < -0.8 * slope) break;
    }
    stalls = next > 0.9 * r ? stalls + 1 : 0;
    r = next;
    ++report_.newton_iterations;
  }
  report_.converged = r <= enough_;
}

template <class Real>
double ImplicitStep<Real>::meet_planes(const Body& body, const LatticeState<Real>& state,
                                       const ExplicitStep& how, MomentumAccount& momentum) noexcept {
  // Why: a mass may not be thrown through its neighbours.
  const double fastest = deep * body.lattice.spacing() / how.dt;
  double numerical = 0;
  for (Held& one : held_) {
    const auto i = static_cast<std::size_t>(one.cell);
    const Vec3 D = vector_at(D_, one.cell);
    const PlaneImpact impact = impact_of(mass_[i], vector_of(state.v, one.cell), D, one.R, one.directions,
                                         how.dt, how.restitution, fastest);
    const Vec3 x = body.lattice.rest_position(one.cell) + vector_of(state.u, one.cell);
    momentum.push(how.dt * one.R, x, how.dt);
    momentum.hit(mass_[i] * impact.dv, x + D);
    report_.contact_lost += impact.contact;
    numerical += impact.numerical;
    one.dv = impact.dv;
  }
  return numerical;
}

template <class Real>
ImplicitReport ImplicitStep<Real>::finish(const Body& body, LatticeState<Real>& state,
                                          const ExplicitStep& how, const StepForces& forces,
                                          MomentumAccount& momentum) noexcept {
  const auto work = [&](std::span<const NodalForce> list) {
    double sum = 0;
    for (const NodalForce& nodal : list)
      if (mass_[static_cast<std::size_t>(nodal.cell)] > 0) sum += nodal.force.dot(vector_at(D_, nodal.cell));
    return sum;
  };
  report_.work = work(forces.tools);
  report_.contact_lost = -work(forces.contact);
  const StepLosses lost = elements_.losses(body, state, D_, how.dt);
  double inertia = meet_planes(body, state, how, momentum);
  double drag = 0;
  for (std::size_t a = 0; a < 3; ++a)
    for_cells(body, [&](std::size_t i) {
      if (mass_[i] == 0) return;
      const double v = D_[a][i] / how.dt;
      const double change = v - static_cast<double>(state.v[a][i]);
      inertia += 0.5 * mass_[i] * change * change;
      drag += drag_[i] * v * D_[a][i];
      state.u[a][i] = static_cast<Real>(static_cast<double>(state.u[a][i]) + D_[a][i]);
      state.v[a][i] = static_cast<Real>(v);
    });
  for (const Held& one : held_)
    for (std::size_t a = 0; a < 3; ++a)
      state.v[a][static_cast<std::size_t>(one.cell)] +=
          static_cast<Real>(one.dv[static_cast<Eigen::Index>(a)]);
  state.ledger.front().viscous += lost.viscous + drag;
  state.ledger.front().numerical += lost.numerical + inertia;
  return report_;
}

template class ImplicitStep<float>;
template class ImplicitStep<double>;

}  // namespace palpate::physics
