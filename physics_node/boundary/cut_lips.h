#pragma once
// Where the lips of a cut through cells lie: on the blade's path, not on the faces that have opened.
//
// A blade that parts two cells has crossed the line between their centres somewhere. Around a node that is the corner of a lip the vertex
// of the lip is the mean of these places, of the faces that bound the cells of its own side; so the lips of a plane cut lie in that
// plane, and on each other. At the skin, where faces lie to one side of the node, it goes straight to that plane instead.
// Source: surface nets (Gibson 1998) on the links of Dick, Georgii & Westermann 2011.

#include <array>

#include "physics_node/lattice/cell_net.h"

namespace palpate::physics {

/// The cells round a node, by octant; bits 0, 1, 2 of one: the cell lies toward +x, +y, +z.
struct CellsRound {
  std::array<bool, 8> has{};  // the node at a corner; others have a copy of it, or are not there
  std::array<CellNet::Corners, 8> corners;       // of those
  std::array<std::array<FaceCut, 3>, 8> cut_at;  // between it and the next up an axis

  CellsRound() noexcept {
    for (auto& of_cell : cut_at) of_cell.fill({-1, {}});
  }
  const CellNet::Corners* corners_at(unsigned octant) const noexcept {
    return has[octant] ? &corners[octant] : nullptr;
  }
};

struct CutLip {
  int n = 0;                   // of places; 0: no lip
  Vec3 place = Vec3::Zero();   // of its vertex, from the node [m]
  Vec3 normal = Vec3::Zero();  // of the blade there, unit; zero: not known

  /// From a place at the skin, which is given from the node, straight to the plane of the blade [m].
  Vec3 from_skin(const Vec3& at) const noexcept { return normal.dot(place - at) * normal; }
};

/// Of a node with such cells round it. @param spacing  of cells [m]
inline CutLip lip_of(const CellsRound& round, const Vec3& spacing) noexcept {
  CutLip lip;
  for (unsigned o = 0; o < 8; ++o)
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned above = o | 1U << axis;
      const FaceCut& cut = round.cut_at[o][axis];
      if (above == o || cut.share < 0 || (!round.has[o] && !round.has[above])) continue;
      Vec3 at((o & 1) != 0 ? 0.5 : -0.5, (o & 2) != 0 ? 0.5 : -0.5, (o & 4) != 0 ? 0.5 : -0.5);
      at[static_cast<Eigen::Index>(axis)] += static_cast<double>(cut.share);
      lip.place += spacing.cwiseProduct(at);
      const Vec3 normal(static_cast<double>(cut.normal[0]), static_cast<double>(cut.normal[1]),
                        static_cast<double>(cut.normal[2]));
      lip.normal += lip.normal.dot(normal) < 0 ? Vec3(-normal) : normal;
      ++lip.n;
    }
  if (lip.n > 0) lip.place /= lip.n;
  if (lip.normal.norm() > 0) lip.normal.normalize();
  return lip;
}

}  // namespace palpate::physics
