#include "physics_node/step/lattice/hex_crack.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/fem/hex_plastic.h"
#include "physics_node/step/fem/hex_tension.h"
#include "physics_node/step/lattice/hex_meter.h"

namespace palpate::physics {
namespace {

/// Of a line, on either side. Why: of cells a tenth of l in size no more than ten beside a crack soften; time goes with it.
constexpr int most_cells = 16;

/// Why not std::round: without SSE 4.1 it is a call.
int nearest(double x) { return static_cast<int>(x + std::copysign(0.5, x)); }

}  // namespace

template <class Real>
CrackShares<Real>::CrackShares(const Body& body) : body_(body) {
  const auto k = hex_constants_of<double>(body);
  const SolidElements& solid = *body.solid;
  for (std::size_t m = 0; m < solid.failures.size(); ++m) {
    const Failure& failure = solid.failures[m];
    const Yielding yielding = solid.yields.empty() ? Yielding{} : solid.yields[m];
    const double elastic = elastic_stretch(failure.ratio, yielding, k.mu, k.lambda);
    reach_.push_back(failure.ratio > 0 ? 0.5 * failure.energy / energy_at_limit(elastic, k.mu, k.lambda)
                                       : 0.0);
  }
}

template <class Real>
double CrackShares<Real>::share_of(Index cell, const Vec3& normal) const noexcept {
  const Failure& failure = body_.solid->failures[body_.solid->material_of[static_cast<std::size_t>(cell)]];
  return failure.energy * body_.lattice.step.prod() / normal.cwiseAbs().dot(body_.lattice.step);
}

template <class Real>
bool CrackShares<Real>::is_open(const LatticeState<Real>& state, Index cell) const noexcept {
  const auto c = static_cast<std::size_t>(cell);
  return body_.solid->stiffness[c] > 0 && state.failed.reached[c] > 0 && state.failed.damage[c] < 1;
}

template <class Real>
template <class Visit>
Index CrackShares<Real>::each_across(const LatticeState<Real>& state, Index cell,
                                     const Visit& visit) const noexcept {
  const auto c = static_cast<std::size_t>(cell);
  const Lattice& lattice = body_.lattice;
  const double reach = reach_[body_.solid->material_of[c]] / static_cast<double>(body_.solid->stiffness[c]);
  const Vec3 normal = vector_of(state.failed.normal, cell).cwiseQuotient(lattice.step);  // [cells/m]
  const double layer = 1 / normal.cwiseAbs().maxCoeff();  // across the axis that it is nearest to [m]
  const Vec3i here = lattice.grid_of(cell);
  Index gap = -1;
  for (const double way : {layer, -layer})
    for (int n = 1; n <= most_cells && (n - 0.5) * layer <= reach; ++n) {
      Vec3i to = here;
      for (int a = 0; a < 3; ++a) to[a] += nearest(n * way * normal[a]);
      const Index other = lattice.mass_at(to);
      if (other < 0) break;
      if (!is_open(state, other)) {
        if (gap < 0 && state.failed.damage[static_cast<std::size_t>(other)] >= 1) gap = other;
        break;
      }
      visit(other);
    }
  return gap;
}

template <class Real>
template <class Visit>
void CrackShares<Real>::each_around(const LatticeState<Real>& state, Index cell,
                                    const Visit& visit) const noexcept {
  const Vec3i at = body_.lattice.grid_of(cell);
  for (int n = 0; n < 27; ++n) {
    const Index other = body_.lattice.mass_at(at + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
    if (other >= 0 && is_open(state, other)) visit(other);
  }
}

template <class Real>
double CrackShares<Real>::left_to(const LatticeState<Real>& state, Index cell) const noexcept {
  const auto damage = [&state](Index of) { return state.failed.damage[static_cast<std::size_t>(of)]; };
  auto left = static_cast<double>(state.failed.left[static_cast<std::size_t>(cell)]);
  each_across(state, cell, [&](Index other) {
    const bool leads = damage(cell) > damage(other) || (damage(cell) == damage(other) && cell < other);
    if (leads) left -= static_cast<double>(state.failed.taken[static_cast<std::size_t>(other)]);
  });
  return left;
}

/// The one that leads where this one goes on; -1: none has lost more.
template <class Real>
Index CrackShares<Real>::leader_of(const LatticeState<Real>& state, Index cell) const noexcept {
  Index leader = -1;
  Real most = state.failed.damage[static_cast<std::size_t>(cell)];
  const auto consider = [&](Index other) {
    const Real damage = state.failed.damage[static_cast<std::size_t>(other)];
    if (damage > most) most = damage, leader = other;
  };
  const Index gap = each_across(state, cell, consider);
  if (leader < 0 && gap >= 0) each_around(state, gap, consider);
  return leader;
}

template <class Real>
void CrackShares<Real>::take(LatticeState<Real>& state, Index cell, double taken) const noexcept {
  // Why: what has no share left goes when it is next pulled on; 0 would be a cell that goes at once.
  const auto less = [&state](Index of, double by) {
    Real& left = state.failed.left[static_cast<std::size_t>(of)];
    left = static_cast<Real>(std::max(static_cast<double>(left) - by, 1e-9 * static_cast<double>(left)));
  };
  less(cell, taken);
  Real& own = state.failed.taken[static_cast<std::size_t>(cell)];
  own += static_cast<Real>(taken);
  const Index leader = leader_of(state, cell);
  if (leader < 0) return;
  less(leader, static_cast<double>(own));
  own = 0;
}

template class CrackShares<float>;
template class CrackShares<double>;

}  // namespace palpate::physics
