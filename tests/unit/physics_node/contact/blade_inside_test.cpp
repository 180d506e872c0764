// What an edge sweeps inside bodies that it does not cut, by areas known from geometry.
#include "physics_node/contact/blade_inside.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/scene/scene.h"
#include "physics_node/report/run_warnings.h"
#include "physics_node/world.h"
#include "tests/support/physics/recorded_hand.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double length = 0.032;

Recipe sphere_of_elements(double radius_mm) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::sphere(radius_mm);
  recipe.spacing_mm = 2;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
  recipe.body = "model = \"fem\"";
  return recipe;
}

struct Inside {
  explicit Inside(const Recipe& recipe) : world(scene_of(recipe)) {
    bodies.push_back({&world.body(0), std::make_unique<Boundary>(world.body(0), 0.01)});
    inside = std::make_unique<BladeInside>(bodies, std::vector<std::size_t>{0}, length);
  }
  /// So slowly that a look is over before the next begins.
  void sweep(const Vec3& from, const Vec3& to) {
    constexpr int frames = 20000;
    for (int n = 0; n <= frames; ++n) {
      BladeFrame frame;
      frame.tip = from + (to - from) * n / frames;
      inside->follow(frame);
    }
  }
  double area() const { return inside->areas()[0]; }

  World world;
  std::vector<TouchableBody> bodies;
  std::unique_ptr<BladeInside> inside;
};

/// An edge along z that goes through the middle of a ball sweeps a disc.
TEST(BladeInside, CountsTheAreaOfASection) {
  Inside ball(sphere_of_elements(10));
  ball.sweep({0.02, 0, -length / 2}, {-0.02, 0, -length / 2});
  const double disc = std::numbers::pi * 0.010 * 0.010;
  EXPECT_NEAR(ball.area(), disc, 0.1 * disc) << "of cells of 2 mm, at places 2 mm apart";
  ball.inside->reset();
  EXPECT_EQ(ball.area(), 0);
  ball.sweep({0.02, 0.005, -length / 2}, {-0.02, 0.005, -length / 2});
  EXPECT_NEAR(ball.area(), 0.75 * disc, 0.1 * disc);
}

TEST(BladeInside, CountsNothingOutsideOrAlongItself) {
  Inside ball(sphere_of_elements(10));
  ball.sweep({0.02, 0.0115, -length / 2}, {-0.02, 0.0115, -length / 2});
  EXPECT_EQ(ball.area(), 0);
  ball.sweep({0, 0, 0.03}, {0, 0, -0.03});
  EXPECT_EQ(ball.area(), 0) << "a point sweeps no area";
  ball.inside->let_go();
  ball.sweep({0.02, 0, -length / 2}, {0.02, 0, -length / 2});
  EXPECT_EQ(ball.area(), 0);
}

TEST(BladeInside, FollowsABodyThatHasMoved) {
  Inside ball(sphere_of_elements(10));
  BodyModel& body = ball.world.body(0);
  for (const Index node : body.body().nodes()) body.place(node, Vec3(0, 0.05, 0), Vec3::Zero());
  ball.sweep({0.02, 0, -length / 2}, {-0.02, 0, -length / 2});
  EXPECT_EQ(ball.area(), 0);
  ball.inside->let_go();
  ball.sweep({0.02, 0.05, -length / 2}, {-0.02, 0.05, -length / 2});
  EXPECT_GT(ball.area(), 0.9 * std::numbers::pi * 0.010 * 0.010);
}

TEST(BladeInside, IsSaidInAWarning) {
  Recipe recipe = sphere_of_elements(10);
  recipe.world =
      "[[body]]\nname = \"other\"\nlattice = \"voxel\"\nmodel = \"fem\"\nshape = \"box\"\nsize_mm = [20, 20, "
      "4]\n"
      "spacing_mm = 2\nmaterial = \"m\"\nat_mm = [0, 0, 13]\n"
      "[[connection]]\nname = \"bed\"\nfrom = \"body\"\nto = \"other\"\nwithin_mm = 3\nmodulus_kPa = 1\n"
      "cut_toughness_J_per_m2 = 1\n"
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 20\nedge_deg = 0\ndevice = \"hand\"\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 30, 0, -25], [1, -30, 0, -25]]\n";
  World world(scene_of(recipe));
  std::uint64_t n = 1;
  const auto go = [&](int frames, double z) {
    for (int i = 0; i < frames; ++i, ++n) {
      const std::optional<ToolState> hand =
          recorded_hand([z](double t) { return Vec3(0.03 - 0.2 * t, 0, z); }, n);
      world.frame(std::span(&hand, 1));
    }
  };
  go(50, -0.025);
  EXPECT_TRUE(all_warnings(world).empty());
  go(200, -0.025);
  EXPECT_THAT(all_warnings(world),
              testing::ElementsAre(testing::AllOf(testing::HasSubstr("\"blade\" went through"),
                                                  testing::HasSubstr("mm^2 of \"body\""))));
  world.reset();
  EXPECT_TRUE(all_warnings(world).empty());
}

}  // namespace
}  // namespace palpate::physics::test
