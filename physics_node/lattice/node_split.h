#pragma once
// What a cut does to a node, and where it goes between two cells.

#include <array>

#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

/// A node and the copy of it that a part of its cells or tetrahedra have taken.
struct NodeSplit {
  Index node = 0, copy = 0;
};

/// Where a blade went between two cells.
struct FaceCut {
  float share = 0.5F;             // of the way from the centre of one to that of the other; below 0: nowhere
  std::array<float, 3> normal{};  // of the blade, unit; all zero: not known
};

}  // namespace palpate::physics
