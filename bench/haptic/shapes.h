#pragma once
// Surfaces of triangles that a tool slides over, and the patches that physics would send of them.

#include <array>
#include <vector>

#include "common/math/vec3.h"
#include "common/message/messages.h"

namespace palpate::bench {

struct Triangle {
  std::array<Vec3, 3> corners;
  Vec3 normal;  // out of the solid, unit
};
using Shape = std::vector<Triangle>;

/// A solid edge along y at the origin with `angle` between its faces [rad]: one is z = 0, x < 0.
Shape convex_edge(double angle);
/// The corner of a box seen from inside: x, y, z > 0 is free.
Shape concave_corner();
/// The plane z = 0 twice, and once more tilted by `tilt` [rad].
Shape repeated_plane(double tilt);
/// Longitudes and latitudes `step` apart [rad].
Shape sphere(double radius, double step);

/// Largest angle between a triangle's normal and the way out from `centre` at its corners [rad].
double roughness(const Shape& shape, const Vec3& centre);

/// The facets nearest to p, up to what a patch holds; nearest first. Rigid.
ContactPatch nearest_patch(const Shape& shape, const Vec3& p, std::uint64_t tick);

/// Depth of p below the nearest triangle; 0 outside [m].
double depth_below(const Shape& shape, const Vec3& p);

}  // namespace palpate::bench
