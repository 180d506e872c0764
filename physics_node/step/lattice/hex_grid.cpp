#include "physics_node/step/lattice/hex_grid.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr Index lanes = 16;  // of the widest vector

// Why: shares of two threads then differ by a tenth at most, and few masses wait.
constexpr std::size_t most_slabs = 16;

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

/// Slabs of about as many cells each.
std::vector<HexSlab> slabs_of(const HexGrid& grid) {
  Index cells = 0;
  for (const HexRun& run : grid.runs) cells += run.count;
  std::vector<HexSlab> slabs{{}};
  Index swept = 0;
  for (const HexLayer& layer : grid.layers) {
    for (Index r = layer.first_run; r < layer.last_run; ++r)
      swept += grid.runs[static_cast<std::size_t>(r)].count;
    ++slabs.back().end;
    if (swept * static_cast<Index>(most_slabs) < cells * static_cast<Index>(slabs.size())) continue;
    if (slabs.back().end < grid.layers.size()) slabs.push_back({slabs.back().end, slabs.back().end});
  }
  return slabs;
}

}  // namespace

HexGrid make_hex_grid(const Body& body) {
  const Lattice& lattice = body.lattice;
  HexGrid grid;
  grid.up_y = lattice.pitch;
  grid.up_z = lattice.pitch * lattice.size.y();
  const Index half = lattice.pitch / 2;
  for (const Index cell : lattice.masses) {
    if (body.solid->stiffness[static_cast<std::size_t>(cell)] <= 0) continue;
    const bool extends = !grid.runs.empty() && grid.runs.back().first / half == cell / half &&
                         cell < grid.runs.back().first + grid.runs.back().count + lanes;
    if (extends) {
      grid.runs.back().count = cell - grid.runs.back().first + 1;
    } else {
      const bool odd = cell % lattice.pitch >= half;
      grid.runs.push_back({cell, 1, odd ? 1 - half : half});
    }
  }
  std::size_t run = 0;
  for (const RowSegment& row : lattice.rows) {
    grid.runs_of_row.push_back(static_cast<Index>(run));
    while (run < grid.runs.size() && grid.runs[run].first < row.first + row.count) ++run;
  }
  grid.runs_of_row.push_back(static_cast<Index>(run));
  grid.layers = layers_of(grid, lattice);
  grid.slabs = slabs_of(grid);
  return grid;
}

}  // namespace palpate::physics
