#include "deploy/import/surface_cuts.h"

#include <algorithm>

namespace palpate {
namespace {

/// Six times the volume of a tetrahedron.
double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (a - d).dot((b - d).cross(c - d));
}

/// Does the line from p to q go through the inside of the triangle? Within rounding of its rim or plane it does not.
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double length = std::max({(q - p).norm(), (b - a).norm(), (c - a).norm()});
  const double least = 1e-9 * length * length * length;
  const double over = volume6(a, b, c, p), under = volume6(a, b, c, q);
  if (!((over > least && under < -least) || (over < -least && under > least))) return false;
  const double u = volume6(p, q, a, b), v = volume6(p, q, b, c), w = volume6(p, q, c, a);
  return (u > least && v > least && w > least) || (u < -least && v < -least && w < -least);
}

/// Does an edge of triangle s, none of whose ends is a corner of t, go through t?
bool goes_through(const TriangleSurface& surface, std::size_t s, std::size_t t) {
  const Corners &of = surface.triangles[s], &other = surface.triangles[t];
  const auto shared = [&](std::int32_t point) { return std::ranges::find(other, point) != other.end(); };
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t m = (n + 1) % 3;
    if (shared(of[n]) || shared(of[m])) continue;
    if (pierces(surface.corner(s, n), surface.corner(s, m), surface.corner(t, 0), surface.corner(t, 1),
                surface.corner(t, 2)))
      return true;
  }
  return false;
}

}  // namespace

SurfaceCuts cuts_of(const TriangleSurface& surface, const TriangleTree& tree,
                    const std::vector<std::size_t>& part) {
  SurfaceCuts cuts;
  for (std::size_t s = 0; s < surface.triangles.size(); ++s) {
    Eigen::AlignedBox3d box;
    for (std::size_t n = 0; n < 3; ++n) box.extend(surface.corner(s, n));
    bool cut = false;
    tree.for_each_in(box, [&](std::size_t t) {
      const bool decided = t == s || (part[s] == part[t] ? cut : cuts.between_parts.has_value());
      if (decided || !(goes_through(surface, s, t) || goes_through(surface, t, s))) return;
      if (part[s] == part[t])
        cut = true;
      else
        cuts.between_parts = surface.corner(s, 0);
    });
    if (cut && cuts.triangles++ == 0) cuts.first = surface.corner(s, 0);
  }
  return cuts;
}

}  // namespace palpate
