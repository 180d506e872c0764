#pragma once
// From a cell of a voxel lattice, which is known by the storage cell of its lowest corner, to its corners and to the cells beside it.

#include <array>

#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// Masses of even x lie before those of odd x in a row of storage.
struct CellSteps {
  Index half, up_y, up_z;  // half a row; to the next row; to the next plane

  explicit CellSteps(const Lattice& lattice) noexcept
      : half(lattice.pitch / 2), up_y(lattice.pitch), up_z(lattice.pitch * lattice.size.y()) {}

  bool is_odd(Index cell) const noexcept { return cell % up_y >= half; }
  Index right(Index cell) const noexcept { return is_odd(cell) ? 1 - half : half; }
  Index left(Index cell) const noexcept { return is_odd(cell) ? -half : half - 1; }
  /// The storage cell beside another across a face: -x +x -y +y -z +z. There is a halo of empty storage around all masses.
  Index beside(Index cell, std::size_t face) const noexcept {
    const std::array<Index, 6> by{left(cell), right(cell), -up_y, up_y, -up_z, up_z};
    return cell + by[face];
  }
  /// Bit 0 of the number is +x, bit 1 +y, bit 2 +z.
  std::array<Index, 8> corners(Index cell) const noexcept {
    const Index to_right = right(cell);
    std::array<Index, 8> corners;
    for (Index a = 0; a < 8; ++a)
      corners[static_cast<std::size_t>(a)] =
          cell + (a & 1) * to_right + (a >> 1 & 1) * up_y + (a >> 2) * up_z;
    return corners;
  }
};

}  // namespace palpate::physics
