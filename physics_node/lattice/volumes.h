#pragma once
// The volumes that a lattice fills space with, as tetrahedra: what it takes to know whether a place is inside a body as it is now.
//
//   fcc    tetrahedra; octahedra, as four tetrahedra round one diagonal; and at a cubic face the half of an octahedron that
//          lacks one mass, as two (EQUATIONS C-12)
//   voxel  the five tetrahedra of a cell (EQUATIONS C-38)
//
// A volume is filled while all elements between its masses live: what fcc_surface and voxel_surface draw is the skin of these.

#include <array>
#include <optional>
#include <vector>

#include "physics_node/lattice/surroundings.h"

namespace palpate::physics {

struct VolumePattern {
  std::vector<Index> corner;  // from the one that comes first in storage, which is the first: 0
  std::vector<Need> needs;    // all its elements; a mass is needed only after one that shows it to exist
  std::vector<std::array<std::uint8_t, 4>> tetrahedra;  // numbers of corners
  Vec3i lowest =
      Vec3i::Zero();           // least coordinates of the corners, from the first: names the cell of a voxel
  std::optional<Vec3i> lacks;  // from the first corner: the mass that is not there
};

/// By row kind. Every volume of the lattice is found once, from its first corner.
using VolumePatterns = std::array<std::vector<VolumePattern>, max_row_kinds>;
VolumePatterns volume_patterns(const Lattice& lattice);

/// Is it there, at this first corner, and filled?
template <class MaskOf>
bool is_filled(const VolumePattern& volume, const Lattice& lattice, Index cell, const MaskOf& mask) {
  for (const Need& need : volume.needs)
    if (!holds(need, cell, mask)) return false;
  return !volume.lacks || lattice.mass_at(lattice.grid_of(cell) + *volume.lacks) < 0;
}

}  // namespace palpate::physics
