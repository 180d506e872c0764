#include "physics_node/lattice/lattice.h"

#include <algorithm>
#include <bit>

#include "common/error/error.h"

namespace palpate::physics {
namespace {

constexpr Index lanes = row_segment;                   // storage cells of x = 0 are a multiple of this
constexpr std::size_t fewest_masses_per_chunk = 4096;  // below, a second thread does not pay
constexpr std::size_t most_chunks = 32;

/// Planes are added to a chunk until it is large enough; what is left over joins the last one.
void cut_into_chunks(Lattice& lattice) {
  const std::size_t enough = std::max(fewest_masses_per_chunk, lattice.masses.size() / most_chunks);
  const auto n_rows = static_cast<Index>(lattice.rows.size());
  const auto plane_of = [&](Index row) {
    return lattice.rows[static_cast<std::size_t>(row)].first / (lattice.pitch * lattice.size.y());
  };
  lattice.chunks.clear();
  Chunk chunk;
  std::size_t masses = 0;
  int planes = 0;
  for (Index row = 0; row < n_rows;) {
    Index next = row;
    for (; next < n_rows && plane_of(next) == plane_of(row); ++next)
      masses += static_cast<std::size_t>(lattice.rows[static_cast<std::size_t>(next)].count);
    chunk.top_row = row;
    chunk.last_row = row = next;
    if (++planes < 2 || masses < enough) continue;
    lattice.chunks.push_back(chunk);
    chunk.first_row = row;
    masses = 0;
    planes = 0;
  }
  if (chunk.first_row == n_rows) return;
  if (lattice.chunks.empty()) {
    lattice.chunks.push_back(chunk);
  } else {
    lattice.chunks.back().top_row = chunk.top_row;
    lattice.chunks.back().last_row = n_rows;
  }
}

}  // namespace

GridBox grid_box(const Lattice& lattice, const Vec3& low, const Vec3& high) {
  const Eigen::Array3d most = lattice.size.array().cast<double>() - 3;  // without halo, and the last corners
  const auto grid = [&](const Vec3& at) -> Eigen::Array3d {
    return (at - lattice.origin).cwiseQuotient(lattice.step).array();
  };
  return {grid(low).floor().max(0).min(most).cast<int>(), grid(high).ceil().max(0).min(most).cast<int>()};
}

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

int Lattice::row_kind(Index cell) const {
  const Index row = cell / pitch;
  const int parity = (row % size.y() + row / size.y()) & 1;
  if (kind == LatticeKind::fcc) return parity;
  return 2 * static_cast<int>(cell % pitch >= pitch / 2) + parity;
}

Index Lattice::row_of(Index cell) const {
  const auto after = std::upper_bound(rows.begin(), rows.end(), cell,
                                      [](Index c, const RowSegment& row) { return c < row.first; });
  return static_cast<Index>(after - rows.begin()) - 1;
}

bool Lattice::leads_up(int d) const {
  const auto n = static_cast<std::size_t>(d % n_half);
  return d < n_half && half_directions(kind)[n].z() > 0;
}

Index Lattice::cell_of(const Vec3i& grid) const {
  // The halo is one storage row below, and `lanes` storage cells before, the first grid coordinate. Both shifts
  // together keep the parity of a row: y and z are shifted by one each.
  const int y = grid.y() + 1;
  const int z = grid.z() + 1;
  const Index row = (z * size.y() + y) * pitch;
  if (kind == LatticeKind::fcc) return row + lanes + (grid.x() - ((y + z) & 1)) / 2;
  return row + (grid.x() & 1) * (pitch / 2) + lanes + (grid.x() >> 1);
}

Vec3i Lattice::grid_of(Index cell) const {
  const Index row = cell / pitch;
  const int y = static_cast<int>(row % size.y());
  const int z = static_cast<int>(row / size.y());
  if (kind == LatticeKind::fcc)
    return {2 * static_cast<int>(cell % pitch - lanes) + ((y + z) & 1), y - 1, z - 1};
  const Index half = pitch / 2;
  const Index along = cell % pitch;
  return {2 * static_cast<int>(along % half - lanes) + static_cast<int>(along / half), y - 1, z - 1};
}

double Lattice::total_share() const {
  double sum = 0;
  for (const Index cell : masses) sum += static_cast<double>(mass_share[static_cast<std::size_t>(cell)]);
  return sum;
}

Index Lattice::mass_at(const Vec3i& grid) const {
  const Index room = (kind == LatticeKind::fcc ? pitch : pitch / 2) - lanes;
  const bool inside =
      (grid.array() >= 0).all() && grid.x() / 2 < room && grid.y() < size.y() - 2 && grid.z() < size.z() - 2;
  if (!inside) return -1;
  const Index cell = cell_of(grid);
  return mass_share[static_cast<std::size_t>(cell)] > 0 ? cell : -1;
}

std::int64_t Lattice::n_elements() const {
  std::int64_t ends = 0;
  for (const Index cell : masses) ends += std::popcount(mask[static_cast<std::size_t>(cell)] & element_bits);
  return ends / 2;
}

Lattice make_lattice(LatticeKind kind, const Vec3i& extent, const Vec3& origin, const Vec3& step,
                     const Eigen::Matrix3d& axes) {
  PALPATE_CHECK((extent.array() > 0).all(), "a lattice has at least one node each way");
  PALPATE_CHECK(kind == LatticeKind::fcc || axes == Eigen::Matrix3d::Identity(), "voxels do not turn");
  Lattice lattice;
  lattice.kind = kind;
  lattice.origin = origin;
  lattice.step = step;
  lattice.axes = axes;
  const int along_x = extent.x() / 2 + 1;
  const int rows_per_y = kind == LatticeKind::fcc ? 1 : 2;
  lattice.pitch = (lanes + along_x + lanes) / lanes * lanes * rows_per_y;
  lattice.size = {lattice.pitch, extent.y() + 2, extent.z() + 2};

  const auto directions = half_directions(kind);
  lattice.n_half = static_cast<int>(directions.size());
  for (int d = 0; d < 2 * lattice.n_half; ++d) {
    const auto n = static_cast<std::size_t>(d);
    const Vec3i delta = d < lattice.n_half ? directions[n] : Vec3i(-directions[n - directions.size()]);
    lattice.rest_vector[n] = axes * step.cwiseProduct(delta.cast<double>());
    lattice.rest_length[n] = lattice.rest_vector[n].norm();
    for (int row = 0; row < 2 * rows_per_y; ++row) {
      // Any grid coordinate in a row of this kind will do.
      const int parity = row % 2;
      const Vec3i at =
          kind == LatticeKind::fcc ? Vec3i(2 + parity, 2 + parity, 2) : Vec3i(2 + row / 2, 2, 2 + parity);
      const Index offset = lattice.cell_of(at + delta) - lattice.cell_of(at);
      lattice.offset[static_cast<std::size_t>(row)][n] = offset;
      // Diagonals of voxels join masses of even X + Y + Z.
      const bool exists = kind == LatticeKind::fcc || delta.cwiseAbs().sum() == 1 || (at.sum() & 1) == 0;
      if (exists && offset > 0) lattice.forward[static_cast<std::size_t>(row)].push_back(d);
    }
  }
  const auto n_cells = static_cast<std::size_t>(lattice.n_cells());
  lattice.mask.assign(n_cells, 0);
  lattice.mass_share.assign(n_cells, 0.0F);
  return lattice;
}

void index_masses(Lattice& lattice, Rows rows) {
  lattice.masses.clear();
  lattice.rows.clear();
  const Index row_cells = lattice.kind == LatticeKind::fcc ? lattice.pitch : lattice.pitch / 2;
  for (Index cell = 0; cell < lattice.n_cells(); ++cell) {
    if (lattice.mass_share[static_cast<std::size_t>(cell)] <= 0) continue;
    lattice.masses.push_back(cell);
    // A short gap in a row is stepped over: its empty cells stay empty, and runs never share a vector of cells.
    const bool split = rows == Rows::in_segments;
    const bool extends = !lattice.rows.empty() && lattice.rows.back().first / row_cells == cell / row_cells &&
                         cell < lattice.rows.back().first + (split ? 0 : lattice.rows.back().count) + lanes;
    const Index first = split ? cell / lanes * lanes : cell;
    if (!extends) lattice.rows.push_back({first, 0, lattice.row_kind(cell)});
    lattice.rows.back().count = cell - lattice.rows.back().first + 1;
  }
  cut_into_chunks(lattice);
}

}  // namespace palpate::physics
