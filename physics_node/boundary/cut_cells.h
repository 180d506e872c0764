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

/// Asked cell by cell, by the elements as they are at that moment.
class CellsNow {
 public:
  /// @param body   of voxels; @param masks  live elements of all storage cells  (n_cells). Both outlive this.
  CellsNow(const Body& body, std::span<const Mask> masks);

  static constexpr unsigned whole = 0xFFFF;  // every element of the cell lives
  static constexpr unsigned middle =
      8;  // bit of the middle tetrahedron; bits 0 to 7: of the corner x + 2 y + 4 z
  /// Bits of the tetrahedra that are left of a deformable cell, or `whole`.
  unsigned left_of(const Vec3i& cell) const noexcept;

  /// Has this cell lost an element? Cells outside and rigid ones have not.
  bool is_cut(const Vec3i& cell) const noexcept;
  /// Of a cut cell: is the tetrahedron filled at this corner, which is odd?
  bool corner_filled(const Vec3i& cell, const Vec3i& corner) const noexcept;
  bool middle_filled(const Vec3i& cell) const noexcept { return (left_of(cell) >> middle & 1) != 0; }
  /// Do three live elements join these corners of cells?
  bool is_triangle(const Vec3i& a, const Vec3i& b, const Vec3i& c) const noexcept;
  bool is_odd(const Vec3i& corner) const noexcept { return ((corner - shift_).sum() & 1) != 0; }
  /// The mass at a corner of cells, -1: none.
  Index mass(const Vec3i& corner) const noexcept { return net_.mass(corner - shift_); }
  const Vec3i& shift() const noexcept { return shift_; }  // from grid coordinates to corners of cells

 private:
  const Cells& cells_;
  LiveNet net_;
  Vec3i shift_;
};

/// The same at one moment, found once for all cells.
class CutCells {
 public:
  /// @param body  of voxels. Cost: eight cells for each mass that has lost an element.
  CutCells(const Body& body, const LiveElements& live);

  bool is_cut(const Vec3i& cell) const;
  bool corner_filled(const Vec3i& cell, const Vec3i& corner) const;
  bool middle_filled(const Vec3i& cell) const;
  bool is_triangle(const Vec3i& a, const Vec3i& b, const Vec3i& c) const { return now_.is_triangle(a, b, c); }
  bool is_odd(const Vec3i& corner) const { return now_.is_odd(corner); }
  bool any() const { return !left_.empty(); }
  /// All cut cells, each once; the same elements give the same order.
  const std::vector<Vec3i>& cells() const { return list_; }

 private:
  const Cells& cells_;
  CellsNow now_;
  std::vector<bool> seen_;                          // while looking  (cells, or none where nothing broke)
  std::vector<bool> is_cut_;                        // the same shape
  std::unordered_map<std::size_t, unsigned> left_;  // bits of filled tetrahedra, by cell
  std::vector<Vec3i> list_;
};

}  // namespace palpate::physics
