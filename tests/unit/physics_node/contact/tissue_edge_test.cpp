// A ball at the edge of a block, on a thin plate, in a corner, in the seam of two bodies: it is pressed the way it is
// pushed, and no way round gives energy.

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "tests/support/physics/palpated_slab.h"
#include "tests/support/physics/recorded_hand.h"

namespace palpate::physics::test {
namespace {

constexpr double edge = 0.024;  // x of the side of the slab [m]

Recipe slab(const std::string& keys = "") { return palpated_by("radius_mm = 4\n" + keys); }

/// Through these points at a steady pace, after 50 ms at the first.
std::function<Vec3(double)> through(const std::vector<Vec3>& points, double speed) {
  return [=](double t) {
    double left = speed * std::max(0.0, t - 0.05);
    for (std::size_t n = 1; n < points.size(); ++n) {
      const double length = (points[n] - points[n - 1]).norm();
      if (left <= length) return Vec3(points[n - 1] + left / length * (points[n] - points[n - 1]));
      left -= length;
    }
    return points.back();
  };
}

struct Course {
  Vec3 last = Vec3::Zero();  // force on the tool [N]
  double most = 0;           // [N]
  double most_step = 0;      // of the force from frame to frame [N]
  double given = 0;          // work of the hand on the tool [J]
};

/// @param each  is shown the force after each frame
Course follow(World& world, const std::function<Vec3(double)>& path, double seconds,
              const std::function<void(const Vec3&, const Vec3&)>& each = {}) {
  Course course;
  Vec3 before = path(1e-3);
  for (std::uint64_t n = 1; n <= static_cast<std::uint64_t>(1e3 * seconds); ++n) {
    const std::optional<ToolState> hand = recorded_hand(path, n);
    world.frame(std::span(&hand, 1));
    const Vec3 now = path(1e-3 * static_cast<double>(n));
    const Vec3 force = world.tool(0).borne();
    course.given -= 0.5 * (force + course.last).dot(now - before);
    course.most_step = std::max(course.most_step, (force - course.last).norm());
    course.most = std::max(course.most, force.norm());
    course.last = force, before = now;
    if (each) each(now, force);
  }
  return course;
}

TEST(TissueEdge, IsPressedStraightOnAFlatFaceHoweverNearTheEdge) {
  for (const double inside : {6e-3, 3e-3, 1.5e-3}) {
    World world(scene_of(slab()));
    const Vec3 above(edge - inside, 0, slab_top + 1e-3), in(edge - inside, 0, slab_top - 1e-3);
    const Course course = follow(world, through({above, in}, 0.02), 0.6);
    ASSERT_GT(course.last.z(), 0.03) << inside;
    // Beside the edge tissue gives way to the side, and a ball leans after it: by so much, not by half a right angle.
    EXPECT_LT(std::abs(course.last.x()), 0.15 * course.last.z()) << inside;
    EXPECT_LT(std::abs(course.last.y()), 0.02 * course.last.z()) << inside;
  }
}

TEST(TissueEdge, NeverPressesHarderThanItsSpring) {
  World world(scene_of(slab()));
  const Vec3 above(edge - 2e-3, 0.0005, slab_top + 2e-3), in(edge - 2e-3, 0.0005, slab_top - 1.5e-3),
      beside(edge + 8e-3, 0.0005, slab_top - 1.5e-3);
  follow(world, through({above, in, beside}, 0.05), 0.5, [&](const Vec3& x, const Vec3& force) {
    // From the hand to the block as it was: no farther than down to the face, or out of its side.
    const double deep = std::min(slab_top - x.z(), edge - x.x() + 4e-3);
    EXPECT_LE(force.norm(), 500 * std::max(0.0, deep) * 1.5 + 0.02);
  });
}

TEST(TissueEdge, GivesNoEnergyOnLoopsOverIt) {
  for (const char* friction : {"", "friction = 0.3"})
    for (const bool outward : {true, false}) {
      World world(scene_of(slab(friction)));
      Vec3 a(edge - 6e-3, 0.0005, slab_top - 1.5e-3), b(edge + 7e-3, 0.0005, slab_top - 1.5e-3);
      if (!outward) std::swap(a, b);
      // Higher than a radius: a ball that has come round the edge may lie beside the tip.
      const Vec3 over_a = a + Vec3(0, 0, 7e-3), over_b = b + Vec3(0, 0, 7e-3);
      const Course course = follow(world, through({over_a, a, b, over_b, over_a, a, b, over_b}, 0.05), 1.5);
      EXPECT_GT(course.most, 0.05);
      EXPECT_GT(course.given, -2e-6) << friction << " outward: " << outward;
      EXPECT_EQ(course.last, Vec3(Vec3::Zero()));
    }
}

/// Deeper than the plate is thick: it stays on the side that it came from.
TEST(TissueEdge, StaysOnItsSideOfAThinPlate) {
  Recipe recipe = slab();
  recipe.shape = Recipe::box(48, 48, 8);
  recipe.body = "fixed = [\"-x\", \"+x\"]\nmodel = \"fem\"";
  World world(scene_of(recipe));
  const Vec3 above(0, 0.0005, 0.006), through_it(0, 0.0005, -0.012);
  bool touched = false;
  const Course course =
      follow(world, through({above, through_it, above}, 0.06), 0.7, [&](const Vec3&, const Vec3& force) {
        touched = touched || force.z() > 0.05;
        EXPECT_GE(force.z(), 0);
        EXPECT_LT(force.head<2>().norm(), 0.2 * force.z() + 0.01);
      });
  EXPECT_TRUE(touched);
  EXPECT_LT(course.most_step, 0.05);
  EXPECT_GT(course.given, -2e-6);
}

/// Where a wall stands on a floor, x = 0 and z = 0, both of one body: wherever a ball comes from, both press it.
TEST(TissueEdge, IsPressedByBothWallsOfACorner) {
  for (const Vec3& from : {Vec3(6e-3, 0, 6e-3), Vec3(6e-3, 0, 4e-3), Vec3(4e-3, 0, 6e-3)}) {
    Recipe recipe = slab();
    recipe.shape = Recipe::box(48, 48, 40);
    recipe.world =
        "[[body.cavity]]\nbox_min_mm = [0, -100, 0]\nbox_max_mm = [100, 100, 100]\n" + recipe.world;
    World world(scene_of(recipe));
    const Course course = follow(world, through({from, Vec3(-1e-3, 0, -1e-3)}, 0.02), 0.8);
    EXPECT_GT(course.last.x(), 0.05) << from.transpose();
    EXPECT_GT(course.last.z(), 0.05) << from.transpose();
    EXPECT_NEAR(course.last.x() / course.last.z(), 1, 0.5) << from.transpose();
    EXPECT_LT(course.most_step, 0.05);
  }
}

/// From one body to another that lies beside it.
TEST(TissueEdge, GoesOverASeamWithoutABlow) {
  Recipe recipe = slab();
  recipe.body += "\nat_mm = [-24.1, 0, 0]";
  recipe.world =
      "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 4\nshape = "
      "\"box\"\nsize_mm = [48, 48, 20]\n"
      "at_mm = [24.1, 0, 0]\nfixed = [\"-z\"]\nmaterial = \"m\"\n" +
      recipe.world;
  World world(scene_of(recipe));
  const Vec3 above(-8e-3, 0.0005, slab_top + 2e-3), in(-8e-3, 0.0005, slab_top - 1.5e-3),
      out(8e-3, 0.0005, slab_top - 1.5e-3);
  const Course course = follow(world, through({above, in, out}, 0.03), 1.2);
  EXPECT_GT(course.last.z(), 0.1);
  EXPECT_LT(course.most_step, 0.05);
  EXPECT_LT(course.most, 1.3 * course.last.z());
}

}  // namespace
}  // namespace palpate::physics::test
