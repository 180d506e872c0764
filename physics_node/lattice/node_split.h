#pragma once
// What a cut does to a node.

#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

/// A node and the copy of it that a part of its cells or tetrahedra have taken.
struct NodeSplit {
  Index node = 0, copy = 0;
};

}  // namespace palpate::physics
