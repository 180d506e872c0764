#include "deploy/import/surface_winding.h"

#include <algorithm>
#include <utility>

namespace palpate {

/// How the triangle goes round the ray, seen along x: in the plane of y and z, crossings of its edges with the line on from x along y.
int SurfaceWinding::turn_of(std::size_t triangle, const Vec3& x) const noexcept {
  int turn = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3 &a = surface_.corner(triangle, n), &b = surface_.corner(triangle, (n + 1) % 3);
    const bool up = b.z() > x.z();
    if ((a.z() > x.z()) == up) continue;
    const Vec3 &low = up ? a : b, &high = up ? b : a;  // whichever triangle asks
    const double y = low.y() + (x.z() - low.z()) / (high.z() - low.z()) * (high.y() - low.y());
    if (y > x.y()) turn += up ? 1 : -1;
  }
  return turn;
}

/// @param x  whose ray's line meets the triangle
bool SurfaceWinding::lies_beyond(std::size_t triangle, const Vec3& x) const noexcept {
  const Vec3 &a = surface_.corner(triangle, 0), &b = surface_.corner(triangle, 1),
             &c = surface_.corner(triangle, 2);
  const auto [least, most] = std::minmax({a.x(), b.x(), c.x()});
  if (least > x.x() || most <= x.x()) return least > x.x();
  const Vec3 normal = (b - a).cross(c - a);
  const double height = normal.dot(x - a);  // below 0 behind it
  return normal.x() > 0 ? height < 0 : height > 0;
}

}  // namespace palpate
