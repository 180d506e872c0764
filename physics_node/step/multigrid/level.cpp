#include "physics_node/step/multigrid/level.h"

#include <algorithm>

namespace palpate::physics {

template <class Real>
Level<Real>::Level(const GridLevel& grid, const std::vector<DenseCell>& dense,
                   const std::vector<double>& mass, const HexMaterial& material)
    : n_nodes_(grid.n_nodes),
      planes_(grid.planes),
      cells_(batches_of(grid, dense)),
      dense_cells_(dense),
      k_(hex_constants<Real>(material, grid.edge)),
      kernel_(level_kernel_here<Real>(material.hourglass == HourglassKind::physical)) {
  const auto n = static_cast<std::size_t>(n_nodes_);
  std::size_t colour = 0;
  for (auto* three : {&u, &x, &r, &d, &low_, &high_})
    for (auto& axis : *three) axis = ZeroedArray<Real>(n, colour++);
  for (auto* six : {&inverse_, &block_high_})
    for (auto& entry : *six) entry = ZeroedArray<Real>(n, colour++);
  for (auto* one : {&mass_kg_, &mass_, &free_}) *one = ZeroedArray<Real>(n, colour++);
  for (std::size_t i = 0; i < n; ++i) {
    if (grid.held[i] != 0) continue;
    free_[i] = 1;
    mass_kg_[i] = static_cast<Real>(mass[i]);
  }
  constexpr auto size = static_cast<std::size_t>(batch_size);
  tangent_ = ZeroedArray<Real>(cells_.batches.size() * tangent_numbers * size);
  for (std::size_t b = 0; b < cells_.batches.size(); ++b)
    for (std::size_t lane = 0; lane < size; ++lane)
      tangent_[(tangent_numbers * b + 10) * size + lane] =
          static_cast<Real>(cells_.stiffness[size * b + lane]);
  dense_ = ZeroedArray<Real>(576 * dense.size());
  for (std::size_t m = 0; m < dense.size(); ++m) {
    for (std::size_t e = 0; e < 576; ++e)
      dense_[576 * m + e] = static_cast<Real>(dense[m].stiffness.data()[e]);
    const GridCell& cell = grid.cells[static_cast<std::size_t>(dense[m].cell)];
    dense_corners_.insert(dense_corners_.end(), cell.corner.begin(), cell.corner.end());
  }
}

template <class Real>
LevelContext<Real> Level<Real>::context() noexcept {
  LevelContext<Real> m = {};
  m.batches = cells_.batches.data();
  m.corners = cells_.corners.data();
  m.layers = cells_.layers.data();
  m.planes = planes_.data();
  m.n_layers = static_cast<Index>(planes_.size());
  m.tangent = tangent_.data();
  m.dense = dense_.data();
  m.dense_corners = dense_corners_.data();
  m.mass = mass_.data();
  m.free = free_.data();
  m.u = pointers(u), m.x = pointers(x), m.r = pointers(r), m.d = pointers(d);
  m.low = pointers(low_), m.high = pointers(high_);
  for (std::size_t e = 0; e < 6; ++e)
    m.inverse[e] = inverse_[e].data(), m.block_high[e] = block_high_[e].data();
  m.scale = static_cast<Real>(scale_);
  m.k = k_;
  return m;
}

template <class Real>
void Level<Real>::set_step(double dt) noexcept {
  const Real per = dt > 0 ? static_cast<Real>(1 / (dt * dt)) : Real(0);
  for (std::size_t i = 0; i < mass_.size(); ++i) mass_[i] = per * mass_kg_[i];
}

template <class Real>
void Level<Real>::linearise(const Crew& crew, double scale) noexcept {
  scale_ = scale;
  const LevelContext<Real> m = context();
  each_plane(crew, [&](Index p) {
    const GridPlane& plane = m.planes[p];
    for (Real* entry : m.inverse) std::fill(entry + plane.first, entry + plane.last, Real(0));
  });
  sweep(
      crew, [&](Index l) { kernel_.linearise(m, l); }, [&](Index p) { kernel_.invert_blocks(m, p); });
}

template class Level<float>;
template class Level<double>;

}  // namespace palpate::physics
