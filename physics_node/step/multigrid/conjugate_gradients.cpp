#include "physics_node/step/multigrid/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr int most_restarts = 2;

template <class Real>
double plane_dot(const Three<Real>& p, const Three<Real>& q, const GridPlane& plane) {
  double parts[16] = {};  // the same sum in vectors of any width
  for (std::size_t a = 0; a < 3; ++a) {
    const Real *x = p[a].data(), *y = q[a].data();
    Index i = plane.first;
    for (; i + 16 <= plane.last; i += 16)
      for (int n = 0; n < 16; ++n) parts[n] += static_cast<double>(x[i + n]) * static_cast<double>(y[i + n]);
    for (int n = 0; i < plane.last; ++i, ++n)
      parts[n] += static_cast<double>(x[i]) * static_cast<double>(y[i]);
  }
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

/// y += s x
template <class Real>
void add(Real s, const Three<Real>& x, Three<Real>& y, const GridPlane& plane) {
  for (std::size_t a = 0; a < 3; ++a) {
    const Real* from = x[a].data();
    Real* to = y[a].data();
    for (Index i = plane.first; i < plane.last; ++i) to[i] += s * from[i];
  }
}

template <class Real>
void copy(const Three<Real>& from, Three<Real>& to, const GridPlane& plane) {
  for (std::size_t a = 0; a < 3; ++a)
    std::copy(from[a].data() + plane.first, from[a].data() + plane.last, to[a].data() + plane.first);
}

}  // namespace

template <class Real>
ConjugateGradients<Real>::ConjugateGradients(const Hierarchy<Real>& hierarchy)
    : by_plane_(hierarchy.fine().planes().size()) {
  std::size_t colour = 24;  // after those of a level
  for (auto* three : {&b, &x, &r_, &p_, &q_})
    for (auto& axis : *three)
      axis = ZeroedArray<Real>(static_cast<std::size_t>(hierarchy.fine().n_nodes()), colour++);
}

template <class Real>
double ConjugateGradients<Real>::total() const noexcept {
  double sum = 0;
  for (const double one : by_plane_) sum += one;
  return sum;
}

template <class Real>
double ConjugateGradients<Real>::dot(const Hierarchy<Real>& hierarchy, const Crew& crew, const Three<Real>& p,
                                     const Three<Real>& q) noexcept {
  const Level<Real>& fine = hierarchy.fine();
  fine.each_plane(crew, [&](Index n) {
    const auto plane = static_cast<std::size_t>(n);
    by_plane_[plane] = plane_dot(p, q, fine.planes()[plane]);
  });
  return total();
}

template <class Real>
double ConjugateGradients<Real>::precondition(Hierarchy<Real>& hierarchy, const Crew& crew) noexcept {
  Level<Real>& fine = hierarchy.fine();
  fine.each_plane(crew, [&](Index n) { copy(r_, fine.r, fine.planes()[static_cast<std::size_t>(n)]); });
  hierarchy.v_cycle(crew);
  return dot(hierarchy, crew, r_, fine.x);
}

template <class Real>
GradientReport ConjugateGradients<Real>::solve(Hierarchy<Real>& hierarchy, const Crew& crew, double tolerance,
                                               int most_cycles) noexcept {
  Level<Real>& fine = hierarchy.fine();
  const LevelContext<Real> m = fine.context();
  const auto each = [&](const auto& work) {
    fine.each_plane(crew, [&](Index n) { work(fine.planes()[static_cast<std::size_t>(n)], n); });
  };
  each([&](const GridPlane& plane, Index) {
    copy(b, r_, plane);
    for (auto& axis : x) std::fill(axis.data() + plane.first, axis.data() + plane.last, Real(0));
  });
  GradientReport report;
  report.residual = std::sqrt(dot(hierarchy, crew, b, b));
  const double enough = tolerance * report.residual;
  if (!(report.residual > 0)) return report.converged = report.residual == 0, report;
  double before = 0;  // r . z of the last direction; 0: none
  const NodeVector<Real> p = pointers(p_), q = pointers(q_);
  for (int restarts = 0; report.cycles < most_cycles; ++report.cycles) {
    const double rz = precondition(hierarchy, crew);
    double pq = 0;
    if (rz > 0) {
      const bool first = before == 0;
      const Real more = first ? Real(0) : static_cast<Real>(rz / before);
      each([&](const GridPlane& plane, Index) {
        for (std::size_t a = 0; a < 3; ++a)
          for (Index i = plane.first; i < plane.last; ++i)
            p[a][i] = first ? m.x[a][i] : m.x[a][i] + more * p[a][i];
      });
      fine.sweep(
          crew, [&](Index l) { fine.kernel().product(m, p, l); },
          [&](Index n) { by_plane_[static_cast<std::size_t>(n)] = fine.kernel().keep(m, p, q, n); });
      pq = total();
      hierarchy.take_held(crew, q_);
    }
    if (!(rz > 0 && pq > 0)) {
      if (restarts++ == most_restarts) break;
      hierarchy.double_bound();
      before = 0;
      continue;
    }
    const auto step = static_cast<Real>(rz / pq);
    each([&](const GridPlane& plane, Index n) {
      add(step, p_, x, plane);
      add(-step, q_, r_, plane);
      by_plane_[static_cast<std::size_t>(n)] = plane_dot(r_, r_, plane);
    });
    report.residual = std::sqrt(total());
    before = rz;
    if (report.residual <= enough) {
      ++report.cycles;
      report.converged = true;
      break;
    }
  }
  hierarchy.take_held(crew, x);  // of the last digits, too
  return report;
}

template class ConjugateGradients<float>;
template class ConjugateGradients<double>;

}  // namespace palpate::physics
