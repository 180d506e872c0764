#pragma once
// The cells of a level in batches of sixteen, as a kernel takes them.

#include <array>
#include <vector>

#include "physics_node/step/multigrid/dense_cells.h"

namespace palpate::physics {

/// Why sixteen: the lanes of the widest vector. Narrower ones take a batch in parts, so that sums have one order on all.
inline constexpr Index batch_size = 16;

/// Cells of one layer. Where `gathered` is -1 they are a run along x: the corners at -x of cell n, by y and z, are at[] + n, those at
/// +x follow. Else all corners are listed, from 8 x 16 `gathered` on: corner, then cell. Cells that are not there have no
/// stiffness.
struct CellBatch {
  std::array<Index, 4> at{};
  Index gathered = -1;
};

/// What lies between planes k and k + 1; the last has none.
struct CellLayer {
  Index first_batch = 0, last_batch = 0;  // [first, last)
  Index first_dense = 0, last_dense = 0;
};

struct CellBatches {
  std::vector<CellBatch> batches;
  std::vector<Index> corners;      // of gathered ones
  std::vector<double> stiffness;   // of each cell, 0: none                       (batches x 16)
  std::vector<CellLayer> layers;   // as many as planes
  std::vector<std::size_t> slabs;  // layers that one thread sweeps: [n] up to [n + 1]
};

/// Runs are cut into batches; what is left over of them, fewer than six cells, is gathered from the whole layer. Why six:
/// a cell that is gathered costs as much as a sixth of a batch.
/// @param dense  are left out, in the order of cells
CellBatches batches_of(const GridLevel& level, const std::vector<DenseCell>& dense);

}  // namespace palpate::physics
