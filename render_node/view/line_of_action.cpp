#include "render_node/view/line_of_action.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::render {
namespace {

Vec3 place(const Surface& surface, std::uint32_t vertex) {
  const Array3f& p = surface.position[vertex];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Moeller and Trumbore 1997: from + s along = a + u (b - a) + v (c - a), with u, v, 1 - u - v >= 0.
std::optional<double> hit(const Vec3& from, const Vec3& along, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, q = along.cross(ac);
  const double det = ab.dot(q);
  if (std::abs(det) <= 1e-12 * ab.norm() * ac.norm()) return std::nullopt;  // edge on, or without an area
  const Vec3 to = from - a, r = to.cross(ab);
  const double u = to.dot(q) / det, v = along.dot(r) / det;
  constexpr double rim =
      1e-6;  // Why: positions are single precision; a line through an edge must not slip between two
  if (u < -rim || v < -rim || u + v > 1 + rim) return std::nullopt;
  return ac.dot(r) / det;
}

}  // namespace

std::optional<LineOfAction> line_of_action(const Vec3& force, const Vec3& moment, const Vec3& set_point) {
  const double F = force.norm();
  if (!(F > 0) || !std::isfinite(F) || !moment.allFinite()) return std::nullopt;
  const Vec3 along = force / F;
  return LineOfAction{set_point + along.cross(moment) / F, along};
}

std::optional<double> first_hit(const Surface& surface, const Vec3& from, const Vec3& along, double least) {
  std::optional<double> first;
  for (const Corners& corners : surface.corners) {
    if (is_loose(corners)) continue;
    const Vec3 a = place(surface, corners[0]), c = place(surface, corners[2]);
    for (const auto& s : {hit(from, along, a, place(surface, corners[1]), c),
                          hit(from, along, a, c, place(surface, corners[3]))})
      if (s && *s >= least && (!first || *s < *first)) first = s;
  }
  return first;
}

std::optional<Vec3> pushed_point(const LineOfAction& line, const Surface& tool) {
  if (const auto s = first_hit(tool, line.point, line.along, -std::numeric_limits<double>::infinity()))
    return line.point + *s * line.along;
  std::optional<Vec3> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < tool.position.size(); ++v) {
    const Vec3 p = place(tool, v);
    const double distance = line.along.cross(p - line.point).norm();
    if (!(distance < least)) continue;
    least = distance;
    nearest = p;
  }
  return nearest;
}

Vec3 pushed_point(const LineOfAction& line, const Vec3& a, const Vec3& b, double radius) {
  // The point of the axis nearest to the line: both without their parts along the force.
  const auto across = [&](const Vec3& v) -> Vec3 { return v - v.dot(line.along) * line.along; };
  const Vec3 to = across(line.point - a), way = across(b - a);
  const double square = way.squaredNorm();
  const double whole = (b - a).squaredNorm();
  // A stick along the force is pushed at the end that the force comes to first.
  const double share = square > 1e-12 * whole ? std::clamp(to.dot(way) / square, 0.0, 1.0)
                                              : ((b - a).dot(line.along) >= 0 ? 0.0 : 1.0);
  return a + share * (b - a) - radius * line.along;
}

}  // namespace palpate::render
