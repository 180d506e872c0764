#pragma once
// The cells of a voxel body as runs that a kernel sweeps, and what they weigh.

#include <vector>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Cells in a row along x whose lowest corners are consecutive storage cells: every second cell of the row, since masses of
/// even and of odd x are stored apart. Gaps shorter than a vector are stepped over, by cells of no stiffness.
struct HexRun {
  Index first = 0;  // storage cell of the lowest corner of its first cell
  Index count = 0;
  Index right = 0;  // from the storage cell of a corner to that of the next along x
};

/// Runs, or rows of masses, that one thread takes: cells between two planes of masses, or masses of one plane.
struct HexPiece {
  Index begin = 0, end = 0;
};

struct HexGrid {
  std::vector<HexRun> runs;  // in the order of the storage cells
  std::vector<Index>
      runs_of_row;  // those whose lowest corners lie in row r of the lattice: [r] up to [r + 1]  (n_rows + 1)
  std::vector<HexPiece> layers;  // of runs
  std::vector<HexPiece> planes;  // of rows of the lattice
  Index up_y = 0, up_z = 0;      // from the storage cell of a corner to that of the next along y, along z
};

HexGrid make_hex_grid(const Body& body);

}  // namespace palpate::physics
