#include "physics_node/contact/point_tool.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

TEST(PointTool, CarriesASteadyForceIntoTheMasses) {
  World world(pressed_slab());
  const auto hand = steady_hand({0, 0, 1.5});
  run(world, hand, 700);
  const Tool& tool = world.tool(0);
  EXPECT_LT((tool.force() - Vec3(0, 0, 1.5)).norm(), 1e-6);
  EXPECT_LT((total(forces_of_tool(world)) + Vec3(0, 0, 1.5)).norm(), 1e-6);
  EXPECT_GT(forces_of_tool(world).size(), 4u);
}

TEST(PointTool, LetsGoWhenTheHandFallsSilent) {
  World world(pressed_slab());
  run(world, steady_hand({0, 0, 1.5}), 1000);
  run(world, std::nullopt, 100);
  const double fading = world.tool(0).force().norm();
  EXPECT_LT(fading, 0.1);
  EXPECT_GT(fading, 0);
  run(world, std::nullopt, 1000);
  EXPECT_EQ(world.tool(0).force(), Vec3(Vec3::Zero()));
  EXPECT_TRUE(forces_of_tool(world).empty());
}

TEST(PointTool, IgnoresTheForceOfAHandThatIsNotEngaged) {
  World world(pressed_slab());
  auto hand = steady_hand({0, 0, 1.5});
  hand->engaged = 0;
  run(world, hand, 500);
  EXPECT_EQ(world.tool(0).force(), Vec3(Vec3::Zero()));
}

TEST(PointTool, OffersThePlaneWhereItWouldBeWithoutTheForce) {
  World world(pressed_slab());
  run(world, steady_hand({0, 0, 1.0}), 1000);
  ContactPatch patch;
  world.tool(0).write_patch(patch, 77, 5);
  ASSERT_GT(patch.n_facets, 0u);
  EXPECT_EQ(patch.tick, 77u);
  EXPECT_EQ(patch.answers, 9u);
  const PatchFacet& facet = patch.facets[0];
  const double surface_now = (facet.corners[0][2] + facet.corners[1][2] + facet.corners[2][2]) / 3;
  EXPECT_LT(surface_now, slab_top - 0.0008) << "the tissue must give, or this shows nothing";
  EXPECT_NEAR(facet.point[2], slab_top, 1e-6);
  EXPECT_GT(facet.stiffness, 0);
}

/// Facets beside the tip lean toward it in its dimple; what they lean by is the tissue's own answer, which must not come back.
TEST(PointTool, OffersTheNormalThatHeldTissueHasAtRest) {
  World world(pressed_slab());
  run(world, steady_hand({0, 0, 1.5}), 1000);
  ContactPatch patch;
  world.tool(0).write_patch(patch, 1, 1);
  ASSERT_GT(patch.n_facets, 4u);
  double leans_most = 0;
  for (std::uint32_t f = 0; f < patch.n_facets; ++f) {
    const auto& c = patch.facets[f].corners;
    const Vec3 area = (vec(c[1]) - vec(c[0])).cross(vec(c[2]) - vec(c[0]));
    leans_most = std::max(leans_most, area.head<2>().norm() / area.norm());
    EXPECT_LT((vec(patch.facets[f].normal) - Vec3::UnitZ()).norm(), 1e-12) << "facet " << f;
  }
  EXPECT_GT(leans_most, 0.1) << "the tissue must lean, or this shows nothing";
}

/// Tissue that has sagged under its weight is felt where it lies, not where it would without weight; pressed or not.
TEST(PointTool, OffersThePlaneWhereTissueHasSaggedTo) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(80, 80, 60);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 4\nviscosity_Pa_s = 2";
  recipe.body = "model = \"fem\"\nfixed = [\"-z\"]\nstart = \"balanced\"";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world = point_tool(8);
  World world(scene_of(recipe));
  ContactPatch patch;
  auto hand = steady_hand({0, 0, 0});
  hand->p_WT = hand->proxy = {0, 0, 0.027};
  run(world, hand, 3);
  world.tool(0).write_patch(patch, 1, 1);
  ASSERT_GT(patch.n_facets, 0u);
  const PatchFacet& facet = patch.facets[0];
  const double lies = (facet.corners[0][2] + facet.corners[1][2] + facet.corners[2][2]) / 3;
  EXPECT_LT(lies, 0.028) << "it must sag, or this shows nothing";
  EXPECT_NEAR(facet.point[2], lies, 1e-4);
  hand->force_on_hand = {0, 0, 0.15};
  run(world, hand, 500);
  world.tool(0).write_patch(patch, 2, 2);
  EXPECT_LT(
      (patch.facets[0].corners[0][2] + patch.facets[0].corners[1][2] + patch.facets[0].corners[2][2]) / 3,
      lies - 5e-4);
  EXPECT_NEAR(patch.facets[0].point[2], lies, 2e-4);
}

/// Frames of 50 ms of a force that grows: the displacement of a frame's beginning belongs to the force of the last frame.
TEST(PointTool, LearnsTheSameStiffnessFromAForceThatGrowsAsFromOneThatStands) {
  Scene scene = pressed_slab();
  scene.physics->frame_Hz = 20;
  World world(scene);
  ContactPatch patch;
  double most = 0;
  for (int frame = 1; frame <= 60; ++frame) {
    run(world, steady_hand({0, 0, std::min(0.4, 0.002 * std::pow(1.5, frame))}), 1);
    world.tool(0).write_patch(patch, 1, 1);
    most = std::max(most, patch.facets[0].stiffness);
  }
  EXPECT_LT(most, 1.1 * patch.facets[0].stiffness);
}

TEST(PointTool, TellsForceAndMomentAboutTheSetPoint) {
  World world(pressed_slab());
  auto hand = steady_hand({0, 0, 1.0});
  hand->p_WT = {0.01, 0.02, slab_top};
  run(world, hand, 700);
  ToolWrench wrench;
  world.tool(0).write_wrench(wrench, 1, 2, 3.0);
  EXPECT_NEAR(wrench.force[2], 1.0, 1e-6);
  EXPECT_NEAR(wrench.moment[0], 0.02, 1e-6);   // y F_z
  EXPECT_NEAR(wrench.moment[1], -0.01, 1e-6);  // - x F_z
  EXPECT_GT(wrench.n_contacts, 0u);
}

TEST(PointTool, PressesNoFacesWithBackwardEuler) {
  Recipe recipe = pressed_slab_recipe();
  recipe.world.insert(recipe.world.find("device"), "contact = \"faces\"\n");
  World presses(scene_of(recipe));
  recipe.physics = "integrator = \"backward_euler\"";
  try {
    World world(scene_of(recipe));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("contact = \"nodes\""), std::string::npos) << error.what();
  }
}

TEST(PointTool, IsFreeBeforeTheHandIsSeen) {
  World world(pressed_slab());
  run(world, std::nullopt, 10);
  ContactPatch patch;
  world.tool(0).write_patch(patch, 1, 1);
  EXPECT_EQ(patch.n_facets, 0u);
  EXPECT_EQ(patch.answers, 0u);
}

/// The upper two layers are torn away at once: the patch of the next frame but one offers what lies beneath, and the force of the
/// hand is borne there.
TEST(PointTool, OffersWhatHasOpened) {
  Recipe recipe = pressed_slab_recipe();
  recipe.material += "\nyield_ratio = 1.3\nbreak_ratio = 1.5";
  World world(scene_of(recipe));
  run(world, steady_hand({0, 0, 0.01}), 20);
  ContactPatch patch;
  world.tool(0).write_patch(patch, 1, 1);
  ASSERT_GT(patch.n_facets, 4u);
  EXPECT_NEAR(patch.facets[0].corners[0][2], slab_top, 0.0005);
  ASSERT_EQ(world.report().broken, 0);

  const Lattice& lattice = world.body(0).body().lattice;
  std::vector<Index> torn;
  for (const Index mass : lattice.masses)
    if (lattice.rest_position(mass).z() > slab_top - 0.006) torn.push_back(mass);
  double far = 0;
  for (const Index mass : torn) world.body(0).place(mass, Vec3(1 + far++, 0, 1), Vec3::Zero());
  run(world, steady_hand({0, 0, 0.01}), 2);
  ASSERT_GT(world.report().broken, 100);
  world.tool(0).write_patch(patch, 2, 1);
  ASSERT_GT(patch.n_facets, 4u);
  for (std::uint32_t f = 0; f < patch.n_facets; ++f)
    for (const Array3& corner : patch.facets[f].corners) EXPECT_LT(corner[2], slab_top - 0.006) << f;
  EXPECT_GT(patch.facets[0].normal[2], 0.9);
  ASSERT_FALSE(forces_of_tool(world).empty());
  for (const NodalForce& nodal : forces_of_tool(world))
    EXPECT_EQ(std::count(torn.begin(), torn.end(), nodal.cell), 0) << "crumbs bear nothing";
  EXPECT_NEAR(total(forces_of_tool(world)).z(), -world.tool(0).force().z(), 1e-9);

  world.reset();
  run(world, steady_hand({0, 0, 0.01}), 2);
  world.tool(0).write_patch(patch, 3, 1);
  ASSERT_GT(patch.n_facets, 4u);
  EXPECT_NEAR(patch.facets[0].corners[0][2], slab_top, 0.0005);
}

TEST(PointTool, PressesAfterAResetAsItDidAtFirst) {
  World world(pressed_slab());
  const auto press = [&world] {
    run(world, steady_hand({0, 0, 1.5}), 150);
    ContactPatch patch;
    world.tool(0).write_patch(patch, 1, 1);
    EXPECT_GT(patch.n_facets, 0u);
    return std::make_tuple(world.state_hash(), world.tool(0).force(), patch.facets[0].stiffness);
  };
  const auto first = press();
  world.reset();
  EXPECT_EQ(world.tool(0).force(), Vec3(Vec3::Zero()));
  EXPECT_TRUE(forces_of_tool(world).empty());
  EXPECT_EQ(press(), first);
}

}  // namespace
}  // namespace palpate::physics
