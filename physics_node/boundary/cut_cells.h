#pragma once
// Which tetrahedra are left of the cells that have lost elements.
//
// A cell's corners of even X + Y + Z (grid coordinates of the lattice) are joined by the diagonals of its faces and span
// the middle tetrahedron; each of the four odd corners and the three even ones next to it span a corner tetrahedron
// (EQUATIONS C-38). A tetrahedron is filled while its six elements live (C-8).

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "physics_node/boundary/live_elements.h"

namespace palpate::physics {

class CutCells {
 public:
  /// @param body  of voxels. Cost: eight cells for each mass that has lost an element.
  CutCells(const Body& body, const LiveElements& live);

  bool any() const { return !left_.empty(); }
  /// Has this cell lost an element? Cells outside have not.
  bool is_cut(const Vec3i& cell) const;
  /// Of a cut cell: is the tetrahedron filled at this corner, which is odd?
  bool corner_filled(const Vec3i& cell, const Vec3i& corner) const;
  bool middle_filled(const Vec3i& cell) const;
  /// Do three live elements join these corners of cells?
  bool is_triangle(const Vec3i& a, const Vec3i& b, const Vec3i& c) const;
  bool is_odd(const Vec3i& corner) const { return ((corner - shift_).sum() & 1) != 0; }
  /// All cut cells, each once; the same elements give the same order.
  const std::vector<Vec3i>& cells() const { return list_; }

 private:
  static constexpr unsigned middle =
      8;  // bit of the middle tetrahedron; bits 0 to 7: of the corner x + 2 y + 4 z
  unsigned left_of(const Vec3i& cell) const;

  const Cells& cells_;
  LiveNet net_;
  Vec3i shift_;                                     // from grid coordinates to corners of cells
  std::vector<bool> seen_;                          // while looking  (cells, or none where nothing broke)
  std::vector<bool> is_cut_;                        // the same shape
  std::unordered_map<std::size_t, unsigned> left_;  // bits of filled tetrahedra, by cell
  std::vector<Vec3i> list_;
};

}  // namespace palpate::physics
