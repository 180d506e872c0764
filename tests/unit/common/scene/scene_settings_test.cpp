// --set table.key=value over a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/shape_spec.h"
#include "common/scene/tool_spec.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

using test::complaints_about;
using test::full_scene;
using test::least_scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Scene with(const std::vector<std::string>& settings) {
  EXPECT_THAT(complaints_about(full_scene, settings), IsEmpty());
  return parse_scene(full_scene, test::scene_folder() + "/s.toml", settings);
}

std::string complaint(const std::string& setting) {
  const auto lines = complaints_about(full_scene, {setting});
  EXPECT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
  return lines.empty() ? "" : lines[0];
}

TEST(SceneSettings, ReplaceAValueOfTheFile) {
  EXPECT_EQ(with({"physics.threads=1"}).physics->threads, 1);
  EXPECT_EQ(with({"seed=99"}).seed, 99u);
  EXPECT_EQ(*with({"material.skin.modulus_kPa=5.5"}).material("skin").modulus, 5500);
}

TEST(SceneSettings, AnotherDriverLeavesTheKeysOfTheOldOneOut) {
  using testing::Pair;
  using testing::UnorderedElementsAre;
  const auto options = [](const std::vector<std::string>& settings) {
    return with(settings).device("left").options;
  };
  const std::string old = with({}).device("left").driver;
  EXPECT_THAT(options({"device.left.driver=replay"}), IsEmpty());
  EXPECT_THAT(options({"device.left.driver=replay", "device.left.file=a.csv"}),
              UnorderedElementsAre(Pair("file", "a.csv")));
  EXPECT_THAT(options({"device.left.file=a.csv", "device.left.driver=replay"}),
              UnorderedElementsAre(Pair("file", "a.csv")))
      << "the order does not matter";
  EXPECT_THAT(options({"device.left.driver=" + old, "device.left.port=4"}),
              UnorderedElementsAre(Pair("serial", "A12"), Pair("port", "4"), Pair("gain", "0.5"),
                                   Pair("quiet", "true")))
      << "the same driver";
}

TEST(SceneSettings, AnotherDriverKeepsWhatAllDriversShare) {
  const auto before = with({}).device("right");
  const auto after = with({"device.right.driver=replay"}).device("right");
  EXPECT_EQ(after.driver, "replay");
  EXPECT_EQ(after.rate_Hz, before.rate_Hz);
  EXPECT_EQ(after.force_limit, before.force_limit);
  EXPECT_EQ(after.rotation, before.rotation);
  EXPECT_EQ(after.scale, before.scale);
  EXPECT_EQ(after.force_scale, before.force_scale);
  EXPECT_EQ(after.offset, before.offset);
  EXPECT_EQ(after.waypoints.size(), before.waypoints.size());
  EXPECT_EQ(after.hand, before.hand);
}

TEST(SceneSettings, ReachBodiesAndToolsByName) {
  EXPECT_TRUE(with({"body.ball.at_mm=[1, 2, 3]"}).bodies[1].at.isApprox(Vec3(1e-3, 2e-3, 3e-3)));
  EXPECT_DOUBLE_EQ(with({"tool.tip.radius_mm=9"}).tools[0].radius, 9e-3);
  EXPECT_EQ(with({}).tools[0].friction, 0);
  EXPECT_EQ(with({"tool.tip.friction=0.3"}).tools[0].friction, 0.3);
  EXPECT_THAT(complaint("tool.tip.friction=-0.1"), HasSubstr("write a number from 0 to 2"));
  EXPECT_THAT(complaints_about(full_scene, {"tool.tip.friction=0.3", "tool.tip.force_model=direct"}),
              ElementsAre(HasSubstr("friction is felt with force_model = \"norton\" or \"tissue\" only")));
}

TEST(SceneSettings, ReachIntoInlineTables) {
  EXPECT_EQ(std::get<VolumeShape>(with({"body.head.deformable.radius_voxels=3"}).bodies[0].shape)
                .deformable.radius_voxels,
            3);
  EXPECT_DOUBLE_EQ(*with({"render.camera.distance_mm=123"}).render->camera.distance, 0.123);
}

TEST(SceneSettings, TakeABareWordAsText) {
  EXPECT_EQ(with({"physics.precision=single"}).physics->precision, Precision::single_);
  EXPECT_EQ(with({"title=Two words"}).title, "Two words");
  EXPECT_EQ(with({"title=\"quoted\""}).title, "quoted");
}

TEST(SceneSettings, MakeTablesThatTheFileLacks) {
  const auto scene = parse_scene(least_scene, "s.toml", {"physics.threads=3", "render.camera.yaw_deg=0"});
  EXPECT_EQ(scene.physics->threads, 3);
  EXPECT_EQ(scene.render->camera.yaw, 0);
}

TEST(SceneSettings, LaterOnesWin) { EXPECT_EQ(with({"seed=3", "seed=4"}).seed, 4u); }

TEST(SceneSettings, MayTurnAValueIntoATable) {
  EXPECT_TRUE(std::get<VolumeShape>(with({"body.head.deformable=all"}).bodies[0].shape).deformable.all);
}

TEST(SceneSettings, AreNamedInComplaintsInsteadOfALine) {
  EXPECT_THAT(
      complaint("physics.threads=many"),
      StartsWith("--set physics.threads=many: \"threads\" in [physics] is \"many\"; write a whole number"));
  EXPECT_THAT(
      complaint("physics.thread=2"),
      StartsWith("--set physics.thread=2: unknown key \"thread\" in [physics]; did you mean \"threads\"?"));
  EXPECT_THAT(complaint("phisics.threads=2"), StartsWith("--set phisics.threads=2: unknown key \"phisics\""));
  EXPECT_THAT(complaint("body.ball.material=skni"), StartsWith("--set body.ball.material=skni: there is no"));
  EXPECT_THAT(complaint("seed=nan"), StartsWith("--set seed=nan: \"seed\" in the scene is nan;"));
}

TEST(SceneSettings, RefusePathsThatLeadNowhere) {
  EXPECT_THAT(complaint("physics.threads"), HasSubstr("write table.key=value"));
  EXPECT_THAT(complaint("physics..threads=1"), HasSubstr("is no path; write table.key=value"));
  EXPECT_THAT(complaint("=1"), HasSubstr("is no path"));
  EXPECT_THAT(complaint("body.bell.at_mm=[0,0,0]"),
              HasSubstr("no [[body]] is called \"bell\"; did you mean \"ball\"?"));
  EXPECT_THAT(complaint("body.ball=3"), HasSubstr("which key of which body? Write body.NAME.key=value"));
  EXPECT_THAT(complaint("seed.deep=3"), HasSubstr("\"seed\" is 7, not a table"));
}

TEST(SceneSettings, RefuseWhatIsNoValue) {
  EXPECT_THAT(complaint("seed="), HasSubstr("is no value; write a number"));
  EXPECT_THAT(complaint("seed=[1"), HasSubstr("is no value"));
  EXPECT_THAT(complaint("seed=1\nthreads=2"), HasSubstr("is no value"));
}

TEST(SceneSettings, AllMistakesAreReportedAtOnce) {
  EXPECT_THAT(complaints_about(full_scene, {"seed=x", "nowhere", "physics.safety=2"}),
              ElementsAre(HasSubstr("--set nowhere:"), HasSubstr("--set seed=x:"),
                          HasSubstr("--set physics.safety=2:")));
}

}  // namespace
}  // namespace palpate
