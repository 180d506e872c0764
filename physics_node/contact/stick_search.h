#pragma once
// When a stick has to look again for what is near it.

#include <algorithm>
#include <vector>

#include "physics_node/boundary/boundary.h"
#include "physics_node/contact/stick.h"

namespace palpate::physics {

class StickSearch {
 public:
  /// Around the stick, within which things are listed: what a hand at 0.2 m/s covers in 50 ms [m].
  static constexpr double margin = 0.010;

  /// True the first time, once the stick has gone half the margin at either end, and after 20 ms, in which tissue
  /// may have come near by itself. A list begins with each `true`.
  bool due(const Stick& now, double t) noexcept {
    const double moved = std::max((now.A - A_).norm(), (now.A + now.D - A_ - D_).norm());
    if (moved <= 0.5 * margin && t - when_ < period && t >= when_) return false;
    A_ = now.A;
    D_ = now.D;
    when_ = t;
    return true;
  }
  void reset() noexcept { *this = {}; }

 private:
  static constexpr double period = 0.020;  // [s]

  Vec3 A_ = Vec3::Constant(1e9), D_ = Vec3::Zero();
  double when_ = -1e9;
};

/// The facets whose centroid lies within `around` of the axis and that have a mass at a corner: a stick meets no scenery.
/// Allocates only while `out` grows.
inline void facets_around(const Stick& stick, double around, const Boundary& boundary,
                          const NodeMotion& moving, std::vector<std::uint32_t>& out) {
  out.clear();
  boundary.facets_near(stick.axis_point(0.5), 0.5 * stick.D.norm() + around, moving, out);
  std::erase_if(out, [&](std::uint32_t facet) {
    if (!boundary.has_mass(facet)) return true;
    const Vec3 c = boundary.centroid(facet, moving);
    return (c - stick.axis_point(stick.nearest(c))).squaredNorm() > around * around;
  });
}

}  // namespace palpate::physics
