#include "physics_node/contact/stick.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr int most_corrections = 4;

}  // namespace

SegmentPoints nearest_of_segments(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& e) noexcept {
  const Vec3 r = p - a;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), er = e.dot(r);
  SegmentPoints at;
  if (dd <= 1e-30) {
    at.t = ee > 0 ? std::clamp(er / ee, 0.0, 1.0) : 0.0;
    return at;
  }
  const double dr = d.dot(r);
  if (ee <= 1e-30) {
    at.s = std::clamp(-dr / dd, 0.0, 1.0);
    return at;
  }
  const double de = d.dot(e), denominator = dd * ee - de * de;
  at.s = denominator > 0 ? std::clamp((de * er - dr * ee) / denominator, 0.0, 1.0) : 0.0;
  at.t = (de * at.s + er) / ee;
  if (at.t < 0) {
    at.t = 0;
    at.s = std::clamp(-dr / dd, 0.0, 1.0);
  } else if (at.t > 1) {
    at.t = 1;
    at.s = std::clamp((de - dr) / dd, 0.0, 1.0);
  }
  return at;
}

double Stick::nearest(const Vec3& p) const noexcept {
  const double squared = D.squaredNorm();
  return squared > 0 ? std::clamp((p - A).dot(D) / squared, 0.0, 1.0) : 0.0;
}

StickHit sweep(const Stick& before, const Stick& now, const Vec3& p_0, const Vec3& p_1) noexcept {
  StickHit hit;
  // Seen from the stick as it was: the point goes from p_0 to p_0 + way.
  const double t_0 = before.nearest(p_0);
  const Vec3 moved = now.axis_point(t_0) - before.axis_point(t_0);
  const Vec3 way = p_1 - p_0 - moved;
  const SegmentPoints at = nearest_of_segments(p_0, way, before.A, before.D);
  const Vec3 apart = p_0 + at.s * way - before.axis_point(at.t);
  if (apart.squaredNorm() >= now.radius * now.radius) return hit;

  // Where it entered, or where it is if it was inside already: that side is kept.
  Vec3 side = p_0 - before.axis_point(t_0);
  const double length = before.D.norm();
  if (side.norm() < 1e-9 * std::max(length, now.radius))
    side = length > 0 ? Vec3(before.D.unitOrthogonal()) : Vec3(Vec3::UnitZ());
  hit.normal = side.normalized();
  const double t_1 = now.nearest(p_1);
  hit.axis_motion = now.axis_point(t_1) - before.axis_point(t_1);
  const Vec3 out = p_1 - now.axis_point(t_1);
  Vec3 by = Vec3::Zero();
  // Beyond the axis: back through it. On that side still: out along the shortest way, if it is inside at all.
  if (out.dot(hit.normal) <= 0) by = (now.radius - out.dot(hit.normal)) * hit.normal;
  // Near the rounded ends that may lead to where another point of the axis is nearest.
  for (int n = 0; n < most_corrections; ++n) {
    const Vec3 p = p_1 + by;
    const Vec3 from_axis = p - now.axis_point(now.nearest(p));
    const double distance = from_axis.norm();
    if (distance >= now.radius) break;
    by += distance > 0 ? Vec3((now.radius / distance - 1) * from_axis) : Vec3(now.radius * hit.normal);
  }
  hit.depth = by.norm();
  if (hit.depth <= 0) return hit;  // has only grazed
  hit.normal = by / hit.depth;
  hit.hit = true;
  return hit;
}

}  // namespace palpate::physics
