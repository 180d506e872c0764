#include "physics_node/contact/rigid_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Dice;

struct Named {
  const char* name;
  RigidShape shape;
};
std::vector<Named> all_shapes() {
  return {{"sphere", RigidShape::sphere(0.8)},
          {"capsule", RigidShape::capsule(0.5, 2)},
          {"cylinder", RigidShape::cylinder(0.7, 1.5)},
          {"cone", RigidShape::cone(0.6, 1.4)},
          {"box", RigidShape::box({0.5, 0.8, 0.6})}};
}

/// Points on its surface, found from the sign alone: where segments from a point inside leave it.
std::vector<Vec3> surface_of(const RigidShape& shape, Dice& dice, int n) {
  std::vector<Vec3> points;
  const Vec3 middle = shape.bounds().center();
  while (static_cast<int>(points.size()) < n) {
    const Vec3 way = 4 * dice.within(1).normalized();
    double in = 0, out = 1;
    for (int half = 0; half < 50; ++half) {
      const double t = 0.5 * (in + out);
      (shape.distance(middle + t * way).distance < 0 ? in : out) = t;
    }
    points.push_back(middle + in * way);
  }
  return points;
}

TEST(RigidShape, HasTheDistanceToTheNearestPointOfItsSurface) {
  for (const auto& [name, shape] : all_shapes()) {
    Dice dice(7);
    const std::vector<Vec3> surface = surface_of(shape, dice, 20000);
    for (int n = 0; n < 300; ++n) {
      const Vec3 p = shape.bounds().center() + dice.within(1.5);
      const auto [distance, outward] = shape.distance(p);
      double least = 1e9;
      for (const Vec3& q : surface) least = std::min(least, (p - q).norm());
      EXPECT_LE(std::abs(distance), least + 1e-9) << name << " " << p.transpose();
      EXPECT_GE(std::abs(distance), least - 0.06) << name << " " << p.transpose();  // between points of it
      EXPECT_NEAR(shape.distance(p - distance * outward).distance, 0, 1e-12) << name << " " << p.transpose();
    }
  }
}

TEST(RigidShape, TellsTheGradientOfItsDistance) {
  for (const auto& [name, shape] : all_shapes()) {
    Dice dice(3);
    int kinks = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vec3 p = shape.bounds().center() + dice.within(1.5);
      const Vec3 outward = shape.distance(p).outward;
      EXPECT_NEAR(outward.norm(), 1, 1e-12);
      constexpr double step = 1e-6;
      Vec3 slope;
      for (int a = 0; a < 3; ++a)
        slope[a] = (shape.distance(p + step * Vec3::Unit(a)).distance -
                    shape.distance(p - step * Vec3::Unit(a)).distance) /
                   (2 * step);
      if ((slope - outward).norm() > 1e-4) ++kinks;  // as near as that to where two ways out are equally long
    }
    EXPECT_LE(kinks, 2) << name;
  }
}

TEST(RigidShape, BeginsInItsTipAndStaysInItsBounds) {
  for (const auto& [name, shape] : all_shapes()) {
    EXPECT_NEAR(shape.distance(Vec3::Zero()).distance, 0, 1e-15) << name;
    EXPECT_GT(shape.distance(-1e-6 * Vec3::UnitZ()).distance, 0.9e-6) << name;
    const Eigen::AlignedBox3d box = shape.bounds();
    Dice dice(5);
    Eigen::AlignedBox3d seen;
    for (const Vec3& p : surface_of(shape, dice, 5000)) seen.extend(p);
    EXPECT_TRUE(box.contains(
        Eigen::AlignedBox3d(seen.min() + Vec3::Constant(1e-9), seen.max() - Vec3::Constant(1e-9))))
        << name;
    EXPECT_LT((box.sizes() - seen.sizes()).maxCoeff(), 0.1) << name;
  }
}

TEST(RigidShape, OfASphereAndACylinderIsTheirClosedForm) {
  const RigidShape sphere = RigidShape::sphere(2), cylinder = RigidShape::cylinder(1, 3);
  EXPECT_DOUBLE_EQ(sphere.distance({3, 4, 2}).distance, 3);
  EXPECT_DOUBLE_EQ(sphere.distance({0, 0, 1}).distance, -1);
  EXPECT_DOUBLE_EQ(cylinder.distance({4, 0, -4}).distance, 5);
  EXPECT_DOUBLE_EQ(cylinder.distance({0, 0.5, 0.2}).distance, -0.2);
  EXPECT_DOUBLE_EQ(cylinder.distance({0, 0.9, 1}).distance, 0.9 - 1);
}

}  // namespace
}  // namespace palpate::physics
