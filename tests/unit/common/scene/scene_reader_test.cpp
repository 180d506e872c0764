// What a right scene becomes: SI values, defaults, places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/record_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

using test::complaints_about;
using test::full_scene;
using test::least_scene;
using test::parsed;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;
using testing::Pair;

TEST(SceneReader, ReadsTheWorldAndTheStepInSI) {
  const auto scene = parsed(full_scene);
  EXPECT_EQ(scene.title, "Every key");
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_EQ(scene.gravity, Vec3(0, 0.5, -9.81));
  EXPECT_EQ(scene.physics->integrator, Integrator::velocity_verlet);
  EXPECT_THAT(scene.physics->step, Optional(testing::DoubleEq(0.25e-3)));
  EXPECT_EQ(scene.physics->safety, 0.5);
  EXPECT_EQ(scene.physics->precision, Precision::double_);
  EXPECT_EQ(scene.physics->threads, 2);
  EXPECT_EQ(scene.physics->frame_Hz, 500);
  ASSERT_TRUE(scene.floor);
  EXPECT_DOUBLE_EQ(scene.floor->height, -0.05);
  EXPECT_FALSE(scene.contact->enabled);
  EXPECT_EQ(scene.contact->distance, ContactDistance::paper);
}

TEST(SceneReader, ReadsATissueAndThePapersConstants) {
  const auto scene = parsed(full_scene);
  const auto& skin = scene.material("skin");
  EXPECT_THAT(skin.density, Optional(1060.0));
  EXPECT_THAT(skin.modulus, Optional(20e3));
  EXPECT_EQ(skin.k2_ratio, 0.5);
  EXPECT_THAT(skin.viscosity_bulk, Optional(150.0));
  EXPECT_FALSE(skin.mass || skin.k1 || skin.viscosity || skin.yield_ratio || skin.break_ratio);
  const auto& clay = scene.material("clay");
  EXPECT_THAT(clay.mass, Optional(testing::DoubleEq(2e-3)));
  EXPECT_THAT(clay.k1, Optional(800.0));
  EXPECT_EQ(clay.k2_ratio, 1.0);
  EXPECT_THAT(clay.viscosity, Optional(0.5));
  EXPECT_THAT(clay.yield_ratio, Optional(1.2));
  EXPECT_THAT(clay.break_ratio, Optional(1.5));
  EXPECT_FALSE(clay.density || clay.modulus || clay.viscosity_bulk);
}

TEST(SceneReader, ReadsAVolumeFromTheFolderOfTheScene) {
  const auto scene = parsed(full_scene);
  ASSERT_EQ(scene.bodies.size(), 4u);
  const auto& head = scene.bodies[0];
  EXPECT_EQ(head.lattice, LatticeKind::voxel);
  EXPECT_FALSE(head.spacing);
  EXPECT_EQ(head.place.line, 26);
  const auto& volume = std::get<VolumeShape>(head.shape);
  EXPECT_EQ(volume.file, test::scene_folder() + "/scan.h5");
  EXPECT_EQ(volume.keep_min, -200);
  EXPECT_EQ(volume.keep_max, 3071);
  EXPECT_THAT(volume.partition, Optional(ElementsAre(120, 120, 70)));
  EXPECT_FALSE(volume.deformable.all);
  EXPECT_THAT(volume.deformable.center_voxel, ElementsAre(60, 20, 35));
  EXPECT_EQ(volume.deformable.radius_voxels, 12);
  EXPECT_TRUE(volume.largest_component);
}

TEST(SceneReader, ReadsSpheresBoxesAndTubes) {
  const auto scene = parsed(full_scene);
  const auto& ball = scene.bodies.at(1);
  EXPECT_DOUBLE_EQ(std::get<SphereShape>(ball.shape).radius, 0.02);
  EXPECT_EQ(ball.lattice, LatticeKind::fcc);
  EXPECT_THAT(ball.spacing, Optional(testing::DoubleEq(4e-3)));
  EXPECT_TRUE(ball.at.isApprox(Vec3(0, 0, 0.1)));
  EXPECT_EQ(ball.velocity, Vec3(1, 0, -2));
  EXPECT_THAT(ball.fixed_faces, ElementsAre(false, true, false, false, true, false));
  ASSERT_EQ(ball.fixed_boxes.size(), 1u);
  EXPECT_TRUE(ball.fixed_boxes[0].min.isApprox(Vec3(-1e-3, -2e-3, -3e-3)));
  EXPECT_TRUE(ball.fixed_boxes[0].max.isApprox(Vec3(1e-3, 2e-3, 3e-3)));
  EXPECT_TRUE(std::get<BoxShape>(scene.bodies.at(2).shape).size.isApprox(Vec3(0.01, 0.02, 0.03)));
  EXPECT_EQ(scene.bodies.at(2).lattice, LatticeKind::voxel);
  const auto& tube = std::get<TubeShape>(scene.bodies.at(3).shape);
  EXPECT_DOUBLE_EQ(tube.outer_radius, 5e-3);
  EXPECT_DOUBLE_EQ(tube.inner_radius, 3e-3);
  EXPECT_DOUBLE_EQ(tube.length, 40e-3);
  EXPECT_EQ(tube.axis, 0);
}

TEST(SceneReader, ReadsToolsAndDevices) {
  const auto scene = parsed(full_scene);
  const auto& tip = scene.tools.at(0);
  EXPECT_EQ(tip.device, "right");
  EXPECT_TRUE(tip.set_point.isApprox(Vec3(1e-3, 2e-3, 3e-3)));
  EXPECT_DOUBLE_EQ(tip.radius, 2e-3);
  EXPECT_EQ(tip.stiffness, 500);
  EXPECT_EQ(tip.damping, 2);
  const auto& right = scene.device("right");
  EXPECT_EQ(right.driver, "simulated");
  EXPECT_EQ(right.force_limit, 3.3);
  EXPECT_EQ(right.rotation * Vec3::UnitX(), Vec3::UnitY());
  EXPECT_EQ(right.scale, 2);
  EXPECT_EQ(right.force_scale, 0.5);
  EXPECT_TRUE(right.offset.isApprox(Vec3(0.01, 0, 0)));
  ASSERT_EQ(right.waypoints.size(), 2u);
  EXPECT_EQ(right.waypoints[1].t, 1.5);
  EXPECT_TRUE(right.waypoints[1].p.isApprox(Vec3(0, 0, 0.04)));
  EXPECT_EQ(right.hand, HandModel::pinch);
}

TEST(SceneReader, PassesTheModelOfASimulatedDeviceOn) {
  std::string text(full_scene);
  const std::string hand = "hand = \"pinch\"";
  text.replace(text.find(hand), hand.size(), "model = \"touch\"");
  EXPECT_THAT(parsed(text).device("right").options, testing::ElementsAre(Pair("model", "touch")));
}

TEST(SceneReader, PassesKeysItDoesNotKnowToTheDriverAsText) {
  EXPECT_THAT(parsed(full_scene).device("left").options,
              testing::UnorderedElementsAre(Pair("serial", "A12"), Pair("port", "3"), Pair("gain", "0.5"),
                                            Pair("quiet", "true")));
}

TEST(SceneReader, ReadsWhatIsSeenAndKept) {
  const auto scene = parsed(full_scene);
  EXPECT_THAT(scene.render->size_px, ElementsAre(640, 480));
  EXPECT_DOUBLE_EQ(scene.render->camera.yaw, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(scene.render->camera.pitch, std::numbers::pi / 6);
  EXPECT_THAT(scene.render->camera.distance, Optional(testing::DoubleEq(0.4)));
  ASSERT_TRUE(scene.render->camera.target);
  EXPECT_TRUE(scene.render->camera.target->isApprox(Vec3(0, 0, 0.01)));
  EXPECT_DOUBLE_EQ(scene.render->camera.field_of_view, std::numbers::pi / 4);
  EXPECT_THAT(scene.render->threshold, Optional(226.0));
  EXPECT_FALSE(scene.render->show_tool);
  EXPECT_TRUE(scene.render->show_force);
  EXPECT_FALSE(scene.render->show_panels);
  EXPECT_TRUE(scene.render->show_wire);
  EXPECT_TRUE(scene.render->show_fragments);
  EXPECT_EQ(scene.render->rate_Hz, 25);
  EXPECT_EQ(scene.render->most_frames, 50);
  EXPECT_EQ(scene.render->most_frame_bytes, 20e6);
  EXPECT_THAT(scene.render->inside, Optional(300.0));
  EXPECT_EQ(scene.render->opacity, 0.4);
  EXPECT_TRUE(scene.record->positions);
  EXPECT_FALSE(scene.record->forces);
  EXPECT_EQ(scene.record->rate_Hz, 100);
}

TEST(SceneReader, GivesTheDefaultsOfTheHeaderToTheShortestScene) {
  const auto scene = parsed(least_scene);
  const Scene fresh;
  EXPECT_EQ(scene.seed, 1u);
  EXPECT_EQ(scene.gravity, Vec3(0, 0, -9.81));
  EXPECT_FALSE(scene.physics->step);
  EXPECT_EQ(scene.physics->safety, fresh.physics->safety);
  EXPECT_EQ(scene.physics->frame_Hz, 1000);
  EXPECT_EQ(scene.bodies.at(0).lattice, LatticeKind::fcc);
  EXPECT_EQ(scene.bodies.at(0).at, Vec3(0, 0, 0));
  EXPECT_FALSE(scene.floor);
  EXPECT_TRUE(scene.contact->enabled);
  EXPECT_THAT(scene.tools, IsEmpty());
  EXPECT_TRUE(scene.render->show_panels);
  EXPECT_FALSE(scene.render->threshold);
  EXPECT_TRUE(scene.record->forces);
}

TEST(SceneReader, KeepsMaterialsInTheOrderOfTheFile) {
  const auto scene = parsed(full_scene);
  EXPECT_EQ(scene.materials.at(0).name, "skin");
  EXPECT_EQ(scene.materials.at(1).name, "clay");
}

TEST(SceneReader, ChecksumTellsTextAndSettingsApart) {
  const auto plain = parsed(least_scene).checksum;
  EXPECT_EQ(plain, parsed(least_scene).checksum);
  EXPECT_NE(plain, parsed(std::string(least_scene) + "\n").checksum);
  EXPECT_NE(plain, parsed(least_scene, {"seed=1"}).checksum);
  EXPECT_NE(parsed(least_scene, {"seed=1"}).checksum, parsed(least_scene, {"seed=2"}).checksum);
}

TEST(SceneReader, LastsAsItSaysElseToTheEndOfTheLongestPathAndASecond) {
  EXPECT_DOUBLE_EQ(parsed(full_scene).natural_seconds(), 12.5);
  std::string text(full_scene);
  const std::string own = "[scene]\nseconds = 12.5\n";
  text.erase(text.find(own), own.size());
  EXPECT_DOUBLE_EQ(parsed(text).natural_seconds(), 2.5);
  EXPECT_DOUBLE_EQ(parsed(least_scene).natural_seconds(), 5.0);
}

TEST(Place, NamesFileLineAndColumn) {
  EXPECT_EQ((Place{"a.toml", 3, 7}.text()), "a.toml:3:7");
  EXPECT_EQ((Place{"--set seed=x", 0, 0}.text()), "--set seed=x");
}

}  // namespace
}  // namespace palpate
