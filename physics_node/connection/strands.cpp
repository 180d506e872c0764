#include "physics_node/connection/strands.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

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

/// The place of a triangle nearest to p, as shares of its corners.
/// Source: Ericson, Real-time collision detection, 5.1.5.
std::array<double, 3> nearest_shares(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

using Triangle = std::array<std::uint32_t, 3>;  // vertices of a surface

std::vector<Triangle> moving_triangles(const Surface& surface) {
  std::vector<Triangle> triangles;
  const auto take = [&](const Triangle& t) {
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
std::vector<Vec3> areas_of_vertices(const Surface& surface, const std::vector<Triangle>& triangles) {
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
  TriangleGrid(const Surface& surface, const std::vector<Triangle>& triangles, double reach)
      : surface_(surface), triangles_(triangles), reach_(reach) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      Eigen::AlignedBox3d box;
      for (const std::uint32_t v : triangles[t]) box.extend(surface.rest[v]);
      const Vec3i lo = cell_of(box.min()), hi = cell_of(box.max());
      for (int k = lo.z(); k <= hi.z(); ++k)
        for (int j = lo.y(); j <= hi.y(); ++j)
          for (int i = lo.x(); i <= hi.x(); ++i) cells_[key({i, j, k})].push_back(t);
    }
  }

  struct Foot {
    std::size_t triangle = 0;
    std::array<double, 3> share{};
    Vec3 at = Vec3::Zero();
    double distance = 0;
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
        const Vec3 &xa = surface_.rest[a], &xb = surface_.rest[b], &xc = surface_.rest[c];
        const auto share = nearest_shares(p, xa, xb, xc);
        const Vec3 at = share[0] * xa + share[1] * xb + share[2] * xc;
        const double distance = (at - p).norm();
        if (distance > reach_) continue;
        if (!best || distance < best->distance || (distance == best->distance && t < best->triangle))
          best = Foot{t, share, at, distance};
      }
    }
    return best;
  }

 private:
  Vec3i cell_of(const Vec3& p) const { return (p / reach_).array().floor().cast<int>(); }
  static std::uint64_t key(const Vec3i& cell) {
    constexpr std::uint64_t wide = 1 << 21;
    std::uint64_t sum = 0;
    for (const int c : cell) sum = sum * wide + (static_cast<std::uint64_t>(c) & (wide - 1));
    return sum;
  }
  const Surface& surface_;
  const std::vector<Triangle>& triangles_;
  double reach_;
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
    const double area = seen_along(areas[v], foot->at - from.rest[v], spec.within);
    if (area <= least_area * areas[v].norm()) continue;
    Strand strand;
    strand.node = from.cell[v];
    for (std::size_t c = 0; c < 3; ++c) strand.foot[c] = to.cell[others[foot->triangle][c]];
    strand.share = foot->share;
    strand.area = area;
    strand.length = std::max(foot->distance, least_length * spec.within);
    strand.k = spec.modulus * strand.area / strand.length;
    strand.most_longer = spec.toughness > 0 ? std::sqrt(2 * spec.toughness * strand.area / strand.k)
                                            : std::numeric_limits<double>::infinity();
    strands.push_back(strand);
  }
  return strands;
}

/// A strand takes k (u . (x_a - sum of w x_b))^2 <= 2 k (x_a^2 + sum of w x_b^2), since shares sum up to 1: so no body's largest
/// squared frequency grows by more than 2 / m_i times the sum of k w at a node.
double added_omega2(const std::vector<Strand>& strands, int end, const std::vector<double>& inverse_mass) {
  std::unordered_map<Index, double> sums;
  double most = 0;
  const auto add = [&](Index node, double k) {
    const double sum = sums[node] += k;
    most = std::max(most, 2 * sum * inverse_mass[static_cast<std::size_t>(node)]);
  };
  for (const Strand& strand : strands) {
    if (end == 0) add(strand.node, strand.k);
    for (std::size_t c = 0; end == 1 && c < 3; ++c) add(strand.foot[c], strand.share[c] * strand.k);
  }
  return most;
}

}  // namespace palpate::physics
