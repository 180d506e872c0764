#pragma once
// What a step does for each cell: the element itself runs on numbers that count. A fused operation counts as two.

#include "bench/problems/hex_cube.h"

namespace palpate::bench {

/// Of the forces of a cell, added to its corners, and of the masses that move; one mass a cell.
double flops_per_cell(const HexCubeKind& kind);

/// u, v and what the two sweeps hand over, read and written once each; inverse mass, stiffness, and what a damper's books and a
/// memory keep.
double bytes_per_cell(const HexCubeKind& kind);

}  // namespace palpate::bench
