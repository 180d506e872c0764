#pragma once
// The few types that the kernel shares with everybody, free of other headers.

#include <cstdint>

namespace palpate::physics {

using Index = std::int32_t;
using Mask = std::uint32_t;

inline constexpr int max_half = 9;
inline constexpr int max_directions = 2 * max_half;

/// A run of storage cells that begins and ends with a mass and has no gap as long as a vector of cells.
struct RowSegment {
  Index first = 0;
  Index count = 0;
  int parity = 0;  // of the row; always 0 on the voxel lattice
};

}  // namespace palpate::physics
