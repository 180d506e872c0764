#pragma once
// What a step does for each cell: the element itself runs on numbers that count. A fused operation counts as two.

#include "common/scene/element_kinds.h"

namespace palpate::bench {

/// Of the forces of a cell, added to its corners, and of the masses that move; one mass a cell.
double flops_per_cell(HourglassKind hourglass, bool damped);

/// u, v and what the two sweeps hand over, read and written once each; inverse mass and stiffness.
double bytes_per_cell(bool damped, double real_size);

}  // namespace palpate::bench
