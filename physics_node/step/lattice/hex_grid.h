#pragma once
// The cells of a voxel body as runs that a kernel sweeps, and what they weigh.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/lattice/cell_steps.h"

namespace palpate::physics {

/// Cells in a row along x whose lowest corners are consecutive storage cells: every second cell of the row, since masses of
/// even and of odd x are stored apart. Gaps shorter than a vector are stepped over, by cells of no stiffness. Where a body is awake in
/// parts, runs are segments as rows are (lattice.h), and may begin with such cells.
struct HexRun {
  Index first = 0;  // storage cell of the lowest corner of its first cell
  Index count = 0;
  Index right = 0;  // from the storage cell of a corner to that of the next along x
};

/// One plane of masses and the cells between it and the next: what is needed of either, or nothing.
struct HexLayer {
  Index first_run = 0, last_run = 0;  // [first, last)
  Index first_row = 0, last_row = 0;
};

/// Layers that one thread sweeps: it gathers the forces of a layer, and then at once moves the masses below it, which no other
/// layer asks for any more, while all of them are at hand. Only its lowest masses wait for the cells below them, of another
/// thread.
struct HexSlab {
  std::size_t begin = 0, end = 0;
};

inline constexpr std::size_t most_slabs =
    16;  // Why: shares of two threads then differ by a tenth at most, and few masses wait

struct HexGrid {
  std::vector<HexRun> runs;  // in the order of the storage cells
  std::vector<Index>
      runs_of_row;  // those whose lowest corners lie in row r of the lattice: [r] up to [r + 1]  (n_rows + 1)
  std::vector<HexLayer> layers;  // upwards
  std::vector<HexSlab> slabs;
  std::vector<Index> rows,
      rows_begin;            // in which the corners of run r lie: rows[rows_begin[r]] and on  (n_runs + 1)
  Index up_y = 0, up_z = 0;  // from the storage cell of a corner to that of the next along y, along z

  /// Storage cell of a corner of a cell of a run: bit 0 of `a` is +x, bit 1 +y, bit 2 +z.
  Index corner(const HexRun& run, Index cell, Index a) const noexcept {
    return cell + (a & 1) * run.right + (a >> 1 & 1) * up_y + (a >> 2) * up_z;
  }
  /// The run that a cell is of, by its lowest corner.
  std::size_t run_of(Index cell) const noexcept {
    return static_cast<std::size_t>(std::ranges::upper_bound(runs, cell, {}, &HexRun::first) - runs.begin()) -
           1;
  }
  std::span<const Index> rows_of(std::size_t run) const noexcept {
    return std::span(rows).subspan(static_cast<std::size_t>(rows_begin[run]),
                                   static_cast<std::size_t>(rows_begin[run + 1] - rows_begin[run]));
  }
};

HexGrid make_hex_grid(const Body& body);

/// Nodes at the corners of a cell of a run: copies where a cut has parted it.
inline std::array<Index, 8> corners_now(const Body& body, const HexGrid& grid, const HexRun& run,
                                        Index cell) noexcept {
  if (const CellNet* net = body.cell_net(); net != nullptr && net->is_parted(cell)) return net->corners(cell);
  std::array<Index, 8> corners;
  for (Index a = 0; a < 8; ++a) corners[static_cast<std::size_t>(a)] = grid.corner(run, cell, a);
  return corners;
}

/// Storage cells of the corners of a cell, by its lowest: bit 0 of the number is +x, bit 1 +y, bit 2 +z.
inline std::array<Index, 8> corners_of_cell(const Lattice& lattice, Index cell) noexcept {
  return CellSteps(lattice).corners(cell);
}

/// Slabs of about as many cells each, of layers as they are. Contract: allocates nothing where there is room for most_slabs + 1.
void share_out(const HexGrid& grid, std::span<const HexLayer> layers, std::vector<HexSlab>& slabs);

}  // namespace palpate::physics
