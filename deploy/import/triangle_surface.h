#pragma once
// A surface of triangles, as a file gives it and as a closed one.

#include <array>
#include <cstdint>
#include <vector>

#include "common/math/vec3.h"

namespace palpate {

using Corners = std::array<std::int32_t, 3>;  // of a triangle: numbers of points

struct TriangleSurface {
  std::vector<Vec3> points;  // [m]
  std::vector<Corners> triangles;

  const Vec3& corner(std::size_t triangle, std::size_t n) const noexcept {
    return points[static_cast<std::size_t>(triangles[triangle][n])];
  }
  /// Between a triangle and a place; above 0 where it is anticlockwise seen from beyond it [m^3]
  double volume_under(std::size_t triangle, const Vec3& from) const noexcept {
    const Vec3 a = corner(triangle, 0) - from, b = corner(triangle, 1) - from;
    return a.dot(b.cross(corner(triangle, 2) - from)) / 6;
  }
};

/// By the divergence theorem; of a closed surface that is anticlockwise from outside [m^3]
inline double enclosed_volume(const TriangleSurface& surface) noexcept {
  double sum = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    sum += surface.volume_under(t, surface.points.front());  // near, so that no digits are lost
  return sum;
}

}  // namespace palpate
