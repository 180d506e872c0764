// Closed surfaces of springs, through the door of a scene: conservation, the ledger, contact, a tip, and what they
// refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/scene.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/world.h"
#include "tests/support/physics/mesh_worlds.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics::test {
namespace {

using testing::HasSubstr;

/// A filled bag round a box of cells of 5 mm.
Recipe bag(const std::array<int, 3>& cells, const std::string& keys = "content_modulus_kPa = 20\n") {
  Recipe recipe = mesh_box(cells, 0.005, "plain", 0);
  const std::string elements = "elements = \"plain\"\n";
  recipe.shape.replace(recipe.shape.find(elements), elements.size(),
                       "model = \"surface\"\nthickness_mm = 2\n" + keys);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 50";
  return recipe;
}

TEST(Surface, HasTheOuterNodesAlone) {
  const World world(scene_of(bag({4, 3, 3})));
  EXPECT_EQ(world.body(0).body().n_nodes(), 5 * 4 * 4 - 3 * 2 * 2);
  EXPECT_TRUE(is_surface_of_springs(world.body(0).body()));
  EXPECT_FALSE(is_of_finite_elements(world.body(0).body()));
}

TEST(Surface, InFreeFlightKeepsItsMomenta) {
  World world(scene_of(bag({4, 3, 3})));
  Dice dice(3);
  const Vec3 flight(0.3, -0.2, 0.5), spin(3, -2, 5);
  BodyModel& body = world.body(0);
  for (const Index node : body.body().nodes())
    body.place(node, dice.within(3e-5),
               flight + spin.cross(body.body().rest_position(node)) + dice.within(0.005));
  world.restart_ledger();
  const Momenta before = body.momenta();
  for (int n = 0; n < 300; ++n) world.frame({});
  const Momenta after = body.momenta();
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular.norm());
  EXPECT_LT(world.ledger().balance_error(), 1e-3);
  EXPECT_EQ(world.report().restored, 0);
}

TEST(Surface, OfTheFloorKeepsItsBooks) {
  for (const char* material : {"", "\nviscosity_Pa_s = 5\ndrag_N_s_per_m = 1e-4"}) {
    Recipe recipe = bag({4, 4, 4});
    recipe.material += material;
    recipe.body = "velocity_m_per_s = [0, 0, -0.5]";
    recipe.gravity = "[0, 0, -9.81]";
    recipe.physics =
        "safety = 0.4";  // undamped 4 % at 0.9: the step is short by the bound, and the trapezoid errs by its square
    recipe.world = floor_at(-15);
    World world(scene_of(recipe));
    double up = -HUGE_VAL, down = 0;
    for (int n = 0; n < 120; ++n) {
      world.frame({});
      up = std::max(up, world.body(0).momenta().linear.z());
      down = std::min(down, world.body(0).momenta().linear.z());
    }
    EXPECT_GT(up, -0.1 * down) << "comes back up";
    EXPECT_LT(up, -down);
    EXPECT_LT(world.ledger().balance_error(), 0.01) << material;
    EXPECT_LT(world.watched_ledger().balance_error(), 0.01) << material;
    EXPECT_EQ(world.report().restored, 0);
    const MomentumBalance balance = world.body(0).momentum_balance();
    if (*material == 0) {
      EXPECT_LT(balance.missing.linear.norm(), 1e-12 * balance.linear);
    }
  }
}

/// A bag that its pressure sets swinging, and nothing else: what it turns over is what that gives.
TEST(Surface, SwingsUnderItsPressureAlone) {
  for (const char* precision : {"single", "double"}) {
    Recipe recipe = bag({4, 4, 4}, "pressure_kPa = 0.5\n");
    recipe.precision = precision;
    World world(scene_of(recipe));
    double least = HUGE_VAL, most = 0;
    for (int n = 0; n < 300; ++n) {
      world.frame({});
      const EnergyLedger ledger = world.ledger();
      least = std::min(least, ledger.elastic), most = std::max(most, ledger.kinetic);
    }
    EXPECT_EQ(world.report().restored, 0) << precision;
    EXPECT_FALSE(world.has_stopped());
    EXPECT_GT(most, 1e-6) << "it swings";
    EXPECT_GE(least, 0);
    EXPECT_LT(world.ledger().balance_error(), 0.05) << "undamped, at the longest step";
  }
}

/// Until it slides off, as nothing rubs.
TEST(Surface, BearsACubeThatFallsOnIt) {
  Recipe recipe = bag({6, 6, 3}, "pressure_kPa = 1\ncontent_modulus_kPa = 20\n");
  recipe.material += "\nviscosity_Pa_s = 5\ndrag_N_s_per_m = 1e-3";
  recipe.body = "fixed = [\"-z\"]";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world =
      "[contact]\ncount_passages = true\n[material.soft]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = "
      "20\nviscosity_Pa_s = 20\n[[body]]\nname = \"cube\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm "
      "= "
      "5\nmaterial = \"soft\"\nshape = \"box\"\nsize_mm = [15, 15, 15]\nat_mm = [0, 0, 20]\n";
  World world(scene_of(recipe));
  const BodyModel& cube = world.body(1);
  double lowest = HUGE_VAL, speed = 0;
  for (int n = 0; n < 250; ++n) {
    world.frame({});
    for (const Index node : cube.body().nodes()) lowest = std::min(lowest, cube.position(node).z());
    if (n > 150) speed = std::max(speed, cube.momenta().linear.norm() / 3.375e-3);
  }
  EXPECT_GT(lowest, 0.003) << "of a bag that is 7.5 mm high";
  EXPECT_LT(lowest, 0.010) << "it has fallen on it";
  EXPECT_LT(speed, 0.1) << "free fall would be 2 m/s by then";
  EXPECT_EQ(world.collisions()->tally().passages, 0);
  EXPECT_GT(world.collisions()->tally().collisions, 0);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.ledger().balance_error(), 0.02);
}

TEST(Surface, FeltByPlanesIsRemarkedOn) {
  Recipe recipe = bag({4, 4, 4});
  recipe.body = "fixed = [\"-z\"]";
  recipe.world = point_tool(5);
  EXPECT_THAT(remarks_about(World(scene_of(recipe))),
              testing::Contains(HasSubstr("feels planes, which shake on a surface of springs")));
  const std::string planes = "\"norton\"";
  recipe.world.replace(recipe.world.find(planes), planes.size(), "\"tissue\"");
  EXPECT_THAT(remarks_about(World(scene_of(recipe))), testing::Not(testing::Contains(HasSubstr("planes"))));
}

TEST(Surface, IsRefusedWhatItDoesNotFollow) {
  const auto complaint = [](const Recipe& recipe) -> std::string {
    try {
      World world(scene_of(recipe));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  Recipe cut = bag({4, 3, 3});
  cut.world =
      "[[tool]]\nname = \"blade\"\nshape = \"scalpel\"\nlength_mm = 9\ndevice = \"d\"\n[device.d]\ndriver = "
      "\"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
  EXPECT_THAT(complaint(cut), HasSubstr("needs to know how tough"));
}

}  // namespace
}  // namespace palpate::physics::test
