#include "physics_node/step/lattice/hex_grid.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr Index lanes = 16;  // of the widest vector

/// Consecutive items of one plane of z each.
template <class Items, class First>
std::vector<HexPiece> by_plane(const Items& items, Index plane, const First& first) {
  std::vector<HexPiece> pieces;
  Index last = -1;
  for (std::size_t n = 0; n < items.size(); ++n) {
    const Index now = first(items[n]) / plane;
    if (now != last) pieces.push_back({static_cast<Index>(n), static_cast<Index>(n)});
    pieces.back().end = static_cast<Index>(n) + 1;
    last = now;
  }
  return pieces;
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
  grid.layers = by_plane(grid.runs, grid.up_z, [](const HexRun& r) { return r.first; });
  grid.planes = by_plane(lattice.rows, grid.up_z, [](const RowSegment& r) { return r.first; });
  return grid;
}

}  // namespace palpate::physics
