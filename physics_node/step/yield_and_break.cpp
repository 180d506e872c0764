#include <cmath>

#include "physics_node/step/element_step.h"

namespace palpate::physics {
namespace {

/// Current length of the element from cell i in direction d.
template <class Real>
Real length(const Body& body, const LatticeState<Real>& s, Index i, Index o, std::size_t d) {
  const Vec3& D = body.lattice.rest_vector[d];
  Real l2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const Real e = static_cast<Real>(D[static_cast<Eigen::Index>(a)]) +
                   (s.u[a][static_cast<std::size_t>(i + o)] - s.u[a][static_cast<std::size_t>(i)]);
    l2 += e * e;
  }
  return std::sqrt(l2);
}

/// Both ends judge a break by the same numbers, each clears its own bit; only the owner updates the memory.
template <class Real>
std::int64_t commit_mass(const Body& body, LatticeState<Real>& s, Index i, const Index* offset) {
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  const auto c = static_cast<std::size_t>(i);
  std::int64_t broken = 0;
  for (std::size_t d = 0; d < 2 * n_half; ++d) {
    if (((s.mask[c] >> d) & 1) == 0) continue;
    const std::size_t h = d % n_half;
    const Real L = static_cast<Real>(body.lattice.rest_length[d]);
    const Real l = length(body, s, i, offset[d], d);
    if (l > static_cast<Real>(body.law.b_p) * L) {
      s.mask[c] = static_cast<Mask>(s.mask[c] & ~(1U << d));
      s.flags[c] |= mass_broken;
      broken += d < n_half ? 1 : 0;
      continue;
    }
    const Real first_yield = static_cast<Real>(body.law.y_p) * L;
    if (l > first_yield) s.flags[c] |= mass_yielded;
    if (d >= n_half) continue;
    const Real l_y = s.y_p[h][c] * L;
    if (!(l > l_y)) continue;
    const Real k1 = static_cast<Real>(body.law.k1[h]);
    const Real k2 = k1 * static_cast<Real>(body.law.k2_ratio);
    const Real f_s = k1 * (l_y - L - s.l_c[h][c]) + k2 * (l - l_y);
    s.l_c[h][c] = l - L - f_s / k1;
    s.y_p[h][c] = l / L;
  }
  return broken;
}

}  // namespace

template <class Real>
std::int64_t yield_and_break(const Body& body, LatticeState<Real>& state, int threads) noexcept {
  const auto& rows = body.lattice.rows;
  const auto n = static_cast<Index>(rows.size());
  std::int64_t broken = 0;
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1) reduction(+ : broken)
  for (Index r = 0; r < n; ++r) {
    const RowSegment segment = rows[static_cast<std::size_t>(r)];
    const Index* offset = body.lattice.offset[static_cast<std::size_t>(segment.parity)].data();
    for (Index i = segment.first; i < segment.first + segment.count; ++i)
      broken += commit_mass(body, state, i, offset);
  }
  return broken;
}

template std::int64_t yield_and_break(const Body&, LatticeState<float>&, int) noexcept;
template std::int64_t yield_and_break(const Body&, LatticeState<double>&, int) noexcept;

}  // namespace palpate::physics
