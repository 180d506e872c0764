#pragma once
// The cantilever of hex_beam.h, of linear tetrahedra: solved at once from their stiffness near rest.

#include "physics_node/mesh/tet_box.h"

namespace palpate::bench {

struct TetCantilever {
  int cells = 4;  // over its height, and over its breadth; each cut into tetrahedra
  double poisson_ratio = 0.45;
  bool nodal_pressure = true;
  bool second_order = false;
  physics::CubeSplit split = physics::CubeSplit::six;
  double jitter = 0;  // of inner nodes, in cells
};

/// How far the end face sinks, in the mean of its nodes, over the same of CalculiX's quadratic bricks.
/// Cost: a tenth of a second at 4 cells, seconds at 8.
double tet_beam_ratio(const TetCantilever& how);

}  // namespace palpate::bench
