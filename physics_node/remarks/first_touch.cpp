#include "physics_node/remarks/first_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/contact/held_shape.h"
#include "physics_node/remarks/tool_points.h"

namespace palpate::physics {
namespace {

constexpr double most_pieces = 20000;  // of a path
constexpr int halvings = 20;           // of a piece in which a vertex comes into a shape

/// Of which share s of the way from p to p + d it goes through the triangle; above 1: nowhere. Moeller and Trumbore
/// 1997.
double way_to(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double nowhere = 2, slack = 1e-9;  // slack: no gap between triangles
  const Vec3 ab = b - a, ac = c - a, q = d.cross(ac);
  const double det = ab.dot(q);
  if (det == 0) return nowhere;
  const Vec3 to = p - a, r = to.cross(ab);
  const double u = to.dot(q) / det, v = d.dot(r) / det, s = ac.dot(r) / det;
  return u >= -slack && v >= -slack && u + v <= 1 + slack && s >= 0 ? s : nowhere;
}

/// The surface of a body at rest, its facets and vertices in bins of the side of its spacing.
class SurfaceBins {
 public:
  explicit SurfaceBins(const BodyModel& body)
      : surface_(make_surface(body, std::nullopt, 0xffffffffU)), side_(body.body().spacing()) {
    for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
      Eigen::AlignedBox3d box;
      for (const std::uint32_t corner : surface_.facets[f]) box.extend(surface_.rest[corner]);
      box_.extend(box);
      for_each_bin(box, [&](std::uint64_t key) { facets_.emplace(key, f); });
    }
    for (std::uint32_t v = 0; v < surface_.rest.size(); ++v)
      for_each_bin({surface_.rest[v], surface_.rest[v]},
                   [&](std::uint64_t key) { vertices_.emplace(key, v); });
  }

  double side() const { return side_; }
  const Eigen::AlignedBox3d& box() const { return box_; }

  /// Share of the way d from p after which a facet is met; above 1: none is.
  double way_to_facet(const Vec3& p, const Vec3& d) const {
    double least = 2;
    for_each_found(facets_, spanned(p, p + d), [&](std::uint32_t f) {
      const auto& at = surface_.facets[f];
      const Vec3 &a = surface_.rest[at[0]], &b = surface_.rest[at[1]], &c = surface_.rest[at[2]];
      least = std::min(least, way_to(p, d, a, b, c));
      if (at[3] != at[2]) least = std::min(least, way_to(p, d, a, c, surface_.rest[at[3]]));
    });
    return least;
  }
  /// The vertex that is deepest in a shape, if any is.
  std::optional<Vec3> vertex_inside(const RigidShape& shape, const Vec3& origin,
                                    const Eigen::Matrix3d& axes) const {
    Eigen::AlignedBox3d box;
    for (int c = 0; c < 8; ++c)
      box.extend(origin + axes * shape.bounds().corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)));
    double least = 0;
    std::optional<Vec3> found;
    for_each_found(vertices_, box, [&](std::uint32_t v) {
      const double distance = shape.distance(axes.transpose() * (surface_.rest[v] - origin)).distance;
      if (distance <= least) least = distance, found = surface_.rest[v];
    });
    return found;
  }

 private:
  using Bins = std::unordered_multimap<std::uint64_t, std::uint32_t>;
  static Eigen::AlignedBox3d spanned(const Vec3& a, const Vec3& b) {
    Eigen::AlignedBox3d box(a, a);
    return box.extend(b);
  }
  template <class Visit>
  void for_each_bin(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    const auto bin = [&](double x) { return static_cast<std::int64_t>(std::floor(x / side_)); };
    for (std::int64_t k = bin(box.min().z()); k <= bin(box.max().z()); ++k)
      for (std::int64_t j = bin(box.min().y()); j <= bin(box.max().y()); ++j)
        for (std::int64_t i = bin(box.min().x()); i <= bin(box.max().x()); ++i)
          visit((static_cast<std::uint64_t>(i) & 0x1fffffU) |
                (static_cast<std::uint64_t>(j) & 0x1fffffU) << 21U |
                (static_cast<std::uint64_t>(k) & 0x1fffffU) << 42U);
  }
  /// What lies in the bins that `box` and this surface share.
  template <class Visit>
  void for_each_found(const Bins& bins, const Eigen::AlignedBox3d& box, const Visit& visit) const {
    const Eigen::AlignedBox3d shared = box.intersection(box_);
    if (shared.isEmpty()) return;
    for_each_bin(shared, [&](std::uint64_t key) {
      const auto [first, last] = bins.equal_range(key);
      for (auto at = first; at != last; ++at) visit(at->second);
    });
  }

  Surface surface_;
  double side_;
  Eigen::AlignedBox3d box_;
  Bins facets_, vertices_;
};

/// A tool on a straight piece of its path.
class Sweep {
 public:
  Sweep(const ToolSpec& tool, std::vector<Vec3> points) : points_(std::move(points)) {
    if (tool.shape == ToolShape::stick || is_solid_tip(tool.shape)) held_ = held_shape(tool);
  }
  struct Met {
    double share = 2;  // of the piece; above 1: nothing
    Vec3 at = Vec3::Zero();
  };
  Met meets(const SurfaceBins& surface, const Vec3& from, const Vec3& way) const {
    Met met;
    for (const Vec3& point : points_) {
      const double share = surface.way_to_facet(from + point, way);
      if (share <= 1 && share < met.share) met = {share, from + point + share * way};
    }
    if (!held_) return met;
    const Eigen::Matrix3d axes = held_->axes(Eigen::Quaterniond::Identity());
    const auto inside = [&](double share) {
      return surface.vertex_inside(held_->shape, held_->origin(from + share * way, axes), axes);
    };
    auto vertex = inside(1);
    if (!vertex) return met;
    double out = 0, in = 1;
    for (int n = 0; n < halvings; ++n) {
      const double half = 0.5 * (out + in);
      const auto there = inside(half);
      if (there) vertex = there;
      (there ? in : out) = half;
    }
    if (in < met.share) met = {in, *vertex};
    return met;
  }

 private:
  std::vector<Vec3> points_;
  std::optional<HeldShape> held_;
};

}  // namespace

bool may_know_first_touch(const Scene& scene, const Bodies& bodies, const ToolSpec& tool) {
  const DeviceSpec& device = scene.device(tool.device);
  const bool turns = std::any_of(device.options.begin(), device.options.end(),
                                 [](const auto& option) { return option.first == "attitudes"; });
  return device.driver == "simulated" && !device.waypoints.empty() && !turns && !any_flies(scene, bodies);
}

std::optional<FirstTouch> first_touch(const Scene& scene, const Bodies& bodies, const ToolSpec& tool) {
  const std::vector<Waypoint>& path = scene.device(tool.device).waypoints;
  std::vector<std::pair<std::size_t, SurfaceBins>> others;
  double finest = std::numeric_limits<double>::infinity(), length = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (is_tool(scene, bodies[b]->body())) continue;  // a hand leads it elsewhere
    others.emplace_back(b, SurfaceBins(*bodies[b]));
    finest = std::min(finest, others.back().second.side());
  }
  if (others.empty()) return std::nullopt;
  for (std::size_t n = 1; n < path.size(); ++n) length += (path[n].p - path[n - 1].p).norm();
  const Sweep sweep(tool, tool_points(tool, scene, bodies, 0.5 * finest));
  const double apart = std::max(0.25 * finest, length / most_pieces);
  for (std::size_t n = 1; n < path.size(); ++n) {
    const Vec3 whole = path[n].p - path[n - 1].p;
    const int pieces = std::max(1, static_cast<int>(std::ceil(whole.norm() / apart)));
    for (int i = 0; i < pieces; ++i) {
      const Vec3 from = path[n - 1].p + whole * i / pieces;
      Sweep::Met first;
      std::size_t body = 0;
      for (const auto& [b, surface] : others)
        if (const auto met = sweep.meets(surface, from, whole / pieces); met.share < first.share)
          first = met, body = b;
      if (first.share > 1) continue;
      const double share = (i + first.share) / pieces;
      return FirstTouch{path[n - 1].t + share * (path[n].t - path[n - 1].t), first.at, body};
    }
  }
  return std::nullopt;
}

}  // namespace palpate::physics
