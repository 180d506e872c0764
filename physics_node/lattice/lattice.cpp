#include "physics_node/lattice/lattice.h"

#include <bit>

#include "common/error/error.h"

namespace palpate::physics {
namespace {

constexpr Index lanes = 16;  // rows start on a multiple of this, the widest vector in floats

}  // namespace

std::vector<Vec3i> half_directions(LatticeKind kind) {
  if (kind == LatticeKind::fcc) {
    return {{1, 1, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};
  }
  return {{1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0}, {-1, 1, 0},
          {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};
}

double elements_per_mass(LatticeKind kind, std::size_t half_direction) {
  return kind == LatticeKind::voxel && half_direction >= 3 ? 0.5 : 1.0;
}

int Lattice::row_parity(Index cell) const {
  if (kind == LatticeKind::voxel) return 0;
  const Index row = cell / pitch;
  return (row % size.y() + row / size.y()) & 1;
}

Index Lattice::cell_of(const Vec3i& grid) const {
  // The halo is one storage row below, and `lanes` storage cells before, the first grid coordinate. Both shifts
  // together keep the parity of a row: y and z are shifted by one each.
  const int y = grid.y() + 1;
  const int z = grid.z() + 1;
  const int i = kind == LatticeKind::fcc ? (grid.x() - ((y + z) & 1)) / 2 : grid.x();
  return (z * size.y() + y) * pitch + lanes + i;
}

Vec3i Lattice::grid_of(Index cell) const {
  const Index row = cell / pitch;
  const int i = static_cast<int>(cell % pitch - lanes);
  const int y = static_cast<int>(row % size.y());
  const int z = static_cast<int>(row / size.y());
  return {kind == LatticeKind::fcc ? 2 * i + ((y + z) & 1) : i, y - 1, z - 1};
}

double Lattice::total_share() const {
  double sum = 0;
  for (const Index cell : masses) sum += static_cast<double>(mass_share[static_cast<std::size_t>(cell)]);
  return sum;
}

Index Lattice::mass_at(const Vec3i& grid) const {
  const int along_x = kind == LatticeKind::fcc ? grid.x() / 2 : grid.x();
  const bool inside = (grid.array() >= 0).all() && along_x < pitch - lanes && grid.y() < size.y() - 2 &&
                      grid.z() < size.z() - 2;
  if (!inside) return -1;
  const Index cell = cell_of(grid);
  return mass_share[static_cast<std::size_t>(cell)] > 0 ? cell : -1;
}

std::int64_t Lattice::n_elements() const {
  std::int64_t ends = 0;
  for (const Index cell : masses) ends += std::popcount(mask[static_cast<std::size_t>(cell)]);
  return ends / 2;
}

Lattice make_lattice(LatticeKind kind, const Vec3i& extent, const Vec3& origin, const Vec3& step) {
  PALPATE_CHECK((extent.array() > 0).all(), "a lattice has at least one node each way");
  Lattice lattice;
  lattice.kind = kind;
  lattice.origin = origin;
  lattice.step = step;
  const int along_x = kind == LatticeKind::fcc ? extent.x() / 2 + 1 : extent.x();
  lattice.pitch = (lanes + along_x + lanes) / lanes * lanes;
  lattice.size = {lattice.pitch, extent.y() + 2, extent.z() + 2};

  const auto directions = half_directions(kind);
  lattice.n_half = static_cast<int>(directions.size());
  for (int d = 0; d < 2 * lattice.n_half; ++d) {
    const auto n = static_cast<std::size_t>(d);
    const Vec3i delta = d < lattice.n_half ? directions[n] : Vec3i(-directions[n - directions.size()]);
    lattice.rest_vector[n] = step.cwiseProduct(delta.cast<double>());
    lattice.rest_length[n] = lattice.rest_vector[n].norm();
    for (int parity = 0; parity < 2; ++parity) {
      // Any even (fcc) grid coordinate in a row of this parity will do.
      const Vec3i at = kind == LatticeKind::fcc ? Vec3i(2 + parity, 2 + parity, 2) : Vec3i(2, 2, 2);
      lattice.offset[static_cast<std::size_t>(parity)][n] = lattice.cell_of(at + delta) - lattice.cell_of(at);
    }
  }
  const auto n_cells = static_cast<std::size_t>(lattice.n_cells());
  lattice.mask.assign(n_cells, 0);
  lattice.mass_share.assign(n_cells, 0.0F);
  return lattice;
}

void index_masses(Lattice& lattice) {
  lattice.masses.clear();
  lattice.rows.clear();
  for (Index cell = 0; cell < lattice.n_cells(); ++cell) {
    if (lattice.mass_share[static_cast<std::size_t>(cell)] <= 0) continue;
    lattice.masses.push_back(cell);
    // A short gap in a row is stepped over: its empty cells stay empty, and runs never share a vector of cells.
    const bool extends = !lattice.rows.empty() &&
                         lattice.rows.back().first / lattice.pitch == cell / lattice.pitch &&
                         cell < lattice.rows.back().first + lattice.rows.back().count + lanes;
    if (extends) {
      lattice.rows.back().count = cell - lattice.rows.back().first + 1;
    } else {
      lattice.rows.push_back({cell, 1, lattice.row_parity(cell)});
    }
  }
}

}  // namespace palpate::physics
