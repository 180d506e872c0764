#pragma once
// Points against the surface of a body at rest: inside or not, and how near.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "physics_node/boundary/surface.h"

namespace palpate::physics {

class Enclosure {
 public:
  /// Cost: one surface of the body, scenery included.
  explicit Enclosure(const BodyModel& body);

  /// By the parity of hits of three rays, of which two must agree. Cost: three passes over the facets.
  bool contains(const Vec3& p) const;
  /// Is a vertex of the surface at most so near? @param reach  at most the spacing of the lattice [m]
  bool is_near(const Vec3& p, double reach) const;
  /// To the nearest vertex [m]. Cost: a pass over them.
  double distance(const Vec3& p) const;

  double spacing() const { return spacing_; }
  const Eigen::AlignedBox3d& box() const { return box_; }
  const std::vector<Vec3>& vertices() const { return surface_.rest; }

 private:
  std::uint64_t key(const Vec3& p, int dx, int dy, int dz) const;
  Surface surface_;
  double spacing_;
  Eigen::AlignedBox3d box_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> bins_;  // of the side of the spacing
};

}  // namespace palpate::physics
