#include "physics_node/remarks/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::physics {
namespace {

/// Does the ray p + s d, s > 0, go through the triangle? Moeller and Trumbore 1997.
bool hits(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, q = d.cross(ac);
  const double det = ab.dot(q);
  if (det == 0) return false;
  const Vec3 to = p - a, r = to.cross(ab);
  const double u = to.dot(q) / det, v = d.dot(r) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && ac.dot(r) / det > 0;
}

}  // namespace

Enclosure::Enclosure(const BodyModel& body)
    : surface_(make_surface(body, std::nullopt, 0xffffffffU)), spacing_(body.body().spacing()) {
  bins_.reserve(surface_.rest.size());
  for (std::uint32_t v = 0; v < surface_.rest.size(); ++v) {
    box_.extend(surface_.rest[v]);
    bins_.emplace(key(surface_.rest[v], 0, 0, 0), v);
  }
}

std::uint64_t Enclosure::key(const Vec3& p, int dx, int dy, int dz) const {
  const auto part = [&](double x, int d) {
    const double bin = std::clamp(std::floor(x / spacing_), -1e6, 1e6) + d;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(bin)) & 0x1fffffU;
  };
  return part(p.x(), dx) | part(p.y(), dy) << 21U | part(p.z(), dz) << 42U;
}

bool Enclosure::is_near(const Vec3& p, double reach) const {
  if (!(box_.exteriorDistance(p) <= reach)) return false;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto [first, last] = bins_.equal_range(key(p, dx, dy, dz));
        for (auto at = first; at != last; ++at)
          if ((surface_.rest[at->second] - p).squaredNorm() <= reach * reach) return true;
      }
  return false;
}

double Enclosure::distance(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : surface_.rest) least = std::min(least, (vertex - p).squaredNorm());
  return std::sqrt(least);
}

bool Enclosure::contains(const Vec3& p) const {
  if (!box_.contains(p)) return false;
  // In no plane of a lattice.
  const std::array<Vec3, 3> rays = {Vec3(61, 37, 71), Vec3(-53, 67, 43), Vec3(29, -73, -59)};
  int inside = 0;
  for (const Vec3& ray : rays) {
    int n = 0;
    for (const auto& facet : surface_.facets) {
      const Vec3 &a = surface_.rest[facet[0]], &b = surface_.rest[facet[1]], &c = surface_.rest[facet[2]];
      n += hits(p, ray, a, b, c) ? 1 : 0;
      if (facet[3] != facet[2]) n += hits(p, ray, a, c, surface_.rest[facet[3]]) ? 1 : 0;
    }
    inside += n % 2;
  }
  return inside >= 2;
}

}  // namespace palpate::physics
