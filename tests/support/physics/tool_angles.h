#pragma once
// The angles of a knife or needle, measured from where its masses are. What the scene said is not looked at.

#include "physics_node/body/body.h"

namespace palpate::physics::test {

struct MeasuredTool {
  Eigen::Matrix3d R;      // columns: its own x, y, z in the world
  Vec3 tip;               // [m]
  double sharpening = 0;  // of a needle [rad]
};

/// The edge is the row furthest from the handle; its sheet of masses lies to -y of the other.
MeasuredTool measure_knife(const Body& body);

/// The bevel opens to where masses are missing. Its angle is that of the line through the lowest masses of all columns along
/// the axis, by least squares; so it is as good as columns are many.
MeasuredTool measure_needle(const Body& body);

}  // namespace palpate::physics::test
