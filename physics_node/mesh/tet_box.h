#pragma once
// A box cut into cubes and these into tetrahedra: meshes whose volume, faces and answers are known.

#include <cstdint>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate::physics {

enum class CubeSplit {
  five,  // one in the middle and four corners; neighbours are mirrored, so that their faces meet
  six,   // round one diagonal
};

struct TetBox {
  std::array<int, 3> cells{1, 1, 1};  // along x, y, z; each above 0
  double edge = 1;                    // of a cell [m]
  CubeSplit split = CubeSplit::six;
  double jitter =
      0;  // inner nodes are moved by at most this along each axis, in edges; 0.15 turns nothing over
  std::uint64_t seed = 1;  // of it
};

/// From the origin on, along +x, +y, +z; region 0.
TetMesh make_tet_box(const TetBox& box);

}  // namespace palpate::physics
