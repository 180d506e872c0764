#include "physics_node/contact/rigid_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace palpate::physics {
namespace {

constexpr double tiny = 1e-12;  // Why: nearer to an axis or an edge, a direction is rounding [m]

using Flat = Eigen::Vector2d;  // distance from the axis, and along it

/// Signed distance to a convex outline, whose corners go round anticlockwise. The edge from its last corner back to its first lies on
/// the axis, and bounds nothing.
struct FlatDistance {
  double distance;
  Flat outward;
};
FlatDistance to_outline(const Flat& p, std::span<const Flat> corners) noexcept {
  double least = std::numeric_limits<double>::infinity();
  double deepest = -least;  // signed distance to the line of the nearest edge, for points inside
  Flat away = Flat::UnitX(), normal = Flat::UnitX();
  for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
    const Flat along = corners[n + 1] - corners[n], from = p - corners[n];
    const Flat out = Flat(along.y(), -along.x()).normalized();
    const double t = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Flat off = from - t * along;
    if (off.squaredNorm() < least) least = off.squaredNorm(), away = off;
    if (const double d = from.dot(out); d > deepest) deepest = d, normal = out;
  }
  if (deepest <= 0) return {deepest, normal};
  const double distance = std::sqrt(least);
  return {distance, distance > tiny ? Flat(away / distance) : normal};
}

}  // namespace

RigidShape::Distance RigidShape::distance(const Vec3& p) const noexcept {
  switch (kind_) {
    case Kind::sphere:
    case Kind::capsule:
      return to_round(p);
    case Kind::cylinder:
    case Kind::cone:
      return to_turned(p);
    case Kind::box:
      break;
  }
  return to_box(p);
}

/// |p - nearest point of the axis| - R
RigidShape::Distance RigidShape::to_round(const Vec3& p) const noexcept {
  const Vec3 off(p.x(), p.y(), p.z() - std::clamp(p.z(), radius_, length_ - radius_));
  const double r = std::sqrt(off.x() * off.x() + off.y() * off.y() + off.z() * off.z());
  return {r - radius_, r > tiny ? Vec3(off.x() / r, off.y() / r, off.z() / r) : Vec3(0, 0, -1)};
}

RigidShape::Distance RigidShape::to_turned(const Vec3& p) const noexcept {
  const double rho = std::hypot(p.x(), p.y());
  const Vec3 sideways = rho > tiny ? Vec3(p.x() / rho, p.y() / rho, 0) : Vec3(Vec3::UnitX());
  const std::array<Flat, 4> cylinder{Flat(0, 0), Flat(radius_, 0), Flat(radius_, length_), Flat(0, length_)};
  const std::array<Flat, 3> cone{Flat(0, 0), Flat(radius_, length_), Flat(0, length_)};
  const auto [distance, outward] =
      kind_ == Kind::cylinder ? to_outline({rho, p.z()}, cylinder) : to_outline({rho, p.z()}, cone);
  return {distance, outward.x() * sideways + outward.y() * Vec3::UnitZ()};
}

RigidShape::Distance RigidShape::to_box(const Vec3& p) const noexcept {
  const Vec3 q = p - half_.z() * Vec3::UnitZ();
  const Vec3 beyond = q.cwiseAbs() - half_;
  const Vec3 sign = q.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
  Eigen::Index axis = 0;
  const double deepest = beyond.maxCoeff(&axis);
  if (deepest <= tiny) return {deepest, sign[axis] * Vec3::Unit(axis)};
  const Vec3 off = beyond.cwiseMax(0.0);
  return {off.norm(), off.normalized().cwiseProduct(sign)};
}

Eigen::AlignedBox3d RigidShape::bounds() const {
  const Vec3 half = kind_ == Kind::box ? half_ : Vec3(radius_, radius_, 0);
  return {Vec3(-half.x(), -half.y(), 0), Vec3(half.x(), half.y(), length_)};
}

double RigidShape::size() const noexcept { return kind_ == Kind::box ? half_.head<2>().minCoeff() : radius_; }

}  // namespace palpate::physics
