#pragma once
// A smooth skin of a body of cells: naive surface nets. The facets are the faces of cells as ever; their corners have
// moved from the lattice to where the tissue ends.
//
// At a corner of cells the faces between what is filled and what is empty make fans: faces that share an edge there.
// Where four faces meet in an edge, the two of the same filled cell go together. Each fan has one vertex, the mean of
// the places where its faces' lines between centres cross the border of the tissue; so it is never farther than half
// a cell from its corner. It moves with the cell that holds it, or else with the nearest of its fan, by trilinear
// weights, which then go beyond it.
// Source: Gibson 1998 (surface nets), Nielson 2004 (dual fans); weights as in free-form deformation, Sederberg &
// Parry 1986.

#include <array>
#include <optional>

#include "physics_node/boundary/bearers.h"

namespace palpate::physics {

/// The fans at a corner, by which of the eight cells there are filled. Octant bits 0, 1, 2: the cell lies toward +x,
/// +y, +z.
struct SkinFans {
  int n = 0;
  std::array<std::uint8_t, 8> of_octant{};  // of a filled cell: the one that its facets are of
  std::array<std::uint16_t, 4> faces{};  // bit 4 axis + bits of the other two axes: the face across that axis
};
const SkinFans& skin_fans(unsigned filled) noexcept;

/// Of a place in a cell or beside it, by trilinear weights; nobody where the cell has no masses.
/// @param shift  from grid coordinates of the lattice to corners of cells
/// @param corners  of the cell where a cut has given it copies; null: as loaded
Bearers bearers_in_cell(const Body& body, const Vec3i& shift, const Vec3i& cell, const Vec3& place,
                        const CellNet::Corners* corners = nullptr) noexcept;

class SmoothSkin {
 public:
  static bool is_on(const Body& body) noexcept { return body.cells && !body.cells->crossings.empty(); }

  /// @param body  with a smooth skin; outlives this  @param threshold  as of voxel_surface()
  SmoothSkin(const Body& body, std::optional<double> threshold);

  /// As loaded. @param corner  of cells, where cell (i, j, k) has the corners (i, j, k) to (i + 1, j + 1, k + 1)
  const SkinFans& fans(const Vec3i& corner) const noexcept;
  /// Of the facets of a cell at its corner; -1: none, the corner lay inside the tissue or outside of it.
  int fan(const Vec3i& corner, const Vec3i& cell) const noexcept;
  /// Of the way from the centre of a shown cell to that of one which is not, across a face up or down an axis.
  double crossing(const Vec3i& in, int axis, bool up) const noexcept;
  /// Where the vertex of a fan rests [m].
  Vec3 place(const Vec3i& corner, int fan) const noexcept;
  /// Who carries it. Its own mass does where that is held by scenery, and where no cell lives around it.
  /// @param alive  bool(cell): whether a cell is there as a whole
  template <class Alive>
  Bearers bearers(const Vec3i& corner, int fan, const Vec3& place, const Alive& alive) const noexcept {
    unsigned lives = 0;
    for (unsigned o = 0; o < 8; ++o)
      if (const Vec3i cell = cell_at(corner, o);
          cells_.share_of(cell.x(), cell.y(), cell.z()) > 0 && alive(cell))
        lives |= 1U << o;
    return bearers_among(corner, fan, place, lives);
  }
  /// The same at a node that a cut has parted, or at its copy.
  /// @param corners_at  const CellNet::Corners*(octant): of the cell there, if it has that node; else null
  template <class CornersAt>
  Bearers bearers_of_part(const Vec3i& corner, int fan, const Vec3& place, Index node,
                          const CornersAt& corners_at) const noexcept {
    unsigned mine = 0;
    for (unsigned o = 0; o < 8; ++o)
      if (corners_at(o) != nullptr) mine |= 1U << o;
    const int holder = is_beside_scenery(corner) ? -1 : holder_among(corner, fan, place, mine);
    if (holder < 0) return Bearers::alone(node);
    const auto o = static_cast<unsigned>(holder);
    return bearers_in_cell(body_, shift_, cell_at(corner, o), place, corners_at(o));
  }

  /// The cell in an octant of a corner.
  static Vec3i cell_at(const Vec3i& corner, unsigned octant) noexcept {
    return corner - Vec3i::Ones() +
           Vec3i(static_cast<int>(octant & 1), static_cast<int>(octant >> 1 & 1),
                 static_cast<int>(octant >> 2));
  }
  /// From grid coordinates of the lattice to corners of cells.
  const Vec3i& shift() const noexcept { return shift_; }

 private:
  bool shown(const Vec3i& cell) const noexcept;
  double intensity(const Vec3i& cell) const noexcept;
  Bearers bearers_among(const Vec3i& corner, int fan, const Vec3& place, unsigned lives) const noexcept;
  bool is_beside_scenery(const Vec3i& corner) const noexcept;
  int holder_among(const Vec3i& corner, int fan, const Vec3& place, unsigned lives) const noexcept;

  const Body& body_;
  const Cells& cells_;
  std::optional<double> threshold_;
  Vec3i shift_;
  std::vector<std::uint32_t> row_;  // crossings of a row of cells along x: [row_[r], row_[r + 1])
};

}  // namespace palpate::physics
