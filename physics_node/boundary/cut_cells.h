#pragma once
// Which tetrahedra are left of the cells that have lost elements.
//
// A cell's corners of even X + Y + Z (grid coordinates of the lattice) are joined by the diagonals of its faces and span
// the middle tetrahedron; each of the four odd corners and the three even ones next to it span a corner tetrahedron
// (EQUATIONS C-38). A tetrahedron is filled while its six elements live (C-8).

#include <array>
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

  /// The same of any cell: `whole`, too, outside and of a rigid one.
  unsigned left_of_any(const Vec3i& cell) const noexcept;
  /// Is the tetrahedron at an odd corner among those left? @param corner  from the cell's first, of 0 and 1
  static bool has_corner(unsigned left, const Vec3i& corner) noexcept {
    return (left >> static_cast<unsigned>(corner.x() + 2 * corner.y() + 4 * corner.z()) & 1) != 0;
  }
  static bool has_middle(unsigned left) noexcept { return (left >> middle & 1) != 0; }
  /// Do three live elements join these corners of cells? Never asked of cells that live as a whole, which leave no sheets.
  bool is_triangle(const Vec3i& a, const Vec3i& b, const Vec3i& c) const noexcept;
  bool is_odd(const Vec3i& corner) const noexcept { return ((corner - shift_).sum() & 1) != 0; }
  /// The mass at a corner of cells, -1: none.
  Index mass(const Vec3i& corner) const noexcept { return net_.mass(corner - shift_); }
  const Vec3i& shift() const noexcept { return shift_; }  // from grid coordinates to corners of cells

 private:
  const Cells& cells_;
  LiveNet net_;
  Vec3i shift_;
  bool whole_or_gone_;  // Lattice::has_cells
};

/// One cell and the six that share a face with it, each looked at once: what VoxelFacets asks of a cell.
class CellAndNeighbours {
 public:
  /// @param now  outlives it, and must not change meanwhile
  CellAndNeighbours(const CellsNow& now, const Vec3i& cell) noexcept;

  bool is_cut(const Vec3i& cell) const noexcept { return left(cell) != CellsNow::whole; }
  bool corner_filled(const Vec3i& cell, const Vec3i& corner) const noexcept {
    return CellsNow::has_corner(left(cell), corner - cell);
  }
  bool middle_filled(const Vec3i& cell) const noexcept { return CellsNow::has_middle(left(cell)); }
  bool is_triangle(const Vec3i& a, const Vec3i& b, const Vec3i& c) const noexcept {
    return now_.is_triangle(a, b, c);
  }
  bool is_odd(const Vec3i& corner) const noexcept { return now_.is_odd(corner); }

 private:
  /// By the difference: 13 is the cell itself, and its neighbours differ by 1, 3 and 9.
  unsigned left(const Vec3i& cell) const noexcept {
    return left_[static_cast<std::size_t>(13 + (cell - cell_).dot(Vec3i(1, 3, 9)))];
  }
  const CellsNow& now_;
  Vec3i cell_;
  std::array<unsigned, 27> left_;  // only seven are used
};

/// All cells at one moment.
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
