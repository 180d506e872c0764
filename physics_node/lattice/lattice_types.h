#pragma once
// The few types that the kernel shares with everybody, free of other headers.

#include <cstdint>

namespace palpate::physics {

using Index = std::int32_t;
using Mask = std::uint32_t;

inline constexpr int max_half = 9;
inline constexpr int max_directions = 2 * max_half;
inline constexpr int max_row_kinds = 4;

/// Of the elements in a mask, by direction.
inline constexpr Mask element_bits = (Mask{1} << max_directions) - 1;
/// Where cells live and break as a whole (Lattice::has_cells), a mask also tells which of the eight cells around a mass live.
/// @param octant  bits 0, 1, 2: the cell lies toward +x, +y, +z
constexpr Mask cell_bit(unsigned octant) noexcept { return Mask{1} << (max_directions + octant); }
inline constexpr Mask cell_bits = Mask{0xFF} << max_directions;

/// A run of storage cells that begins and ends with a mass and has no gap as long as a vector of cells. Of a lattice in segments it
/// may begin before its first mass, and is no longer than a vector.
struct RowSegment {
  Index first = 0;
  Index count = 0;
  int kind = 0;  // which offsets lead to the neighbours: Lattice::row_kind
};

/// Consecutive rows in whole planes of z, at least two planes, that one thread may step. Where the cuts are depends on the
/// body alone, so the order of every sum does too, whatever the number of threads.
struct Chunk {
  Index first_row = 0;
  Index top_row = 0;  // the first row of the last plane, whose upward elements cross into the next chunk
  Index last_row = 0;
};

}  // namespace palpate::physics
