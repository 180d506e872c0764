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
};

/// By the divergence theorem; of a closed surface that is anticlockwise from outside [m^3]
double enclosed_volume(const TriangleSurface& surface) noexcept;

}  // namespace palpate
