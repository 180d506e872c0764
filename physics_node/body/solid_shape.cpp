#include "physics_node/body/solid_shape.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/error/error.h"
#include "common/scene/body_spec.h"

namespace palpate::physics {
namespace {

constexpr int needle_layers = 2;  // of masses: one cell

/// Distance from the axis of a tube.
double across(const Vec3& p, int axis) {
  return std::sqrt(std::max(0.0, p.squaredNorm() - p[axis] * p[axis]));
}

/// From the axis of a needle, whose tip lies on its wall.
double across(const Vec3& p, const NeedleShape& needle) {
  return std::hypot(p.x() - 0.5 * needle.diameter, p.y());
}

/// How far the bevel reaches up the axis.
double bevel_height(const NeedleShape& needle) {
  return needle.diameter * std::cos(needle.sharpening) / std::sin(needle.sharpening);
}

struct BoundsOf {
  double spacing;
  Bounds operator()(const SphereShape& s) const {
    return {Vec3::Constant(-s.radius), Vec3::Constant(s.radius)};
  }
  Bounds operator()(const BoxShape& s) const { return {-0.5 * s.size, 0.5 * s.size}; }
  Bounds operator()(const TubeShape& s) const {
    Vec3 half = Vec3::Constant(s.outer_radius);
    half[s.axis] = 0.5 * s.length;
    return {-half, half};
  }
  Bounds operator()(const KnifeShape& s) const {
    return {Vec3::Zero(), Vec3(s.length, spacing / std::numbers::sqrt2, s.height)};
  }
  // The builder moves the shaft down, so that its lowest mass is the tip, and cuts it to length.
  Bounds operator()(const NeedleShape& s) const {
    return {Vec3(0, -0.5 * s.diameter, 0),
            Vec3(s.diameter, 0.5 * s.diameter, s.length + bevel_height(s) + 2 * spacing)};
  }
  Bounds operator()(const VolumeShape&) const { PALPATE_CHECK(false, "an image is no solid"); }
  Bounds operator()(const MeshShape&) const { PALPATE_CHECK(false, "a mesh is no solid"); }
};

struct Holds {
  const Vec3& p;
  double slack;
  double spacing;
  bool operator()(const SphereShape& s) const { return p.norm() <= s.radius + slack; }
  bool operator()(const BoxShape& s) const { return (p.array().abs() <= 0.5 * s.size.array() + slack).all(); }
  bool operator()(const TubeShape& s) const {
    const double rho = across(p, s.axis);
    return std::abs(p[s.axis]) <= 0.5 * s.length + slack && rho <= s.outer_radius + slack &&
           rho >= s.inner_radius - slack;
  }
  bool operator()(const KnifeShape& s) const { return in_bounds(BoundsOf{spacing}(s)); }
  bool operator()(const NeedleShape& s) const {
    // The plane of the bevel holds the tip and stands at the sharpening angle to z: x cos(t) = z sin(t).
    return in_bounds(BoundsOf{spacing}(s)) && across(p, s) <= 0.5 * s.diameter + slack &&
           p.x() * std::cos(s.sharpening) - p.z() * std::sin(s.sharpening) <= slack;
  }
  bool operator()(const VolumeShape&) const { PALPATE_CHECK(false, "an image is no solid"); }
  bool operator()(const MeshShape&) const { PALPATE_CHECK(false, "a mesh is no solid"); }
  bool in_bounds(const Bounds& box) const {
    return (p.array() >= box.lo.array() - slack).all() && (p.array() <= box.hi.array() + slack).all();
  }
};

}  // namespace

Bounds bounds_of(const BodySpec& body) { return std::visit(BoundsOf{*body.spacing}, body.shape); }

bool holds(const BodySpec& body, const Vec3& p, double slack) {
  return std::visit(Holds{p, slack, *body.spacing}, body.shape);
}

bool beyond_outer_wall(const BodySpec& body, const Vec3& p) {
  if (const auto* needle = std::get_if<NeedleShape>(&body.shape))
    return across(p, *needle) > 0.5 * needle->diameter + on_surface;
  const auto& tube = std::get<TubeShape>(body.shape);
  return across(p, tube.axis) > tube.outer_radius + on_surface;
}

std::optional<int> wall_layers_of(const BodySpec& body) {
  if (std::holds_alternative<NeedleShape>(body.shape)) return needle_layers;
  const auto* tube = std::get_if<TubeShape>(&body.shape);
  return tube == nullptr ? std::nullopt : tube->wall_layers;
}

bool holds(const BoxRegion& box, const Vec3& p) {
  return (p.array() >= box.min.array() - on_surface).all() &&
         (p.array() <= box.max.array() + on_surface).all();
}
bool holds(const BallRegion& ball, const Vec3& p) {
  return (p - ball.center).norm() <= ball.radius + on_surface;
}

bool Carver::takes(const Vec3& p) {
  bool taken = false;
  for (std::size_t c = 0; c < used_.size(); ++c) {
    if (!std::visit([&p](const auto& where) { return holds(where, p); }, body_.cavities[c].where)) continue;
    used_[c] = true;
    taken = true;
  }
  return taken;
}

void Carver::refuse_unused() const {
  for (std::size_t c = 0; c < used_.size(); ++c)
    if (!used_[c])
      throw InputError(
          fmt::format("{}: cavity {} of body \"{}\" takes nothing away; its place must reach the body",
                      body_.cavities[c].place.text(), c + 1, body_.name));
}

}  // namespace palpate::physics
