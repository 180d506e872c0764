#pragma once
// Which cells lie near a place where a body is pressed, and how far it has to be awake about it.

#include <algorithm>

#include "physics_node/body/body.h"
#include "physics_node/step/lattice/hex_grid.h"

namespace palpate::physics {

/// Calls visit(run) for the runs whose rows pass a ball, in storage order; not all of them come into it.
template <class Visit>
void each_run_about(const Lattice& lattice, const HexGrid& grid, const Vec3& place, double within,
                    const Visit& visit) noexcept {
  const Vec3 reach = Vec3::Constant(within);
  const auto [lo, hi] = grid_box(lattice, place - reach, place + reach);
  for (int z = lo.z(); z <= hi.z(); ++z)
    for (int y = lo.y(); y <= hi.y(); ++y) {
      const Index begin = ((z + 1) * lattice.size.y() + y + 1) * lattice.pitch;
      auto row = std::ranges::lower_bound(lattice.rows, begin, {}, &RowSegment::first);
      for (; row != lattice.rows.end() && row->first < begin + lattice.pitch; ++row) {
        const auto at = static_cast<std::size_t>(row - lattice.rows.begin());
        for (Index r = grid.runs_of_row[at]; r < grid.runs_of_row[at + 1]; ++r)
          visit(static_cast<std::size_t>(r));
      }
    }
}

/// By the nearest point of its cells.
bool comes_within(const Body& body, const HexRun& run, const Vec3& place, double within) noexcept;

/// How far about a place a body is to be awake. On a flat skin, where a ball of `least` is half full of tissue, that is
/// `least`. Where it is less full, at an edge, a corner, or in what stands out, as an ear, further: until there is twice
/// as much tissue as half of that ball, or to nearly three times `least`.
/// Why: what stands behind the border is taken for a half space (soft_rim.h), which a wall of 8 mm is not, but the body
/// below it is.
/// Cost: of the cells in it, a few nanoseconds each, and of up to eleven radii that are tried.  [m]
double reach_of(const Body& body, const HexGrid& grid, const Vec3& place, double least) noexcept;

}  // namespace palpate::physics
