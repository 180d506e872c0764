#include "haptic_node/contact/facet_geometry.h"

#include <Eigen/Geometry>

#include "common/message/vec3.h"

namespace palpate::haptic {

Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return a + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  const double up = d4 - d3, down = d5 - d6;
  if (va <= 0 && up >= 0 && down >= 0 && up + down > 0) return b + up / (up + down) * (c - b);
  const double sum = va + vb + vc;
  if (!(sum > 0)) return a;  // no area, and no edge is nearer than its corners
  return a + vb / sum * ab + vc / sum * ac;
}

double facet_gap(const Vec3& p, const PatchFacet& facet) noexcept {
  return vec(facet.normal).dot(p - vec(facet.point));
}

FacetPosition locate(const Vec3& p, const PatchFacet& facet) noexcept {
  const Vec3 a = vec(facet.corners[0]), b = vec(facet.corners[1]), c = vec(facet.corners[2]);
  const Vec3 off = p - closest_on_triangle(p, a, b, c);
  Vec3 n = (b - a).cross(c - a);
  const double area = n.norm();
  n = area > 1e-18 ? Vec3(n / area) : vec(facet.normal);
  FacetPosition position;
  position.distance = off.norm();
  position.lateral = (off - n.dot(off) * n).norm();
  position.gap = facet_gap(p, facet);
  return position;
}

}  // namespace palpate::haptic
