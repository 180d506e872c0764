#pragma once
// What a step does for each tetrahedron: the element itself runs on numbers that count. A fused operation counts as two.

#include "bench/fem/tet_cost.h"
#include "physics_node/step/fem/tet_layout.h"

namespace palpate::bench {

/// Of the forces of a tetrahedron and of its damper, with nodal pressure of its volume, too, and of the nodes that move.
double flops_per_tet(const physics::TetLayout& layout, TetElement element, bool damped);

/// Slopes, volume and corners, twice with nodal pressure; nodes, their copies and their parts.
double bytes_per_tet(const physics::TetLayout& layout, TetElement element, double real_size, bool damped);

}  // namespace palpate::bench
