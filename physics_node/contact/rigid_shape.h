#pragma once
// How far a point is from a rigid tool, and which way out: the signed distance of simple shapes, exact inside and outside.
//
// Every shape has a frame of its own: its tip is the origin, and it reaches from there along +z, away from the tissue.
//   sphere    of `radius`
//   capsule   of `radius`, `length` from the tip to the other end
//   cylinder  of `radius` and `length`, with flat ends and sharp edges
//   cone      its apex is the tip; of `radius` and `length` at the flat end
//   box       2 half.x by 2 half.y by 2 half.z, sharp edges
// Source: the distance to segments of a profile, turned about an axis; Ericson, Real-Time Collision Detection, 5.1.

#include <Eigen/Geometry>

#include "common/math/vec3.h"

namespace palpate::physics {

class RigidShape {
 public:
  enum class Kind { sphere, capsule, cylinder, cone, box };

  /// All lengths in metres and above 0. @param length  at least twice the radius of a capsule
  static RigidShape sphere(double radius) { return {Kind::sphere, radius, 2 * radius, Vec3::Zero()}; }
  static RigidShape capsule(double radius, double length) {
    return {Kind::capsule, radius, length, Vec3::Zero()};
  }
  static RigidShape cylinder(double radius, double length) {
    return {Kind::cylinder, radius, length, Vec3::Zero()};
  }
  static RigidShape cone(double radius, double length) { return {Kind::cone, radius, length, Vec3::Zero()}; }
  static RigidShape box(const Vec3& half) { return {Kind::box, 0, 2 * half.z(), half}; }

  struct Distance {
    double distance = 0;           // below 0: inside [m]
    Vec3 outward = Vec3::UnitZ();  // its gradient, unit; where that is not one, some nearest way out
  };
  /// @param p  in the shape's frame [m]. Cost: 5 to 20 ns.
  Distance distance(const Vec3& p) const noexcept;

  /// In the shape's frame [m].
  Eigen::AlignedBox3d bounds() const;
  Kind kind() const noexcept { return kind_; }
  /// What its samples of a surface have to resolve: a radius, or the shorter half edge of a box [m].
  double size() const noexcept;

 private:
  RigidShape(Kind kind, double radius, double length, const Vec3& half)
      : kind_(kind), radius_(radius), length_(length), half_(half) {}
  Distance to_round(const Vec3& p) const noexcept;
  Distance to_turned(const Vec3& p) const noexcept;
  Distance to_box(const Vec3& p) const noexcept;

  Kind kind_;
  double radius_, length_;
  Vec3 half_;
};

}  // namespace palpate::physics
