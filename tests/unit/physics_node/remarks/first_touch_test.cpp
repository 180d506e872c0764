// The first touch of a path against closed forms: a flat face, a side, a rod, and paths that pass by.

#include "physics_node/remarks/first_touch.h"

#include <gtest/gtest.h>

#include <string>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

/// A held block of 60 x 60 x 30 mm round the origin.
std::string block_and(const std::string& tool, const std::string& waypoints, const std::string& more = "") {
  return R"(gravity_m_per_s2 = [0, 0, 0]
[material.soft]
density_kg_per_m3 = 1000
modulus_kPa = 10
[[body]]
name = "block"
lattice = "voxel"
model = "fem"
shape = "box"
size_mm = [60, 60, 30]
spacing_mm = 5
material = "soft"
fixed = ["-z"]
[[tool]]
name = "tip"
device = "hand"
)" + tool +
         "\n[device.hand]\ndriver = \"simulated\"\nwaypoints = " + waypoints + "\n" + more;
}

std::optional<FirstTouch> touch_of(const std::string& text) {
  const World world(parse_scene(text, "s.toml"));
  Bodies bodies;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) bodies.push_back(&world.body(b));
  EXPECT_TRUE(may_know_first_touch(world.scene(), bodies, world.scene().tools[0]));
  return first_touch(world.scene(), bodies, world.scene().tools[0]);
}

TEST(FirstTouch, IsWhereAPathGoesThroughAFace) {
  // z = 25 + (-13) t: at 15 after 10 / 13 s.
  const auto touch = touch_of(block_and("radius_mm = 8", "[[0, 3.1, -2.2, 25], [1, 3.1, -2.2, 12]]"));
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->t, 10.0 / 13, 1e-9);
  EXPECT_NEAR((touch->at - Vec3(0.0031, -0.0022, 0.015)).norm(), 0, 1e-9);
  EXPECT_EQ(touch->body, 0U);
}

TEST(FirstTouch, CountsFromTheRightPieceOfAPath) {
  const auto touch = touch_of(
      block_and("radius_mm = 8", "[[0.5, 50, 1, 25], [1.5, 50, 1, 1], [2, 50, 1, 1], [4, 10, 1, 1]]"));
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->t, 2 + 2 * 20.0 / 40, 1e-9);
  EXPECT_NEAR((touch->at - Vec3(0.030, 0.001, 0.001)).norm(), 0, 1e-9);
}

TEST(FirstTouch, IsNoneOfAPathThatPassesBy) {
  EXPECT_FALSE(touch_of(block_and("radius_mm = 8", "[[0, -50, 0, 15.2], [1, 50, 0, 15.2]]")));
  EXPECT_FALSE(touch_of(block_and("radius_mm = 8", "[[0, 0, 0, 90], [1, 0, 0, 16]]")));
}

/// Along an edge that two triangles share, and on a node: no gap lets it through.
TEST(FirstTouch, MissesNoSeam) {
  for (const char* at : {"0, 0", "2.5, 2.5", "5, 0", "-30, -30", "30, 12.5"}) {
    const std::string place(at);
    const auto touch =
        touch_of(block_and("radius_mm = 8", "[[0, " + place + ", 25], [1, " + place + ", 5]]"));
    ASSERT_TRUE(touch) << at;
    EXPECT_NEAR(touch->t, 0.5, 1e-6) << at;
  }
}

/// A rod of radius 4 mm lies along y and comes down: its side touches first, where its axis is a radius above.
TEST(FirstTouch, OfARodIsThatOfItsSide) {
  const auto touch =
      touch_of(block_and("shape = \"stick\"\nradius_mm = 4\nlength_mm = 40\ntheta_deg = [0, 0, 90]",
                         "[[0, 0, -20, 29], [1, 0, -20, 9]]"));
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->t, 0.5, 0.02);
}

/// Where another hand has led it by then is not its place at rest.
TEST(FirstTouch, IsNotThatOfAnotherTool) {
  const auto touch = touch_of(block_and("radius_mm = 8", "[[0, 0, 0, 80], [1, 0, 0, 5]]", R"(
[[tool]]
name = "knife"
shape = "knife"
device = "other"
material = "soft"
spacing_mm = 4
length_mm = 24
height_mm = 16
at_mm = [-12, 0, 40]
[device.other]
driver = "simulated"
waypoints = [[0, -12, 0, 40], [1, -12, 0, 45]]
)"));
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->body, 0U);
  EXPECT_NEAR(touch->t, 65.0 / 75, 1e-6);
}

TEST(FirstTouch, IsNotKnownOfWhatFliesOrTurns) {
  const std::string down = "[[0, 0, 0, 25], [1, 0, 0, 12]]";
  for (const std::string& text :
       {block_and("radius_mm = 8", down, "attitudes_deg = [[0, 0, 0, 0], [1, 0, 0, 30]]"),
        block_and("radius_mm = 8", down).replace(0, 29, "gravity_m_per_s2 = [0, 0, -9]\n")}) {
    std::string loose = text;
    if (loose.find("attitudes") == std::string::npos) loose.erase(loose.find("fixed"), 14);
    const World world(parse_scene(loose, "s.toml"));
    EXPECT_FALSE(may_know_first_touch(world.scene(), {&world.body(0)}, world.scene().tools[0]));
  }
}

}  // namespace
}  // namespace palpate::physics
