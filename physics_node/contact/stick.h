#pragma once
// A straight stick as a capsule: its axis from the tip A to the end B, and a radius.

#include <Eigen/Geometry>

#include "common/math/vec3.h"

namespace palpate::physics {

// One of each for masses and faces, so that a face and its corners come out together.
inline constexpr double carried_within = 1e-6;  // of the stick in the step before: it was carried [m]
inline constexpr double exit_speed =
    1.0;  // most at which what is inside is brought out, beyond the stick's motion [m/s]

struct Stick {
  Vec3 A = Vec3::Zero();  // tip [m]
  Vec3 D = Vec3::Zero();  // B - A [m]
  double radius = 0;      // [m]

  /// The point of the axis nearest to p: A + t D, t = clamp((p - A) . D / |D|^2, 0, 1). (EQUATIONS C-33)
  double nearest(const Vec3& p) const noexcept;
  Vec3 axis_point(double t) const noexcept { return A + t * D; }
};

struct SegmentPoints {
  double s = 0, t = 0;  // in [0, 1]
};
/// Nearest points p + s d of one segment and a + t e of another.
/// Source: Ericson 2005, Real-Time Collision Detection, 5.1.9.
SegmentPoints nearest_of_segments(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& e) noexcept;

/// Where a moving point meets a moving stick, if it does.
struct StickHit {
  bool hit = false;
  Vec3 normal = Vec3::UnitZ();      // out of the stick, on the side that the point came from, unit
  double depth = 0;                 // from the point at the end of the way to the surface on that side [m]
  Vec3 axis_motion = Vec3::Zero();  // of the stick where it touches, over the way [m]
};

/// Straight ways of a point from p_0 to p_1 and of a stick from `before` to `now` in the same time: did the point enter
/// the capsule? A point that was inside at the start leaves by the side it is on. Exact for a stick that is moved; one
/// that turns by a small angle is taken to be moved by what its nearest point does.
StickHit sweep(const Stick& before, const Stick& now, const Vec3& p_0, const Vec3& p_1) noexcept;

}  // namespace palpate::physics
