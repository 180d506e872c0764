#include "bench/haptic/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/message/vec3.h"
#include "haptic_node/contact/facet_geometry.h"

namespace palpate::bench {
namespace {

constexpr double half = 0.04;  // of a side of plane faces [m]

/// Corners in any order: the normal tells which way out is.
Triangle facing(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const bool ordered = (b - a).cross(c - a).dot(normal) > 0;
  return {{a, ordered ? b : c, ordered ? c : b}, normal};
}

/// The parallelogram at `corner` spanned by u and v.
void add_face(Shape& shape, const Vec3& corner, const Vec3& u, const Vec3& v, const Vec3& normal) {
  shape.push_back(facing(corner, corner + u, corner + u + v, normal));
  shape.push_back(facing(corner, corner + u + v, corner + v, normal));
}

double distance(const Triangle& t, const Vec3& p) {
  return (p - haptic::closest_on_triangle(p, t.corners[0], t.corners[1], t.corners[2])).norm();
}

}  // namespace

Shape convex_edge(double angle) {
  Shape shape;
  const Vec3 begin(0, -half, 0), along(0, 2 * half, 0);
  add_face(shape, begin, along, {-half, 0, 0}, {0, 0, 1});
  add_face(shape, begin, along, half * Vec3(-std::cos(angle), 0, -std::sin(angle)),
           {std::sin(angle), 0, -std::cos(angle)});
  return shape;
}

Shape concave_corner() {
  Shape shape;
  for (int i = 0; i < 3; ++i)
    add_face(shape, Vec3::Zero(), half * Vec3::Unit((i + 1) % 3), half * Vec3::Unit((i + 2) % 3),
             Vec3::Unit(i));
  return shape;
}

Shape repeated_plane(double tilt) {
  Shape shape;
  const Vec3 corner(-half, -half, 0), u(2 * half, 0, 0), v(0, 2 * half, 0);
  add_face(shape, corner, u, v, Vec3::UnitZ());
  add_face(shape, corner, u, v, Vec3::UnitZ());
  add_face(shape, corner, u, v, Vec3(std::sin(tilt), 0, std::cos(tilt)));
  return shape;
}

Shape sphere(double radius, double step) {
  const int across = static_cast<int>(std::lround(std::numbers::pi / step)), round = 2 * across;
  const auto at = [&](int i, int j) {
    const double theta = std::numbers::pi * i / across, phi = 2 * std::numbers::pi * j / round;
    return Vec3(radius *
                Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
  };
  Shape shape;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = (b - a).cross(c - a);
    if (n.norm() < 1e-12) return;  // at the poles
    shape.push_back(facing(a, b, c, n.dot(a) > 0 ? Vec3(n.normalized()) : Vec3(-n.normalized())));
  };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < round; ++j) {
      add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return shape;
}

double roughness(const Shape& shape, const Vec3& centre) {
  double most = 0;
  for (const Triangle& t : shape)
    for (const Vec3& corner : t.corners) {
      const Vec3 out = corner - centre;
      most = std::max(most, std::atan2(t.normal.cross(out).norm(), t.normal.dot(out)));
    }
  return most;
}

ContactPatch nearest_patch(const Shape& shape, const Vec3& p, std::uint64_t tick) {
  std::vector<std::pair<double, std::size_t>> near;
  near.reserve(shape.size());
  for (std::size_t i = 0; i < shape.size(); ++i) near.emplace_back(distance(shape[i], p), i);
  const std::size_t n = std::min<std::size_t>(near.size(), max_patch_facets);
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n), near.end());
  ContactPatch patch;
  patch.tick = tick;
  patch.n_facets = static_cast<std::uint32_t>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Triangle& t = shape[near[i].second];
    PatchFacet& facet = patch.facets[i];
    for (std::size_t k = 0; k < 3; ++k) facet.corners[k] = array(t.corners[k]);
    facet.point = array(Vec3((t.corners[0] + t.corners[1] + t.corners[2]) / 3));
    facet.normal = array(t.normal);
    facet.stiffness = rigid_stiffness;
    patch.contact_set = patch.contact_set * 31 + near[i].second + 1;
  }
  return patch;
}

double depth_below(const Shape& shape, const Vec3& p) {
  // Of triangles that share the nearest edge, the one whose plane is farthest knows which side p is on.
  double least = 1e9, height = 0;
  for (const Triangle& t : shape) {
    const double d = distance(t, p), h = t.normal.dot(p - t.corners[0]);
    if (d > least + 1e-9 || (d > least - 1e-9 && std::abs(h) <= std::abs(height))) continue;
    least = d;
    height = h;
  }
  return height < 0 ? least : 0.0;
}

}  // namespace palpate::bench
