#include "bench/skin/skin_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "physics_node/body/border_cells.h"

namespace palpate::bench {
namespace {

using physics::Cells;
using physics::Surface;
using physics::Vec3i;
using Triangle = std::array<std::uint32_t, 3>;

/// phi and its gradient, in cells.
class Image {
 public:
  Image(const Cells& cells, double lo, double hi) : cells_(cells), lo_(lo), hi_(hi) {}

  double phi(const Vec3& p) const {
    const double intensity = physics::intensity_between(cells_, p);
    return std::min(intensity - lo_, hi_ - intensity);
  }
  Vec3 gradient(const Vec3& p) const {
    constexpr double step = 1e-3;
    Vec3 g;
    for (int a = 0; a < 3; ++a) {
      const Vec3 by = step * cells_.spacing[a] * Vec3::Unit(a);
      g[a] = (phi(p + by) - phi(p - by)) / (2 * step);
    }
    return g;
  }
  /// By Newton's method along the gradient, which in noise needs short steps. In cells.
  double from_border(const Vec3& p) const {
    Vec3 q = p;
    for (int n = 0; n < 30; ++n) {
      const Vec3 g = gradient(q);
      if (!(g.squaredNorm() > 0)) break;
      const Vec3 step = phi(q) / g.squaredNorm() * g;
      q -= cells_.spacing.cwiseProduct(step * std::min(1.0, 0.25 / step.norm()));
    }
    return (q - p).cwiseQuotient(cells_.spacing).norm();
  }
  /// Is it at the edge of the image, where tissue ends without its intensity saying so?
  bool is_at_edge(const Vec3& p) const {
    const Vec3 at = in_cells(p);
    return (at.array() < 0.5).any() ||
           (at.array() > (cells_.size.cast<double>() - Vec3::Constant(1.5)).array()).any();
  }

 private:
  Vec3 in_cells(const Vec3& p) const {
    return ((p - cells_.corner).array() / cells_.spacing.array() - 0.5).matrix();
  }
  const Cells& cells_;
  double lo_, hi_;
};

std::vector<Triangle> triangles_of(const Surface& surface) {
  std::vector<Triangle> triangles;
  for (const auto& f : surface.facets) {
    triangles.push_back({f[0], f[1], f[2]});
    if (f[2] != f[3]) triangles.push_back({f[0], f[2], f[3]});
  }
  return triangles;
}

/// Does the segment go through the triangle?
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto side = [](const Vec3& u, const Vec3& v, const Vec3& w, const Vec3& x) {
    return (v - u).cross(w - u).dot(x - u);
  };
  const double above = side(a, b, c, p), below = side(a, b, c, q);
  if ((above > 0) == (below > 0) || above == 0 || below == 0) return false;
  const double one = side(p, q, a, b), two = side(p, q, b, c), three = side(p, q, c, a);
  return (one > 0 && two > 0 && three > 0) || (one < 0 && two < 0 && three < 0);
}

class Crossings {
 public:
  Crossings(const Surface& surface, const std::vector<Triangle>& triangles, double side)
      : surface_(surface), triangles_(triangles), side_(side) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      each_bin(t, [&](std::uint64_t key) { bins_.emplace(key, t); });
  }
  std::size_t count() const {
    std::size_t n = 0;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      bool found = false;
      each_bin(t, [&](std::uint64_t key) {
        const auto [first, last] = bins_.equal_range(key);
        for (auto at = first; at != last && !found; ++at) found = at->second != t && meet(t, at->second);
      });
      n += found ? 1 : 0;
    }
    return n;
  }

 private:
  const Vec3& at(std::uint32_t v) const { return surface_.rest[v]; }
  bool meet(std::uint32_t s, std::uint32_t t) const {
    const Triangle &a = triangles_[s], &b = triangles_[t];
    for (const std::uint32_t v : a)
      if (std::ranges::find(b, v) != b.end()) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (pierces(at(a[k]), at(a[(k + 1) % 3]), at(b[0]), at(b[1]), at(b[2]))) return true;
      if (pierces(at(b[k]), at(b[(k + 1) % 3]), at(a[0]), at(a[1]), at(a[2]))) return true;
    }
    return false;
  }
  template <class Visit>
  void each_bin(std::uint32_t t, const Visit& visit) const {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t v : triangles_[t]) box.extend(at(v));
    const Vec3i lo = (box.min() / side_).array().floor().cast<int>(),
                hi = (box.max() / side_).array().floor().cast<int>();
    for (int z = lo.z(); z <= hi.z(); ++z)
      for (int y = lo.y(); y <= hi.y(); ++y)
        for (int x = lo.x(); x <= hi.x(); ++x) {
          const auto part = [](int i) { return static_cast<std::uint64_t>(i) & 0x1fffffU; };
          visit(part(x) | part(y) << 21U | part(z) << 42U);
        }
  }
  const Surface& surface_;
  const std::vector<Triangle>& triangles_;
  double side_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> bins_;
};

void count_edges(const Surface& surface, SkinQuality& quality) {
  std::vector<std::pair<std::uint64_t, int>> edges;  // by both ends, and which way it is passed
  for (const auto& f : surface.facets)
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint64_t a = f[c], b = f[(c + 1) % 4];
      if (a != b) edges.emplace_back(std::min(a, b) << 32U | std::max(a, b), a < b ? 1 : -1);
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t n = 0; n < edges.size();) {
    int sum = 0;
    std::size_t times = 0;
    for (const std::uint64_t edge = edges[n].first; n < edges.size() && edges[n].first == edge; ++n)
      sum += edges[n].second, ++times;
    quality.open_edges += sum != 0 ? 1 : 0;
    quality.edges_of_four += times > 2 ? 1 : 0;
  }
}

/// Vertices at which facets make more than one fan.
std::size_t count_bad_vertices(const Surface& surface) {
  struct Join {
    std::uint32_t vertex, one, other;
  };
  std::vector<Join> joins;
  for (const auto& f : surface.facets) {
    const std::size_t n = f[2] == f[3] ? 3 : 4;
    for (std::size_t c = 0; c < n; ++c) joins.push_back({f[c], f[(c + 1) % n], f[(c + n - 1) % n]});
  }
  std::sort(joins.begin(), joins.end(), [](const Join& a, const Join& b) { return a.vertex < b.vertex; });
  std::size_t bad = 0;
  for (std::size_t n = 0; n < joins.size();) {
    std::unordered_map<std::uint32_t, std::uint32_t> to;
    const auto root = [&](std::uint32_t v) {
      to.try_emplace(v, v);
      while (to[v] != v) v = to[v];
      return v;
    };
    for (const std::uint32_t vertex = joins[n].vertex; n < joins.size() && joins[n].vertex == vertex; ++n) {
      const std::uint32_t one = root(joins[n].one), other = root(joins[n].other);
      to[one] = other;
    }
    bad += std::ranges::count_if(to, [](const auto& v) { return v.first == v.second; }) != 1 ? 1 : 0;
  }
  return bad;
}

}  // namespace

SkinQuality skin_quality(const Surface& surface, const Cells& cells, double lo, double hi) {
  SkinQuality quality;
  const Image image(cells, lo, hi);
  quality.vertices = surface.n_vertices();
  std::vector<double> off;
  for (const Vec3& p : surface.rest)
    if (!image.is_at_edge(p)) off.push_back(image.from_border(p));
  std::sort(off.begin(), off.end());
  for (const double d : off) quality.mean += d / static_cast<double>(off.size());
  if (!off.empty()) quality.p99 = off[off.size() * 99 / 100], quality.most = off.back();
  const auto triangles = triangles_of(surface);
  quality.triangles = triangles.size();
  std::size_t n = 0;
  for (const Triangle& t : triangles) {
    const Vec3 &a = surface.rest[t[0]], &b = surface.rest[t[1]], &c = surface.rest[t[2]];
    const Vec3 middle = (a + b + c) / 3, area = (b - a).cross(c - a);
    const Vec3 out = -image.gradient(middle).cwiseQuotient(cells.spacing);
    if (image.is_at_edge(middle) || !(out.norm() > 0) || !(area.norm() > 0)) continue;
    quality.normal_mean += std::acos(std::clamp(area.normalized().dot(out.normalized()), -1.0, 1.0));
    ++n;
  }
  if (n > 0) quality.normal_mean *= 180 / std::numbers::pi / static_cast<double>(n);
  count_edges(surface, quality);
  quality.bad_vertices = count_bad_vertices(surface);
  quality.intersections = Crossings(surface, triangles, cells.spacing.maxCoeff()).count();
  return quality;
}

}  // namespace palpate::bench
