#include "physics_node/step/lattice/hex_grid.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr Index lanes = row_segment;

/// Layers of cells and masses, by the planes of z in which they begin.
std::vector<HexLayer> layers_of(const HexGrid& grid, const Lattice& lattice) {
  std::vector<HexLayer> layers(static_cast<std::size_t>(lattice.size.z()));
  const auto at = [&](Index cell) { return static_cast<std::size_t>(cell / grid.up_z); };
  for (std::size_t n = 0; n < grid.runs.size(); ++n) {
    HexLayer& layer = layers[at(grid.runs[n].first)];
    if (layer.last_run == 0) layer.first_run = static_cast<Index>(n);
    layer.last_run = static_cast<Index>(n) + 1;
  }
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    HexLayer& layer = layers[at(lattice.rows[r].first)];
    if (layer.last_row == 0) layer.first_row = static_cast<Index>(r);
    layer.last_row = static_cast<Index>(r) + 1;
  }
  return layers;
}

/// Rows with masses at corners of a run.
void add_rows(const Lattice& lattice, const HexRun& run, const HexGrid& grid, std::vector<Index>& rows) {
  const auto begin = static_cast<std::ptrdiff_t>(rows.size());
  for (Index a = 0; a < 8; ++a) {
    const Index first = grid.corner(run, run.first, a);
    auto row = std::lower_bound(lattice.rows.begin(), lattice.rows.end(), first,
                                [](const RowSegment& r, Index i) { return r.first + r.count <= i; });
    for (; row != lattice.rows.end() && row->first < first + run.count; ++row)
      rows.push_back(static_cast<Index>(row - lattice.rows.begin()));
  }
  std::sort(rows.begin() + begin, rows.end());
  rows.erase(std::unique(rows.begin() + begin, rows.end()), rows.end());
}

}  // namespace

void share_out(const HexGrid& grid, std::span<const HexLayer> layers, std::vector<HexSlab>& slabs) {
  const auto cells_of = [&grid](const HexLayer& layer) {
    std::int64_t cells = 0;
    for (Index r = layer.first_run; r < layer.last_run; ++r)
      cells += grid.runs[static_cast<std::size_t>(r)].count;
    return cells;
  };
  std::int64_t cells = 0, swept = 0;
  for (const HexLayer& layer : layers) cells += cells_of(layer);
  slabs.clear();
  slabs.push_back({});
  for (const HexLayer& layer : layers) {
    swept += cells_of(layer);
    ++slabs.back().end;
    if (swept * static_cast<std::int64_t>(most_slabs) < cells * static_cast<std::int64_t>(slabs.size()))
      continue;
    if (slabs.back().end < layers.size() && slabs.size() <= most_slabs)
      slabs.push_back({slabs.back().end, slabs.back().end});
  }
}

HexGrid make_hex_grid(const Body& body) {
  const Lattice& lattice = body.lattice;
  HexGrid grid;
  const CellSteps steps(lattice);
  grid.up_y = steps.up_y;
  grid.up_z = steps.up_z;
  for (const Index cell : lattice.masses) {
    if (body.solid->stiffness[static_cast<std::size_t>(cell)] <= 0) continue;
    const bool split = body.solid->awake_radius > 0;
    const bool extends = !grid.runs.empty() && grid.runs.back().first / steps.half == cell / steps.half &&
                         cell < grid.runs.back().first + (split ? 0 : grid.runs.back().count) + lanes;
    const Index first = split ? cell / lanes * lanes : cell;
    if (!extends) grid.runs.push_back({first, 0, steps.right(cell)});
    grid.runs.back().count = cell - grid.runs.back().first + 1;
  }
  std::size_t run = 0;
  for (const RowSegment& row : lattice.rows) {
    grid.runs_of_row.push_back(static_cast<Index>(run));
    while (run < grid.runs.size() && grid.runs[run].first < row.first + row.count) ++run;
  }
  grid.runs_of_row.push_back(static_cast<Index>(run));
  grid.layers = layers_of(grid, lattice);
  share_out(grid, grid.layers, grid.slabs);
  for (const HexRun& each : grid.runs) {
    grid.rows_begin.push_back(static_cast<Index>(grid.rows.size()));
    add_rows(lattice, each, grid, grid.rows);
  }
  grid.rows_begin.push_back(static_cast<Index>(grid.rows.size()));
  return grid;
}

}  // namespace palpate::physics
