#include "render_node/model/closedness.h"

#include <Eigen/Geometry>

namespace palpate::render {

namespace {

/// Another number for every edge, and its opposite for the same edge the other way: the sum over all facets is 0 where
/// each edge has two that go along it in opposite ways, and hardly ever where one has not.
std::uint64_t number_of(std::uint32_t from, std::uint32_t to) {
  if (from > to) return ~number_of(to, from) + 1;
  std::uint64_t x = (static_cast<std::uint64_t>(from) << 32 | to) * 0x9E3779B97F4A7C15ULL;
  x = (x ^ x >> 29) * 0xBF58476D1CE4E5B9ULL;
  return x ^ x >> 32;
}

}  // namespace

// sum of A_f = 0  and  V = sum of p_f . A_f / 3 > 0,  A_f = (c2 - c0) x (c3 - c1) / 2,  p_f on the facet
bool is_closed(const Surface& surface) {
  if (surface.corners.empty()) return false;
  const auto at = [&](std::uint32_t v) {
    const Array3f& p = surface.position[v];
    return Eigen::Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  };
  const Eigen::Vector3d origin = at(surface.corners.front()[0]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0, volume = 0;
  std::uint64_t edges = 0;
  for (const auto& c : surface.corners) {
    const Eigen::Vector3d a = 0.5 * (at(c[2]) - at(c[0])).cross(at(c[3]) - at(c[1]));
    sum += a;
    area += a.norm();
    volume += (at(c[0]) - origin).dot(a) / 3;
    for (std::size_t k = 0; k < 4; ++k)
      if (c[k] != c[(k + 1) % 4]) edges += number_of(c[k], c[(k + 1) % 4]);
  }
  return edges == 0 && sum.norm() < 1e-4 * area && volume > 0;
}

}  // namespace palpate::render
