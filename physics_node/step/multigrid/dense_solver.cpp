#include "physics_node/step/multigrid/dense_solver.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/fem/hex_tangent.h"

namespace palpate::physics {

DenseSolver::DenseSolver(std::vector<Index> free, const GridLevel& level)
    : n_(3 * free.size()),
      free_(std::move(free)),
      unknown_(static_cast<std::size_t>(level.n_nodes), -1),
      end_(n_, 0),
      factor_(n_ * n_),
      y_(n_) {
  for (std::size_t n = 0; n < free_.size(); ++n)
    unknown_[static_cast<std::size_t>(free_[n])] = static_cast<Index>(3 * n);
  for (const GridCell& cell : level.cells) {
    Index last = -1;
    for (const Index node : cell.corner) last = std::max(last, unknown_[static_cast<std::size_t>(node)]);
    for (const Index node : cell.corner) {
      const Index first = unknown_[static_cast<std::size_t>(node)];
      for (Index n = first; first >= 0 && n < first + 3; ++n) {
        std::size_t& end = end_[static_cast<std::size_t>(n)];
        end = std::max(end, static_cast<std::size_t>(last) + 3);
      }
    }
  }
  for (std::size_t n = 1; n < n_; ++n) end_[n] = std::max(end_[n], end_[n - 1]);
}

void DenseSolver::add(const Index* corners, std::size_t row, std::size_t column, double entry) noexcept {
  const Index r = unknown_[static_cast<std::size_t>(corners[row / 3])],
              c = unknown_[static_cast<std::size_t>(corners[column / 3])];
  if (c >= 0 && r >= c)  // of the upper triangle nothing but what lies in a block on the diagonal
    at(static_cast<std::size_t>(r) + row % 3, static_cast<std::size_t>(c) + column % 3) += entry;
}

template <class Real, bool physical>
void DenseSolver::add_cells(const LevelContext<Real>& m) noexcept {
  using One = Scalar<Real>;
  constexpr auto size = static_cast<std::size_t>(batch_size);
  for (Index layer = 0; layer < m.n_layers; ++layer) {
    const CellLayer* l = m.layers + layer;
    for (Index b = l->first_batch; b < l->last_batch; ++b)
      for (std::size_t lane = 0; lane < size; ++lane) {
        const Real* numbers = m.tangent + static_cast<std::ptrdiff_t>(b) * tangent_numbers * batch_size;
        const double stiffness = static_cast<double>(m.scale * numbers[10 * size + lane]);
        if (stiffness == 0) continue;
        HexTangent<Real> t;
        for (std::size_t n = 0; n < 9; ++n) t.f[n / 3][n % 3] = numbers[n * size + lane];
        t.q = numbers[9 * size + lane];
        t.every = numbers[11 * size + lane];
        Index corners[8];
        const CellBatch& batch = m.batches[b];
        for (std::size_t a = 0; a < 8; ++a)
          corners[a] = batch.gathered < 0
                           ? batch.at[a / 2] + static_cast<Index>(lane + (a & 1))
                           : m.corners[static_cast<std::size_t>(batch.gathered) + size * a + lane];
        for (std::size_t c = 0; c < 24; ++c) {
          Corners<One> unit{}, f;
          unit[c % 3][c / 3] = 1;
          hex_tangent_times<One, physical>(m.k, t, unit, f);
          for (std::size_t r = 0; r < 24; ++r)
            add(corners, r, c, stiffness * static_cast<double>(f[r % 3][r / 3]));
        }
      }
    for (Index n = l->first_dense; n < l->last_dense; ++n)
      for (std::size_t c = 0; c < 24; ++c)
        for (std::size_t r = 0; r < 24; ++r)
          add(m.dense_corners + 8 * static_cast<std::ptrdiff_t>(n), r, c,
              static_cast<double>(m.scale * m.dense[576 * static_cast<std::size_t>(n) + 24 * c + r]));
  }
}

template <class Real>
void DenseSolver::factor(const LevelContext<Real>& m, bool physical, const Supports& supports,
                         std::span<const Plane> planes) noexcept {
  std::ranges::fill(factor_, 0.0);
  physical ? add_cells<Real, true>(m) : add_cells<Real, false>(m);
  for (std::size_t n = 0; n < n_; ++n) at(n, n) += static_cast<double>(m.mass[free_[n / 3]]);
  if (!planes.empty()) hold(supports, planes);
  decompose();
}

void DenseSolver::hold(const Supports& supports, std::span<const Plane> planes) noexcept {
  constexpr double stiffer = 1e3;
  for (std::size_t f = 0; f < free_.size(); ++f) {
    const HeldDirections held = directions_of(supports.of(static_cast<std::size_t>(free_[f])), planes);
    const std::size_t n = 3 * f;
    const double spring = stiffer * (at(n, n) + at(n + 1, n + 1) + at(n + 2, n + 2));
    for (int k = 0; k < held.count; ++k) {
      const Vec3& d = held.n[static_cast<std::size_t>(k)];
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t r = c; r < 3; ++r)
          at(n + r, n + c) += spring * d[static_cast<Eigen::Index>(r)] * d[static_cast<Eigen::Index>(c)];
    }
  }
}

void DenseSolver::decompose() noexcept {
  double most = 0;
  for (std::size_t n = 0; n < n_; ++n) most = std::max(most, at(n, n) *= 1 + 1e-6);
  // The columns of a node, which end alike; a later one takes all three at once, and is read and written a
  // third as often.
  for (std::size_t first = 0; first < n_; first += 3) {
    const std::size_t end = end_[first + 2];
    for (std::size_t c = first; c < first + 3; ++c) {
      double* column = &at(0, c);
      // An unknown without stiffness stays where it is.
      const double pivot = std::sqrt(std::max(column[c], 1e-14 * most));
      for (std::size_t r = c; r < end; ++r) column[r] /= pivot;
      for (std::size_t k = c + 1; k < first + 3; ++k) {
        double* other = &at(0, k);
        const double factor = column[k];
        for (std::size_t r = k; r < end; ++r) other[r] -= factor * column[r];
      }
    }
    const double *a = &at(0, first), *b = &at(0, first + 1), *c = &at(0, first + 2);
    for (std::size_t k = first + 3; k < end; ++k) {
      double* __restrict other = &at(0, k);
      const double of_a = a[k], of_b = b[k], of_c = c[k];
      for (std::size_t r = k; r < end; ++r) other[r] = ((other[r] - of_a * a[r]) - of_b * b[r]) - of_c * c[r];
    }
  }
}

template <class Real>
void DenseSolver::solve(const LevelContext<Real>& m) noexcept {
  for (std::size_t n = 0; n < n_; ++n) y_[n] = static_cast<double>(m.r[n % 3][free_[n / 3]]);
  for (std::size_t c = 0; c < n_; ++c) {
    const double* column = &at(0, c);
    y_[c] /= column[c];
    for (std::size_t r = c + 1; r < end_[c]; ++r) y_[r] -= column[r] * y_[c];
  }
  for (std::size_t c = n_; c-- > 0;) {
    const double* column = &at(0, c);
    double sum = y_[c];
    for (std::size_t r = c + 1; r < end_[c]; ++r) sum -= column[r] * y_[r];
    y_[c] = sum / column[c];
  }
  for (std::size_t n = 0; n < n_; ++n) m.x[n % 3][free_[n / 3]] = static_cast<Real>(y_[n]);
}

template void DenseSolver::factor(const LevelContext<float>&, bool, const Supports&,
                                  std::span<const Plane>) noexcept;
template void DenseSolver::factor(const LevelContext<double>&, bool, const Supports&,
                                  std::span<const Plane>) noexcept;
template void DenseSolver::solve(const LevelContext<float>&) noexcept;
template void DenseSolver::solve(const LevelContext<double>&) noexcept;

}  // namespace palpate::physics
