#include "physics_node/contact/face_press.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

constexpr double top = 0.010;  // [m]

Recipe block(const std::string& body = "model = \"fem\"") {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(40, 40, 20);
  recipe.spacing_mm = 2.5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.body = body;
  return recipe;
}

/// A body at rest, and a shape over it.
struct Bench {
  explicit Bench(const RigidShape& shape, const Recipe& recipe = block())
      : moving(make_body_model(body_of(recipe), Precision::double_)),
        surface(*moving, 0.02),
        press(surface, *moving, shape) {
    for (std::uint32_t f = 0; f < surface.surface().facets.size(); ++f) facets.push_back(f);
  }
  bool at(const ShapePose& pose, double force, double dt = 1e-4) {
    press.list(pose, facets);
    return press.press(pose, force, dt);
  }
  std::unique_ptr<BodyModel> moving;
  Boundary surface;
  FacePress press;
  std::vector<std::uint32_t> facets;
};

Vec3 sum_of(std::span<const NodalForce> forces) {
  Vec3 sum = Vec3::Zero();
  for (const NodalForce& nodal : forces) sum += nodal.force;
  return sum;
}

TEST(FacePress, BearsTheForceAndItsMomentAboutTheMiddleOfASphere) {
  Bench bench(RigidShape::sphere(0.005));
  for (const Vec3& beside : {Vec3(0.0003, 0.0007, 0), Vec3(0.00125, 0, 0), Vec3(0.0042, -0.0031, 0)}) {
    const ShapePose pose = pose_along(Vec3(0, 0, top) + beside, Vec3::UnitZ());
    ASSERT_TRUE(bench.at(pose, 0.1, 1e-6));
    EXPECT_NEAR(sum_of(bench.press.forces()).z(), -0.1, 1e-12);
    const Vec3 centre = pose.tip + (0.005 - bench.press.depth()) * Vec3::UnitZ();
    Vec3 moment = Vec3::Zero();
    for (const NodalForce& nodal : bench.press.forces())
      moment += (bench.moving->position(nodal.cell) - centre).cross(nodal.force);
    EXPECT_LT(moment.norm(), 1e-4 * 0.1 * 0.005);
    bench.press.release();
  }
}

TEST(FacePress, SpreadsWhatIsMissingByThePressure) {
  Bench bench(RigidShape::sphere(0.005));
  ASSERT_TRUE(bench.at(pose_along({0.0003, 0.0007, top}, Vec3::UnitZ()), 0.1));
  const Vec3 whole(0.03, -0.02, -0.1);
  bench.press.spread(whole);
  EXPECT_LT((sum_of(bench.press.forces()) - whole).norm(), 1e-12);
}

/// Nodes of a whole cell around a place in the middle of a face bear a small tip there, alike.
TEST(FacePress, BearsATipBetweenNodesByTheCornersOfTheFace) {
  Bench bench(RigidShape::sphere(0.0005));
  ASSERT_TRUE(bench.at(pose_along({0.00125, 0.00125, top}, Vec3::UnitZ()), 0.01));
  ASSERT_EQ(bench.press.forces().size(), 4u);
  for (const NodalForce& nodal : bench.press.forces()) EXPECT_NEAR(nodal.force.z(), -0.0025, 1e-6);
}

TEST(FacePress, MeetsTheNearerWallOfACavityAlone) {
  Recipe recipe =
      block("model = \"fem\"\n[[body.cavity]]\nbox_min_mm = [-10, -10, 0]\nbox_max_mm = [10, 10, 5]");
  Bench bench(RigidShape::sphere(0.005), recipe);
  ASSERT_TRUE(bench.at(pose_along({0.001, 0.0005, top}, Vec3::UnitZ()), 0.05));
  EXPECT_LT(bench.press.depth(), 0.001);
  for (const NodalForce& nodal : bench.press.forces())
    EXPECT_GT(bench.moving->position(nodal.cell).z(), 0.9 * top);
}

/// However far above it begins, it comes down onto the surface.
TEST(FacePress, ComesFromOutside) {
  for (const double above : {-0.004, 0.0, 0.02}) {
    Bench bench(RigidShape::sphere(0.003));
    ASSERT_TRUE(bench.at(pose_along({0.001, 0.0005, top + above}, Vec3::UnitZ()), 1e-4)) << above;
    EXPECT_NEAR(bench.press.depth(), above, 0.0002) << above;
  }
}

/// Also between the middle of a coarse face and its corners.
TEST(FacePress, KnowsHowFarTheSurfaceIsBeforeItTouches) {
  Recipe coarse = block();
  coarse.spacing_mm = 5;
  Bench bench(RigidShape::sphere(0.003), coarse);
  for (const double x : {0.0, 0.0006, 0.00125, 0.0025})
    for (const double y : {0.0, 0.0009, 0.0025}) {
      bench.press.list(pose_along({x, y, top + 0.003}, Vec3::UnitZ()), bench.facets);
      EXPECT_NEAR(bench.press.depth(), 0.003, 0.00005) << x << " " << y;
      bench.press.release();
    }
}

TEST(FacePress, MeetsNothingBesideTheBody) {
  Bench bench(RigidShape::sphere(0.003));
  EXPECT_FALSE(bench.at(pose_along({0.03, 0, top}, Vec3::UnitZ()), 0.1));
  EXPECT_TRUE(bench.press.forces().empty());
}

/// However long a step is, nodes go hardly further than the shape in it.
TEST(FacePress, NeverPushesNodesBeyondTheShape) {
  for (const double dt : {1e-5, 1e-4, 1e-3}) {
    Bench bench(RigidShape::cylinder(0.008, 0.03));
    const ShapePose pose = pose_along({0.001, 0.0005, top}, Vec3::UnitZ());
    ASSERT_TRUE(bench.at(pose, 0.05, dt));
    bench.moving->kick(bench.press.forces(), dt);
    const double tip = pose.tip.z() - bench.press.depth();
    for (const NodalForce& nodal : bench.press.forces())
      EXPECT_GT(bench.moving->position(nodal.cell).z(), tip - 0.25 * (top - tip)) << dt;
  }
}

}  // namespace
}  // namespace palpate::physics
