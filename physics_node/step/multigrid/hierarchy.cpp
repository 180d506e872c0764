#include "physics_node/step/multigrid/hierarchy.h"

#include <Eigen/Eigenvalues>

namespace palpate::physics {
namespace {

HexMaterial material_of(const Body& body) {
  return {.modulus = body.solid->modulus,
          .poisson_ratio = body.solid->poisson_ratio,
          .hourglass = body.solid->hourglass};
}

/// Largest eigenvalue of B^-1 K of one cell, B its 3 x 3 blocks.
double largest_of_cell(const HexMatrix& k) {
  HexMatrix blocks = HexMatrix::Zero();
  for (Eigen::Index a = 0; a < 24; a += 3) blocks.block<3, 3>(a, a) = k.block<3, 3>(a, a);
  return Eigen::GeneralizedSelfAdjointEigenSolver<HexMatrix>(k, blocks, Eigen::EigenvaluesOnly)
      .eigenvalues()[23];
}

std::vector<double> coarser_mass(const ShareTable& up, const std::vector<double>& fine, Index n_nodes) {
  std::vector<double> mass(static_cast<std::size_t>(n_nodes), 0.0);
  for (Index n = 0; n < n_nodes; ++n)
    for (const NodeShare& from : up.of(n))
      mass[static_cast<std::size_t>(n)] +=
          static_cast<double>(from.share) * fine[static_cast<std::size_t>(from.node)];
  return mass;
}

std::vector<Index> free_nodes(const GridLevel& level) {
  std::vector<Index> free;
  for (Index n = 0; n < level.n_nodes; ++n)
    if (level.held[static_cast<std::size_t>(n)] == 0) free.push_back(n);
  return free;
}

/// Sums of shares, for all components of the nodes of a plane.
template <class Real>
void share_out(const ShareTable& table, const Three<Real>& from, Three<Real>& to, const GridPlane& plane) {
  for (Index i = plane.first; i < plane.last; ++i) {
    std::array<Real, 3> sum{};
    for (const NodeShare& share : table.of(i))
      for (std::size_t a = 0; a < 3; ++a)
        sum[a] += static_cast<Real>(share.share) * from[a][static_cast<std::size_t>(share.node)];
    for (std::size_t a = 0; a < 3; ++a) to[a][static_cast<std::size_t>(i)] = sum[a];
  }
}

}  // namespace

template <class Real>
Hierarchy<Real>::Hierarchy(const Body& body)
    : physical_(body.solid->hourglass == HourglassKind::physical),
      // Why: the same work with fewer visits to the coarser levels, where the smoother is what limits.
      degree_(body.solid->poisson_ratio > 0.485 ? 6 : 3) {
  const HexMaterial material = material_of(body);
  largest_ = 1.15 * largest_of_cell(hex_stiffness(material, body.lattice.step));
  BodyGrid grid = body_grid(body);
  storage_ = std::move(grid.storage);
  std::vector<double> mass(storage_.size(), 0.0);
  for (std::size_t n = 0; n < mass.size(); ++n)
    if (storage_[n] >= 0) mass[n] = node_mass(body, storage_[n]);
  GridLevel level = std::move(grid.level);
  std::vector<DenseCell> dense;
  for (;;) {
    const std::vector<Index> free = free_nodes(level);
    const bool small = 3 * static_cast<Index>(free.size()) <= most_dense_unknowns;
    CoarserLevel next = small ? CoarserLevel{} : coarsen(level);
    levels_.emplace_back(level, dense, mass, material);
    supports_.emplace_back(level.n_nodes);
    if (small) {
      coarsest_ = DenseSolver(free, level);
      break;
    }
    // Loose cells do not become fewer.
    if (10 * next.level.cells.size() > 9 * level.cells.size()) break;
    dense = dense_cells(level, dense, hex_stiffness(material, level.edge), next.level);
    mass = coarser_mass(next.up, mass, next.level.n_nodes);
    transfers_.push_back({std::move(next.down), std::move(next.up), std::move(next.inject)});
    level = std::move(next.level);
  }
  set_step(0);
}

template <class Real>
void Hierarchy<Real>::set_step(double dt) noexcept {
  for (Level<Real>& level : levels_) level.set_step(dt);
}

template <class Real>
void Hierarchy<Real>::linearise(const Crew& crew, double scale) noexcept {
  for (std::size_t n = 0; n < levels_.size(); ++n) {
    Level<Real>& level = levels_[n];
    if (n > 0)
      level.each_plane(crew, [&](Index p) {
        share_out(transfers_[n - 1].inject, levels_[n - 1].u, level.u,
                  level.planes()[static_cast<std::size_t>(p)]);
      });
    level.linearise(crew, scale);
    if (planes_.empty()) continue;
    level.each_plane(crew, [&](Index p) {
      const GridPlane& plane = level.planes()[static_cast<std::size_t>(p)];
      if (n > 0) supports_[n].carry_up(supports_[n - 1], transfers_[n - 1].up, plane);
      supports_[n].hold_blocks(level.context(), plane, planes_);
    });
  }
  if (coarsest_.any()) coarsest_.factor(levels_.back().context(), physical_, supports_.back(), planes_);
}

template <class Real>
void Hierarchy<Real>::take_held(std::size_t n, const Crew& crew, Three<Real>& three) const noexcept {
  if (planes_.empty()) return;
  const Level<Real>& level = levels_[n];
  level.each_plane(crew, [&](Index p) {
    supports_[n].take_from(three, level.planes()[static_cast<std::size_t>(p)], planes_);
  });
}

template <class Real>
void Hierarchy<Real>::smooth(std::size_t n, const Crew& crew, int from) noexcept {
  Level<Real>& level = levels_[n];
  const LevelContext<Real> m = level.context();
  const LevelKernel<Real>& kernel = level.kernel();
  for (int k = from; k <= degree_; ++k) {
    const auto c1 = static_cast<Real>(k == 1 ? 0.0 : (2.0 * k - 3) / (2 * k + 1));
    const auto c2 = static_cast<Real>((8.0 * k - 4) / ((2 * k + 1) * largest_));
    level.sweep(
        crew, [&](Index l) { kernel.product(m, m.d, l); }, [&](Index p) { kernel.smooth(m, p, c1, c2); });
  }
}

template <class Real>
void Hierarchy<Real>::cycle(std::size_t n, const Crew& crew) noexcept {
  Level<Real>& level = levels_[n];
  const LevelContext<Real> m = level.context();
  const LevelKernel<Real>& kernel = level.kernel();
  level.each_plane(crew, [&](Index p) { kernel.begin(m, p, static_cast<Real>(4 / (3 * largest_))); });
  smooth(n, crew, 2);
  if (n + 1 == levels_.size()) return;
  level.sweep(
      crew, [&](Index l) { kernel.product(m, m.d, l); }, [&](Index p) { kernel.residual(m, p); });
  take_held(n, crew, level.r);
  Level<Real>& coarse = levels_[n + 1];
  coarse.each_plane(crew, [&](Index p) {
    share_out(transfers_[n].up, level.r, coarse.r, coarse.planes()[static_cast<std::size_t>(p)]);
  });
  if (n + 2 == levels_.size())
    solve_coarsest(crew);
  else
    cycle(n + 1, crew);
  level.each_plane(crew, [&](Index p) {
    const GridPlane& plane = level.planes()[static_cast<std::size_t>(p)];
    share_out(transfers_[n].down, coarse.x, level.d, plane);
    if (!planes_.empty()) supports_[n].take_from(level.d, plane, planes_);
    for (std::size_t a = 0; a < 3; ++a)
      for (Index i = plane.first; i < plane.last; ++i) m.x[a][i] += m.d[a][i];
  });
  smooth(n, crew, 1);
}

template <class Real>
void Hierarchy<Real>::solve_coarsest(const Crew& crew) noexcept {
  Level<Real>& last = levels_.back();
  if (coarsest_.any()) {
    take_held(levels_.size() - 1, crew, last.r);
    coarsest_.solve(last.context());
    take_held(levels_.size() - 1, crew, last.x);
  } else
    cycle(levels_.size() - 1, crew);
}

template <class Real>
void Hierarchy<Real>::v_cycle(const Crew& crew) noexcept {
  if (levels_.size() == 1)
    solve_coarsest(crew);
  else
    cycle(0, crew);
}

template class Hierarchy<float>;
template class Hierarchy<double>;

}  // namespace palpate::physics
