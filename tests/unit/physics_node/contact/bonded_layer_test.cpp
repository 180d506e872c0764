#include "physics_node/contact/bonded_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

/// The same paper gives these numbers for tissue that keeps its volume.
TEST(BondedLayer, IsThatOfThePaper) {
  for (const double x : {0.0, 0.1, 0.3, 1.0}) {
    EXPECT_NEAR(bonded_layer(0.5, x), 1 + 1.133 * x + 1.283 * x * x + 0.769 * x * x * x, 2e-3) << x;
  }
  EXPECT_GT(bonded_layer(0.45, 0.3), bonded_layer(0.3, 0.3)) << "what cannot give way aside is stiffer";
  EXPECT_EQ(bonded_layer(0.45, 5), bonded_layer(0.45, 1));
}

/// Straight down from the middle of its top, whatever it is made of; aside from a corner nothing stands.
TEST(BondedLayer, IsAsThickAsTheWayToWhatIsHeld) {
  for (const char* model : {"springs", "fem"}) {
    test::Recipe recipe = test::pressed_slab_recipe();  // 20 mm
    recipe.body += std::string("\nmodel = \"") + model + "\"";
    const Body body = test::body_of(recipe);
    Index top = body.nodes().front();
    for (const Index node : body.nodes()) {
      const Vec3 at = body.rest_position(node), best = body.rest_position(top);
      if (at.z() - at.head<2>().norm() > best.z() - best.head<2>().norm()) top = node;
    }
    EXPECT_NEAR(thickness_below(body, top, Vec3::UnitZ()), 0.020, 1e-9) << model;
    EXPECT_NEAR(thickness_below(body, top, Vec3(0.1, 0, 1).normalized()), 0.020, 0.1 * 0.020);
    EXPECT_TRUE(std::isinf(thickness_below(body, top, -Vec3::UnitZ())));
    EXPECT_TRUE(std::isinf(thickness_below(body, top, Vec3::UnitX())));
    recipe.body = std::string("model = \"") + model + "\"";
    const Body free = test::body_of(recipe);
    EXPECT_TRUE(std::isinf(thickness_below(free, top, Vec3::UnitZ())));
  }
}

}  // namespace
}  // namespace palpate::physics
