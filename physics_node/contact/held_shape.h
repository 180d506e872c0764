#pragma once
// The rigid shape of a [[tool]], and how the hand holds it.

#include "common/scene/scene_fwd.h"
#include "physics_node/contact/rigid_shape.h"

namespace palpate::physics {

struct HeldShape {
  RigidShape shape;
  Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();  // of the shape, where the handle is not turned
  Vec3 tip = Vec3::Zero();  // what follows the hand's tip, in the frame of the shape [m]

  /// Its axes in the world, by the handle's attitude.
  Eigen::Matrix3d axes(const Eigen::Quaterniond& handle) const {
    return handle.toRotationMatrix() * attitude;
  }
  /// Origin of the shape, with these axes and the tip there.
  Vec3 origin(const Vec3& at, const Eigen::Matrix3d& axes) const { return at - axes * tip; }
  /// From the middle of its bounds to their corners [m].
  double half_diagonal() const { return 0.5 * shape.bounds().diagonal().norm(); }
  bool turns() const noexcept { return shape.kind() != RigidShape::Kind::sphere; }
};

/// How deep it may lie in tissue where a touch begins. Why: a touch begins outside; what is deeper without bearing has
/// got there otherwise, and would be thrown out [m].
inline constexpr double begins_within = 0.5e-3;

/// A point is a sphere whose lowest point is the tip; a stick a capsule whose axis begins there; what has flat ends begins at the tip and goes
/// up from it. @param tool  a shape of its own, not a body
HeldShape held_shape(const ToolSpec& tool);

}  // namespace palpate::physics
