#pragma once
// One level of a hierarchy: cells of one size, the nodes at their corners, and whose part each of them is on the next level.

#include <array>
#include <cstdint>
#include <vector>

#include "common/math/vec3.h"
#include "physics_node/body/body.h"

namespace palpate::physics {

using GridPlace = std::array<int, 3>;  // x, y, z, in cells of the level

struct GridCell {
  GridPlace at{};                 // of its lowest corner
  std::array<Index, 8> corner{};  // nodes; bit 0 is +x, bit 1 +y, bit 2 +z
  double stiffness = 0;           // modulus over the body's own, mean with what is empty of it
  Index parent = -1;              // its cell of the next level
};

/// Nodes of one z: [first, last). Some numbers follow that are no nodes, so that a kernel may read and write beyond its last.
struct GridPlane {
  Index first = 0, last = 0;
};
inline constexpr Index room_between_planes = 32;

/// Cells in the order of z, then of their lowest corners. Nodes in the order of z, then of copies of one place, then y, then x: the
/// corners of cells along x are consecutive.
struct GridLevel {
  Vec3 edge = Vec3::Zero();  // of a cell [m]
  std::vector<GridCell> cells;
  std::vector<GridPlane> planes;   // upwards; cells of layer k lie between planes k and k + 1
  std::vector<GridPlace> place;    // of each node                        (n_nodes)
  std::vector<std::uint8_t> held;  // or not a node                       (n_nodes)
  Index n_nodes = 0;               // numbers, with the room between planes
};

/// The cells of a body of finite elements.
struct BodyGrid {
  GridLevel level;
  std::vector<Index> storage;  // node of the body, -1: room between planes  (n_nodes)
};
BodyGrid body_grid(const Body& body);

/// Gives nodes their numbers: corners of cells are any numbers in [0, n_before), and get those of the level's order.
/// @return the new number of each, or -1  (n_before)
std::vector<Index> number_nodes(GridLevel& level, Index n_before);

}  // namespace palpate::physics
