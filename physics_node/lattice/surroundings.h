#pragma once
// The neighbourhood of one grid point deep inside a lattice that fills space: what patterns of triangles and volumes are made of.

#include <optional>
#include <vector>

#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// Elements that must live, at one mass: bits of its mask.
struct Need {
  Index offset = 0;  // of the mass from the first corner
  Mask bits = 0;
};

/// @param mask  called with a storage cell, tells its live elements
template <class MaskOf>
bool holds(const Need& need, Index cell, const MaskOf& mask) {
  return (mask(cell + need.offset) & need.bits) == need.bits;
}

class Surroundings {
 public:
  /// Every point of a row kind has the same surroundings; a point far enough from zero stands for all.
  Surroundings(const Lattice& lattice, int row_kind);
  static int kinds(const Lattice& lattice) { return lattice.kind == LatticeKind::fcc ? 2 : 4; }

  /// The direction of the element from one place to another, both in grid steps from the point, if there is one.
  std::optional<int> element(const Vec3i& from, const Vec3i& to) const;
  std::vector<Vec3i> neighbours(const Vec3i& of) const;
  /// In storage cells from the point.
  Index offset(const Vec3i& delta) const { return lattice_.cell_of(at_ + delta) - lattice_.cell_of(at_); }
  /// What all elements among `points` need, each at the end that comes first: in storage order that one is known to exist.
  std::vector<Need> needs(const std::vector<Vec3i>& points) const;
  /// Of a volume: where cells live as a whole, also that of the volume. @param points  the first is the first corner
  std::vector<Need> needs_of_volume(const std::vector<Vec3i>& points) const;

 private:
  const Lattice& lattice_;
  Vec3i at_;
  std::vector<Vec3i> half_;
};

}  // namespace palpate::physics
