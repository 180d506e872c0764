#pragma once
// The triangles of a lattice: three masses that all neighbour each other, and what lies on either side of one.
//
//   fcc    each triangle has a tetrahedron on one side and an octahedron on the other (EQUATIONS C-12)
//   voxel  each has one of the five tetrahedra of a cell on either side (EQUATIONS C-38)
//
// A side is closed while every element of the volume there lives. A triangle with both sides closed is inside the tissue.

#include <array>
#include <vector>

#include "physics_node/lattice/surroundings.h"

namespace palpate::physics {

struct TrianglePattern {
  std::array<Index, 2> corner{};  // the other two corners, from the one that comes first in storage; both > 0
  std::array<Need, 2> edges{};    // the three elements of the triangle
  std::array<std::vector<Need>, 2>
      side{};  // each volume; a mass is needed only after one that shows it to exist
};

/// By row kind. Every triangle of the lattice is found once, from its first corner.
using TrianglePatterns = std::array<std::vector<TrianglePattern>, max_row_kinds>;
TrianglePatterns triangle_patterns(const Lattice& lattice);

/// @param mask  called with a storage cell, tells its live elements
template <class MaskOf>
bool is_alive(const TrianglePattern& triangle, Index cell, const MaskOf& mask) {
  return holds(triangle.edges[0], cell, mask) && holds(triangle.edges[1], cell, mask);
}
template <class MaskOf>
bool is_closed(const std::vector<Need>& side, Index cell, const MaskOf& mask) {
  for (const Need& need : side)
    if (!holds(need, cell, mask)) return false;
  return true;
}
/// Alive, with one side closed and the other open. These triangles together close off what is filled.
template <class MaskOf>
bool is_boundary(const TrianglePattern& triangle, Index cell, const MaskOf& mask) {
  return is_alive(triangle, cell, mask) &&
         is_closed(triangle.side[0], cell, mask) != is_closed(triangle.side[1], cell, mask);
}
/// Alive, and at most one side closed: a boundary, or a sheet that nothing fills.
template <class MaskOf>
bool is_exposed(const TrianglePattern& triangle, Index cell, const MaskOf& mask) {
  return is_alive(triangle, cell, mask) &&
         !(is_closed(triangle.side[0], cell, mask) && is_closed(triangle.side[1], cell, mask));
}

}  // namespace palpate::physics
