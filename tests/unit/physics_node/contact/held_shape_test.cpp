// Where the shape of a tool lies in its hand.

#include "physics_node/contact/held_shape.h"

#include <gtest/gtest.h>

#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

/// Of a point of the world, with the hand's tip at (1, 2, 3). [m]
double distance(const ToolSpec& tool, const Eigen::Quaterniond& handle, const Vec3& from_tip) {
  const HeldShape held = held_shape(tool);
  const Vec3 tip(1, 2, 3);
  const Eigen::Matrix3d axes = held.axes(handle);
  return held.shape.distance(axes.transpose() * (tip + from_tip - held.origin(tip, axes))).distance;
}

const Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
const Eigen::Quaterniond lying(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));  // +z becomes +x

TEST(HeldShape, OfAPointIsABallWhoseLowestPointIsTheTip) {
  ToolSpec tool;
  tool.radius = 0.005;
  EXPECT_NEAR(distance(tool, upright, Vec3::Zero()), 0, 1e-12);
  EXPECT_NEAR(distance(tool, upright, Vec3(0, 0, 0.005)), -0.005, 1e-12);
}

/// A stick's axis goes down from its tip, which lies inside of the round end.
TEST(HeldShape, OfAStickIsACapsuleAlongItsAxis) {
  ToolSpec tool;
  tool.shape = ToolShape::stick;
  tool.radius = 0.002;
  tool.length = 0.06;
  EXPECT_NEAR(distance(tool, upright, Vec3::Zero()), -0.002, 1e-12);
  EXPECT_NEAR(distance(tool, upright, Vec3(0, 0, 0.002)), 0, 1e-12);
  EXPECT_NEAR(distance(tool, upright, Vec3(0, 0, -0.062)), 0, 1e-12);
  EXPECT_NEAR(distance(tool, lying, Vec3(-0.03, 0.002, 0)), 0, 1e-12);
  EXPECT_NEAR(distance(tool, lying, Vec3(0.002, 0, 0)), 0, 1e-12);
}

TEST(HeldShape, OfAFlatEndGoesUpFromTheTip) {
  ToolSpec tool;
  tool.shape = ToolShape::cylinder;
  tool.radius = 0.004;
  tool.length = 0.02;
  EXPECT_NEAR(distance(tool, upright, Vec3(0.003, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(distance(tool, upright, Vec3(0.003, 0, 0.02)), 0, 1e-12);
  EXPECT_NEAR(distance(tool, lying, Vec3(0.02, 0, 0.003)), 0, 1e-12);
  tool.shape = ToolShape::cone;
  EXPECT_NEAR(distance(tool, upright, Vec3(0.002, 0, 0.01)), 0, 1e-12);
  tool.shape = ToolShape::box;
  tool.size = {0.01, 0.02, 0.03};
  tool.attitude = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(distance(tool, upright, Vec3(0.01, 0, 0.01)), 0, 1e-12)
      << "turned about z, its long side lies along x";
  EXPECT_NEAR(distance(tool, upright, Vec3(0, 0.005, 0.01)), 0, 1e-12);
  EXPECT_NEAR(distance(tool, upright, Vec3(0, 0, 0.03)), 0, 1e-12);
}

}  // namespace
}  // namespace palpate::physics
