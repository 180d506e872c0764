#include "physics_node/step/multigrid/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::physics {
namespace {

constexpr int most_halvings = 6;
constexpr double inner_tolerance = 0.1;
constexpr double armijo = 1e-4;
// Why: the last digit of a node is felt by its neighbours, too; a swinging bar of 1 MPa stayed at 3 to 4.
constexpr double digits_felt = 6;
constexpr double lies_on = 1e-6;  // a plane, if it is nearer [of a cell]
constexpr double hovers = 1e-3;   // over a plane that it is driven into, if it is nearer [of a cell]
constexpr double deep = 0.25;     // where D would begin within a plane [of a cell]; then it begins at rest

}  // namespace

template <class Real>
Newton<Real>::Newton(const Body& body)
    : hierarchy_(body),
      gradients_(hierarchy_),
      edge_(body.lattice.step.minCoeff()),
      by_plane_(hierarchy_.fine().planes().size()) {
  const auto n = static_cast<std::size_t>(fine().n_nodes());
  std::size_t colour = 30;
  for (auto* three : {&u, &coast, &push, &D, &force, &reaction, &from_})
    for (auto& axis : *three) axis = ZeroedArray<Real>(n, colour++);
  for (auto& axis : rest_) axis = ZeroedArray<double>(n, colour++);
  at_.assign(n, 0);
  held_from_.assign(n, 0);
  beyond_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    if (storage()[i] >= 0 && body.lattice.is_beyond(storage()[i])) beyond_[i] = 1;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t a = 0; a < 3 && storage()[i] >= 0; ++a)
      rest_[a][i] = body.rest_position(storage()[i])[static_cast<Eigen::Index>(a)];
}

template <class Real>
double Newton<Real>::keep_out_of(const Crew& crew, std::span<const Plane> planes) noexcept {
  if (planes.empty()) return 0;
  const LevelContext<Real> m = hierarchy_.fine().context();
  fine().each_plane(crew, [&](Index p) {
    const GridPlane& plane = fine().planes()[static_cast<std::size_t>(p)];
    double farthest = 0;
    for (Index i = plane.first; i < plane.last; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (!(m.free[i] > 0) || beyond_[n] != 0) continue;
      const KeptOut kept = keep_out(rest(n) + vector_of(u, i), vector_of(D, i), planes, lies_on * edge_);
      at_[n] = kept.at;
      if (!(kept.pushed > 0)) continue;
      for (std::size_t a = 0; a < 3; ++a) D[a][n] = static_cast<Real>(kept.D[static_cast<Eigen::Index>(a)]);
      farthest = std::max(farthest, kept.pushed);
    }
    by_plane_[static_cast<std::size_t>(p)] = farthest;
  });
  return *std::max_element(by_plane_.begin(), by_plane_.end());
}

template <class Real>
void Newton<Real>::find_reaction(std::size_t node, std::span<const Plane> planes) noexcept {
  if (planes.empty()) return;
  Three<Real>& b = gradients_.b;
  const Vec3 pressed = vector_of(b, static_cast<Index>(node));
  const PlaneSet by = at_[node] != 0 ? planes_that_push(at_[node], pressed, planes) : 0;
  hierarchy_.supports().set(node, by);
  const Vec3 taken = by != 0 ? directions_of(by, planes).part_of(pressed) : Vec3::Zero();
  for (std::size_t a = 0; a < 3; ++a) {
    reaction[a][node] = static_cast<Real>(-taken[static_cast<Eigen::Index>(a)]);
    if (by != 0) b[a][node] += reaction[a][node];
  }
}

template <class Real>
bool Newton<Real>::land(const Crew& crew, std::span<const Plane> planes) noexcept {
  if (planes.empty()) return false;
  const LevelContext<Real> m = hierarchy_.fine().context();
  const Three<Real>& b = gradients_.b;
  fine().each_plane(crew, [&](Index p) {
    const GridPlane& plane = fine().planes()[static_cast<std::size_t>(p)];
    double landed = 0;
    for (Index i = plane.first; i < plane.last; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (!(m.free[i] > 0) || beyond_[n] != 0) continue;
      const Vec3 x = rest(n) + vector_of(u, i), pressed = vector_of(b, i);
      for (const Plane& wall : planes) {
        const double room = room_left(wall, x, vector_of(D, i));
        if (room <= lies_on * edge_ || room > hovers * edge_ || wall.n.dot(pressed) >= 0) continue;
        for (std::size_t a = 0; a < 3; ++a)
          D[a][n] -= static_cast<Real>(room * wall.n[static_cast<Eigen::Index>(a)]);
        landed = 1;
      }
    }
    by_plane_[static_cast<std::size_t>(p)] = landed;
  });
  return *std::max_element(by_plane_.begin(), by_plane_.end()) > 0;
}

template <class Real>
double Newton<Real>::first_touch(const Crew& crew, std::span<const Plane> planes) noexcept {
  constexpr double none = 2;
  if (planes.empty()) return none;
  const LevelContext<Real> m = hierarchy_.fine().context();
  fine().each_plane(crew, [&](Index p) {
    const GridPlane& plane = fine().planes()[static_cast<std::size_t>(p)];
    double first = none;
    for (Index i = plane.first; i < plane.last; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (!(m.free[i] > 0) || beyond_[n] != 0) continue;
      const Vec3 x = rest(n) + vector_of(u, i);
      for (const Plane& wall : planes) {
        const double room = room_left(wall, x, vector_of(from_, i));
        const double nearer = -wall.n.dot(vector_of(gradients_.x, i));
        if (room > lies_on * edge_ && nearer > 0) first = std::min(first, room / nearer);
      }
    }
    by_plane_[static_cast<std::size_t>(p)] = first;
  });
  return *std::min_element(by_plane_.begin(), by_plane_.end());
}

template <class Real>
bool Newton<Real>::hold_what_is_driven_in(const Crew& crew, std::span<const Plane> planes) noexcept {
  if (planes.empty()) return false;
  const LevelContext<Real> m = hierarchy_.fine().context();
  Three<Real>& b = gradients_.b;
  fine().each_plane(crew, [&](Index p) {
    const GridPlane& plane = fine().planes()[static_cast<std::size_t>(p)];
    double held = 0;
    for (Index i = plane.first; i < plane.last; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (!(m.free[i] > 0) || beyond_[n] != 0) continue;
      const PlaneSet before = hierarchy_.supports().of(n);
      PlaneSet by = before;
      for (std::size_t k = 0; k < planes.size(); ++k)
        if ((at_[n] >> k & 1) != 0 && planes[k].n.dot(vector_of(gradients_.x, i)) < 0) by |= PlaneSet{1} << k;
      if (by == before) continue;
      hierarchy_.supports().set(n, by);
      const Vec3 taken = directions_of(by, planes).part_of(vector_of(b, i));
      for (std::size_t a = 0; a < 3; ++a) b[a][n] -= static_cast<Real>(taken[static_cast<Eigen::Index>(a)]);
      held = 1;
    }
    by_plane_[static_cast<std::size_t>(p)] = held;
  });
  return *std::max_element(by_plane_.begin(), by_plane_.end()) > 0;
}

template <class Real>
bool Newton<Real>::holds_as_before(const Crew& crew, std::span<const Plane> planes) noexcept {
  return planes.empty() || sum(crew, [&](std::size_t i) {
                             return hierarchy_.supports().of(i) != held_from_[i] ? 1.0 : 0.0;
                           }) == 0;
}

template <class Real>
void Newton<Real>::find_step(const Crew& crew, const NewtonTask& task, NewtonReport& report) noexcept {
  hierarchy_.linearise(crew, task.dt > 0 ? 1 + task.beta / task.dt : 1);
  report.cycles +=
      gradients_.solve(hierarchy_, crew, inner_tolerance, task.most_cycles - report.cycles).cycles;
}

template <class Real>
void Newton<Real>::begin(const Crew& crew, const NewtonTask& task) noexcept {
  if (task.dt != dt_) hierarchy_.set_step(task.dt);
  dt_ = task.dt;
  hierarchy_.set_planes(task.planes);
  if (keep_out_of(crew, task.planes) <= deep * edge_) return;
  each_node(crew, [&](std::size_t i) {
    for (auto& axis : D) axis[i] = 0;
  });
  keep_out_of(crew, task.planes);
}

template <class Real>
double Newton<Real>::evaluate(const Crew& crew, double lag) noexcept {
  Level<Real>& level = hierarchy_.fine();
  const LevelContext<Real> m = level.context();
  each_node(crew, [&](std::size_t i) {
    for (std::size_t a = 0; a < 3; ++a) m.u[a][i] = u[a][i] + D[a][i];
  });
  const NodeVector<Real> f = pointers(force);
  LevelContext<Real> now = m;
  now.u = pointers(u), now.d = pointers(D), now.lag = static_cast<Real>(lag);
  level.sweep(
      crew, [&](Index l) { by_plane_[static_cast<std::size_t>(l)] = level.kernel().forces(now, l); },
      [&](Index p) { level.kernel().gather(m, f, p); });
  double energy = 0;
  for (const double one : by_plane_) energy += one;
  return energy;
}

template <class Real>
double Newton<Real>::look(const Crew& crew, const NewtonTask& task, NewtonReport& report) noexcept {
  report.energy = evaluate(crew, task.dt > 0 ? task.beta / task.dt : 0);
  const LevelContext<Real> m = hierarchy_.fine().context();
  Three<Real>& b = gradients_.b;
  const double outside = sum(crew, [&](std::size_t i) {
    double phi = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const Real pull = m.mass[i] * (D[a][i] - coast[a][i]);
      b[a][i] = m.free[i] * (force[a][i] + push[a][i] - pull);
      phi += 0.5 * static_cast<double>(pull) * static_cast<double>(D[a][i] - coast[a][i]) -
             static_cast<double>(m.free[i] * push[a][i]) * static_cast<double>(D[a][i]);
    }
    find_reaction(i, task.planes);
    return phi;
  });
  report.residual = std::sqrt(gradients_.dot(hierarchy_, crew, b, b));
  return outside + report.energy;
}

template <class Real>
bool Newton<Real>::search(const Crew& crew, const NewtonTask& task, double& phi,
                          NewtonReport& report) noexcept {
  const double before = report.residual, slope = gradients_.dot(hierarchy_, crew, gradients_.b, gradients_.x);
  each_node(crew, [&](std::size_t i) {
    for (std::size_t a = 0; a < 3; ++a) from_[a][i] = D[a][i];
    held_from_[i] = hierarchy_.supports().of(i);
  });
  double step = 1, touch = 0;
  for (int halving = 0;; ++halving, step = halving > most_halvings ? touch : 0.5 * step) {
    const auto s = static_cast<Real>(step);
    each_node(crew, [&](std::size_t i) {
      for (std::size_t a = 0; a < 3; ++a) D[a][i] = from_[a][i] + s * gradients_.x[a][i];
    });
    keep_out_of(crew, task.planes);
    const double next = look(crew, task, report);
    // In float the slope along x is seen when what Phi falls by no longer is.
    const double left = gradients_.dot(hierarchy_, crew, gradients_.b, gradients_.x);
    const bool falls = next <= phi - armijo * step * slope;
    // Why not where planes hold others than before: both are of what is free, and only Phi tells of all.
    if (falls || ((report.residual < 0.9 * before || std::abs(left) < 0.5 * slope) &&
                  holds_as_before(crew, task.planes))) {
      phi = next;
      return true;
    }
    if (halving == most_halvings) touch = first_touch(crew, task.planes);
    if (halving >= most_halvings && !(touch < step)) break;
    ++report.halvings;
  }
  each_node(crew, [&](std::size_t i) {
    for (std::size_t a = 0; a < 3; ++a) D[a][i] = from_[a][i];
  });
  keep_out_of(crew, task.planes);
  phi = look(crew, task, report);
  return false;
}

template <class Real>
double Newton<Real>::rounding(const Crew& crew) noexcept {
  const LevelContext<Real> m = hierarchy_.fine().context();
  return digits_felt * static_cast<double>(std::numeric_limits<Real>::epsilon()) *
         std::sqrt(sum(crew, [&](std::size_t i) {
           const Real yields = m.inverse[0][i] + m.inverse[1][i] + m.inverse[2][i];
           double square = 0;
           for (std::size_t a = 0; a < 3 && yields > 0; ++a) {
             const double digit = static_cast<double>(3 * D[a][i] / yields);
             square += digit * digit;
           }
           return square;
         }));
}

template <class Real>
NewtonReport Newton<Real>::solve(const Crew& crew, const NewtonTask& task) noexcept {
  begin(crew, task);
  NewtonReport report;
  double phi = look(crew, task, report);
  if (land(crew, task.planes)) {
    keep_out_of(crew, task.planes);
    phi = look(crew, task, report);
  }
  const LevelContext<Real> m = hierarchy_.fine().context();
  const double outside = std::sqrt(sum(crew, [&](std::size_t i) {
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a)
      square += static_cast<double>(m.free[i] * push[a][i]) * static_cast<double>(push[a][i]);
    return square;
  }));
  report.scale = std::max(outside, report.residual);
  double enough = task.tolerance * report.scale;
  // Which nodes planes hold is found one set after the other.
  const int most_iterations = task.planes.empty() ? task.most_iterations : 3 * task.most_iterations;
  const auto seek = [&](int iterations, int cycles) {
    NewtonTask part = task;
    part.most_cycles = cycles;
    while (report.residual > enough && report.iterations < iterations && report.cycles < cycles) {
      find_step(crew, part, report);
      enough = std::max(enough, rounding(crew));
      ++report.iterations;
      if (search(crew, part, phi, report)) continue;
      if (!hold_what_is_driven_in(crew, part.planes)) break;
      find_step(crew, part, report);
      report.residual = std::sqrt(gradients_.dot(hierarchy_, crew, gradients_.b, gradients_.b));
      if (!search(crew, part, phi, report)) break;
    }
  };
  seek(most_iterations, task.most_cycles);
  // Why: where coasting crushes cells or turns them inside out, a search that gives up, or ends in another minimum, leaves more energy
  // than there was. From rest it cannot. The margin is what single precision makes of the energy.
  constexpr double margin = 1e-4;
  const auto at_rest = [&] {  // Phi at D = 0
    return task.held + sum(crew, [&](std::size_t i) {
             double square = 0;
             for (std::size_t a = 0; a < 3; ++a)
               square += static_cast<double>(coast[a][i]) * static_cast<double>(coast[a][i]);
             return 0.5 * static_cast<double>(m.mass[i]) * square;
           });
  };
  if (task.dt > 0 && !(phi <= (1 + margin) * at_rest())) {
    each_node(crew, [&](std::size_t i) {
      for (auto& axis : D) axis[i] = 0;
    });
    keep_out_of(crew, task.planes);
    phi = look(crew, task, report);
    report.scale = std::max(outside, report.residual);
    enough = task.tolerance * report.scale;
    seek(report.iterations + most_iterations, report.cycles + task.most_cycles);
  }
  report.converged = report.residual <= enough;
  return report;
}

template class Newton<float>;
template class Newton<double>;

}  // namespace palpate::physics
