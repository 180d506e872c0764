#include "physics_node/connection/strands.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "physics_node/collision/point_triangle.h"

namespace palpate::physics {
namespace {

constexpr double least_length = 0.1;  // of the reach
constexpr double least_way = 1e-6;    // of the reach, for a strand to have a direction
constexpr double least_area = 1e-3;   // of that around a vertex: strands along the surface stand for none

/// As much of an area as shows along a strand: at the rim of a body the sides do not count.
double seen_along(const Vec3& area, const Vec3& way, double reach) {
  const double length = way.norm();
  return length > least_way * reach ? std::abs(area.dot(way)) / length : area.norm();
}

using Vertices = std::array<std::uint32_t, 3>;  // of a triangle of a surface

std::vector<Vertices> moving_triangles(const Surface& surface) {
  std::vector<Vertices> triangles;
  const auto take = [&](const Vertices& t) {
    if (std::ranges::all_of(t, [&](std::uint32_t v) { return v < surface.n_moving(); }) && t[0] != t[1] &&
        t[1] != t[2] && t[2] != t[0])
      triangles.push_back(t);
  };
  for (const auto& f : surface.facets) {
    take({f[0], f[1], f[2]});
    take({f[0], f[2], f[3]});
  }
  return triangles;
}

/// A third of the triangles around each moving vertex, with their normals [m^2].
std::vector<Vec3> areas_of_vertices(const Surface& surface, const std::vector<Vertices>& triangles) {
  std::vector<Vec3> areas(surface.n_moving(), Vec3::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 area = 0.5 * (surface.rest[b] - surface.rest[a]).cross(surface.rest[c] - surface.rest[a]);
    for (const std::uint32_t v : {a, b, c}) areas[v] += area / 3;
  }
  return areas;
}

/// Triangles by the boxes of a grid that they lie in, so that those within one box of a place are few.
class TriangleGrid {
 public:
  TriangleGrid(const Surface& surface, const std::vector<Vertices>& triangles, double reach)
      : surface_(surface), triangles_(triangles), reach_(reach), side_(reach) {
    for (const Vertices& t : triangles) side_ = std::max(side_, box_of(t).sizes().maxCoeff());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Eigen::AlignedBox3d box = box_of(triangles[t]);
      const Vec3i lo = cell_of(box.min()), hi = cell_of(box.max());
      for (int k = lo.z(); k <= hi.z(); ++k)
        for (int j = lo.y(); j <= hi.y(); ++j)
          for (int i = lo.x(); i <= hi.x(); ++i) cells_[key({i, j, k})].push_back(t);
    }
  }

  struct Foot {
    std::size_t triangle = 0;
    ClosestPoint point;
  };
  /// The nearest place within reach; of two as near that of the earlier triangle.
  std::optional<Foot> nearest(const Vec3& p) const {
    std::optional<Foot> best;
    const Vec3i middle = cell_of(p);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells_.find(key(middle + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
      if (found == cells_.end()) continue;
      for (const std::size_t t : found->second) {
        const auto& [a, b, c] = triangles_[t];
        const ClosestPoint point = closest_point(p, {surface_.rest[a], surface_.rest[b], surface_.rest[c]});
        if (point.distance > reach_) continue;
        if (!best || point.distance < best->point.distance ||
            (point.distance == best->point.distance && t < best->triangle))
          best = Foot{t, point};
      }
    }
    return best;
  }

 private:
  Eigen::AlignedBox3d box_of(const Vertices& triangle) const {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t v : triangle) box.extend(surface_.rest[v]);
    return box;
  }
  Vec3i cell_of(const Vec3& p) const { return (p / side_).array().floor().cast<int>(); }
  static std::uint64_t key(const Vec3i& cell) {
    constexpr std::uint64_t wide = 1 << 21;
    std::uint64_t sum = 0;
    for (const int c : cell) sum = sum * wide + (static_cast<std::uint64_t>(c) & (wide - 1));
    return sum;
  }
  const Surface& surface_;
  const std::vector<Vertices>& triangles_;
  double reach_;
  double
      side_;  // no less than the reach or a triangle, so that eight boxes hold one however short the reach is [m]
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace

std::vector<Strand> make_strands(const ConnectionSpec& spec, const Surface& from, const Surface& to) {
  const auto own = moving_triangles(from), others = moving_triangles(to);
  const auto areas = areas_of_vertices(from, own);
  const TriangleGrid grid(to, others, spec.within);
  std::vector<Strand> strands;
  for (std::size_t v = 0; v < from.n_moving(); ++v) {
    const auto foot = grid.nearest(from.rest[v]);
    if (!foot) continue;
    const double area = seen_along(areas[v], foot->point.away, spec.within);
    if (area <= least_area * areas[v].norm()) continue;
    Strand strand;
    strand.node = from.cell[v];
    for (std::size_t c = 0; c < 3; ++c) strand.foot[c] = to.cell[others[foot->triangle][c]];
    for (Eigen::Index c = 0; c < 3; ++c) strand.share[static_cast<std::size_t>(c)] = foot->point.weight[c];
    strand.area = area;
    strand.length = std::max(foot->point.distance, least_length * spec.within);
    strand.k = spec.modulus * strand.area / strand.length;
    strand.c = spec.viscosity * strand.area / strand.length;
    strand.most_longer = spec.toughness > 0 ? std::sqrt(2 * spec.toughness * strand.area / strand.k)
                                            : std::numeric_limits<double>::infinity();
    strand.cut_work = spec.cut_toughness.value_or(0) * strand.area;
    strands.push_back(strand);
  }
  return strands;
}

namespace {

/// A strand takes k (u . (x_a - sum of w x_b))^2 <= 2 k (x_a^2 + sum of w x_b^2), since shares sum up to 1: so no
/// body's largest squared frequency grows by more than 2 / m_i times the sum of k w at a node. A damper alike.
double most_by_mass(const std::vector<Strand>& strands, double Strand::*of, int end,
                    const std::vector<double>& inverse_mass) {
  std::unordered_map<Index, double> sums;
  double most = 0;
  const auto add = [&](Index node, double k) {
    const double sum = sums[node] += k;
    most = std::max(most, 2 * sum * inverse_mass[static_cast<std::size_t>(node)]);
  };
  for (const Strand& strand : strands) {
    if (end == 0) add(strand.node, strand.*of);
    for (std::size_t c = 0; end == 1 && c < 3; ++c) add(strand.foot[c], strand.share[c] * strand.*of);
  }
  return most;
}

}  // namespace

double added_omega2(const std::vector<Strand>& strands, int end, const std::vector<double>& inverse_mass) {
  return most_by_mass(strands, &Strand::k, end, inverse_mass);
}

double added_rate(const std::vector<Strand>& strands, int end, const std::vector<double>& inverse_mass) {
  return most_by_mass(strands, &Strand::c, end, inverse_mass);
}

}  // namespace palpate::physics
