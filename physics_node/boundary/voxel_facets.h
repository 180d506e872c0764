#pragma once
// The facets of one voxel cell, wherever they are wanted: for the whole surface at once, or where elements have just broken.
// A face of a shown cell that no other shown cell covers is a facet. Of a cell that has lost an element (cut_cells.h) the
// triangles between its tetrahedra and what is empty are.
// Source: Takada & Abe, visible list; EQUATIONS C-8, C-37, C-38.

#include <array>
#include <utility>

#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

struct VoxelFace {
  Vec3i outward;
  std::array<Vec3i, 4> corners;  // of the unit cell, anticlockwise from outside
};

/// Number of a corner of the unit cell: bit 0 is +x, bit 1 +y, bit 2 +z.
inline std::size_t corner_number(const Vec3i& corner) noexcept {
  return static_cast<std::size_t>(corner.dot(Vec3i(1, 2, 4)));
}

inline const std::array<VoxelFace, 6> voxel_faces{{
    {{-1, 0, 0}, {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}}},
    {{1, 0, 0}, {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}}},
    {{0, -1, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}},
    {{0, 1, 0}, {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}}},
    {{0, 0, -1}, {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}}},
    {{0, 0, 1}, {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}},
}};

/// Corners of cells, anticlockwise from outside; a triangle repeats its last.
using FacetCorners = std::array<Vec3i, 4>;

/// @tparam Cut    CutCells or CellAndNeighbours
/// @tparam Shown  bool(cell)
template <class Cut, class Shown>
class VoxelFacets {
 public:
  /// @param cut  outlives this
  VoxelFacets(const Cut& cut, Shown shown) : cut_(cut), shown_(std::move(shown)) {}

  /// On one face of a shown cell.
  /// @param take  void(FacetCorners, bounds): `bounds` is false for a sheet, a triangle with nothing filled on either side
  /// @return how many facets are hidden between two filled cells; the other cell finds the same ones
  template <class Take>
  int on_face(const Vec3i& cell, const VoxelFace& face, Take&& take) const {
    const Vec3i beyond = cell + face.outward;
    const bool covered = shown_(beyond);
    if (cut_.is_cut(cell) || cut_.is_cut(beyond)) return on_cut_face(cell, face, covered, take);
    if (covered) return 1;
    take(FacetCorners{cell + face.corners[0], cell + face.corners[1], cell + face.corners[2],
                      cell + face.corners[3]},
         true);
    return 0;
  }

  /// The triangles between the middle tetrahedron of a cut cell and those at its corners. Parameters as above.
  template <class Take>
  int inside(const Vec3i& cell, Take&& take) const {
    int hidden = 0;
    const bool middle = cut_.middle_filled(cell);
    for (int n = 0; n < 8; ++n) {
      const Vec3i offset(n & 1, n >> 1 & 1, n >> 2 & 1);
      const Vec3i odd = cell + offset;
      if (!cut_.is_odd(odd)) continue;
      const Vec3i inwards = Vec3i::Ones() - 2 * offset;
      std::array<Vec3i, 3> p{odd, odd, odd};
      for (int a = 0; a < 3; ++a) p[static_cast<std::size_t>(a)][a] += inwards[a];
      const bool corner = cut_.corner_filled(cell, odd);
      if (corner && middle) {
        hidden += 2;
        continue;
      }
      if (!cut_.is_triangle(p[0], p[1], p[2])) continue;
      // x, y, z are anticlockwise seen from the inside of the cell when the product of signs is positive.
      if ((inwards.prod() > 0) == middle) std::swap(p[0], p[1]);
      take(FacetCorners{p[0], p[1], p[2], p[2]}, corner || middle);
    }
    return hidden;
  }

 private:
  /// The two triangles of a face between tetrahedra at its odd corners.
  template <class Take>
  int on_cut_face(const Vec3i& cell, const VoxelFace& face, bool covered, Take&& take) const {
    const Vec3i beyond = cell + face.outward;
    int hidden = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3i odd = cell + face.corners[n];
      if (!cut_.is_odd(odd)) continue;
      const Vec3i before = cell + face.corners[(n + 3) % 4];
      const Vec3i after = cell + face.corners[(n + 1) % 4];
      const bool mine = !cut_.is_cut(cell) || cut_.corner_filled(cell, odd);
      const bool theirs = covered && (!cut_.is_cut(beyond) || cut_.corner_filled(beyond, odd));
      if (mine && theirs) {
        ++hidden;
      } else if (mine) {
        take(FacetCorners{before, odd, after, after}, true);
      } else if (!theirs && cut_.is_triangle(before, odd, after) && (!covered || face.outward.sum() > 0)) {
        take(FacetCorners{before, odd, after, after}, false);  // shown by one of the two cells
      }
    }
    return hidden;
  }

  const Cut& cut_;
  Shown shown_;
};

}  // namespace palpate::physics
