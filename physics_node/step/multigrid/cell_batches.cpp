#include "physics_node/step/multigrid/cell_batches.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr std::size_t worth_a_batch = 6;

// Why: shares of two threads then differ by a tenth at most, and few planes wait.
constexpr Index most_slabs = 16;
// Why: below this a second thread costs as much as it saves.
constexpr Index cells_worth_a_slab = 1000;

bool follows(const GridCell& before, const GridCell& cell) {
  for (std::size_t a = 0; a < 8; ++a)
    if (cell.corner[a] != before.corner[a] + 1) return false;
  return true;
}

bool is_straight(const GridCell& cell) {
  for (std::size_t a = 0; a < 8; a += 2)
    if (cell.corner[a + 1] != cell.corner[a] + 1) return false;
  return true;
}

class Builder {
 public:
  explicit Builder(CellBatches& out) : out_(out) {}

  void add_run(std::span<const GridCell* const> run) {
    while (!run.empty()) {
      const std::size_t n = std::min<std::size_t>(run.size(), batch_size);
      if (n < worth_a_batch || !is_straight(*run[0])) {
        rest_.insert(rest_.end(), run.begin(), run.begin() + static_cast<std::ptrdiff_t>(n));
      } else {
        CellBatch batch;
        for (std::size_t r = 0; r < 4; ++r) batch.at[r] = run[0]->corner[2 * r];
        out_.batches.push_back(batch);
        add_stiffness(run.first(n));
      }
      run = run.subspan(n);
    }
  }

  void finish_layer() {
    for (std::span<const GridCell* const> rest = rest_; !rest.empty();) {
      const std::size_t n = std::min<std::size_t>(rest.size(), batch_size);
      out_.batches.push_back({.gathered = static_cast<Index>(out_.corners.size())});
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch_size); ++lane)
          out_.corners.push_back(rest[std::min(lane, n - 1)]->corner[a]);
      add_stiffness(rest.first(n));
      rest = rest.subspan(n);
    }
    rest_.clear();
  }

 private:
  void add_stiffness(std::span<const GridCell* const> cells) {
    for (const GridCell* cell : cells) out_.stiffness.push_back(cell->stiffness);
    out_.stiffness.resize(out_.batches.size() * static_cast<std::size_t>(batch_size), 0.0);
  }

  CellBatches& out_;
  std::vector<const GridCell*> rest_;
};

void cut_slabs(const std::vector<Index>& cells_of_layer, CellBatches& out) {
  Index cells = 0, swept = 0;
  for (const Index n : cells_of_layer) cells += n;
  const Index n_slabs = std::clamp(cells / cells_worth_a_slab, Index{1}, most_slabs);
  out.slabs = {0};
  for (std::size_t l = 0; l + 1 < cells_of_layer.size(); ++l) {
    swept += cells_of_layer[l];
    if (swept * n_slabs >= cells * static_cast<Index>(out.slabs.size())) out.slabs.push_back(l + 1);
  }
  if (out.slabs.size() > 1) out.slabs.pop_back();  // the last plane goes with the layer below it
  out.slabs.push_back(cells_of_layer.size());
}

}  // namespace

CellBatches batches_of(const GridLevel& level, const std::vector<DenseCell>& dense) {
  CellBatches out;
  Builder builder(out);
  std::vector<Index> cells_of_layer(level.planes.size(), 0);
  std::size_t n = 0, d = 0;
  for (std::size_t l = 0; l < level.planes.size(); ++l) {
    CellLayer layer;
    layer.first_batch = static_cast<Index>(out.batches.size());
    layer.first_dense = static_cast<Index>(d);
    std::vector<const GridCell*> run;
    for (; n < level.cells.size() && level.cells[n].at[2] == static_cast<int>(l); ++n) {
      ++cells_of_layer[l];
      const bool is_dense = d < dense.size() && dense[d].cell == static_cast<Index>(n);
      if (is_dense) ++d;
      if (!run.empty() && (is_dense || !follows(*run.back(), level.cells[n]))) {
        builder.add_run(run);
        run.clear();
      }
      if (!is_dense) run.push_back(&level.cells[n]);
    }
    builder.add_run(run);
    builder.finish_layer();
    layer.last_batch = static_cast<Index>(out.batches.size());
    layer.last_dense = static_cast<Index>(d);
    out.layers.push_back(layer);
  }
  cut_slabs(cells_of_layer, out);
  return out;
}

}  // namespace palpate::physics
