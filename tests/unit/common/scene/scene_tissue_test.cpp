// What a body is made of: options of the papers, several materials, and the part that deforms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/record_spec.h"
#include "common/scene/scene.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

using test::complaints_about;
using test::parsed;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using testing::StartsWith;

/// Materials soft, hard (axial dampers), dragged, stretchy (no damper), and one body of "soft".
/// Keys of the body stand in line 20.
std::string scene_with(const std::string& body_keys, const std::string& shape) {
  std::string text = R"([material.soft]
mass_g = 1
k1_N_per_m = 10
viscosity_N_s_per_m = 0.1
[material.hard]
mass_g = 1
k1_N_per_m = 100
viscosity_N_s_per_m = 0.1
[material.dragged]
mass_g = 1
k1_N_per_m = 10
viscosity_N_s_per_m = 0.1
damper = "drag"
[material.stretchy]
mass_g = 1
lambda_N = 0.4
drag_N_s_per_m = 0.2
[[body]]
name = "b"
)" + body_keys + "\nmaterial = \"soft\"\n" +
                     shape + "\n";
  for (auto& c : text)
    if (c == ';') c = '\n';
  return text;
}

std::string one_complaint(const std::string& text, const std::vector<std::string>& settings = {}) {
  const auto lines = complaints_about(text, settings);
  EXPECT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
  return lines.empty() ? "" : lines[0];
}

const std::string ball = "spacing_mm = 1; shape = \"sphere\"; radius_mm = 5";
const std::string image = "shape = \"volume\"; file = \"scan.h5\"; keep = [1, 9]";

TEST(Materials, MayGiveTheForcePerStretchAndADrag) {
  const auto scene = parsed(scene_with("", ball));
  const auto& material = scene.material("stretchy");
  EXPECT_THAT(material.lambda, Optional(0.4));
  EXPECT_FALSE(material.k1 || material.modulus);
  EXPECT_EQ(material.drag, 0.2);
  EXPECT_EQ(scene.material("soft").drag, 0);
}

TEST(Materials, NameTheirDamper) {
  EXPECT_EQ(parsed(scene_with("", ball)).material("soft").damper, Damper::axial);
  EXPECT_EQ(parsed(scene_with("", ball)).material("dragged").damper, Damper::drag);
  EXPECT_EQ(parsed(scene_with("", ball), {"material.soft.damper=relative"}).material("soft").damper,
            Damper::relative);
}

TEST(Materials, RefuseWhatIsNoStiffnessNoDragNoDamper) {
  const auto text = scene_with("", ball);
  EXPECT_THAT(one_complaint(text, {"material.stretchy.lambda_N=0"}),
              HasSubstr("is 0; write a number above 0"));
  EXPECT_THAT(
      one_complaint(text, {"material.soft.lambda_N=2"}),
      HasSubstr("both \"k1_N_per_m\" and \"lambda_N\" are given in [material.soft]; keep one of them"));
  EXPECT_THAT(one_complaint(text, {"material.stretchy.k1_N_per_m=1", "material.stretchy.modulus_kPa=1"}),
              HasSubstr("all of \"k1_N_per_m\", \"modulus_kPa\" and \"lambda_N\" are given"));
  EXPECT_THAT(one_complaint(text, {"material.stretchy.drag_N_s_per_m=-1"}),
              HasSubstr("write a number, 0 or more"));
  EXPECT_THAT(one_complaint(text, {"material.soft.damper=full"}),
              HasSubstr("write \"axial\", \"relative\" or \"drag\""));
  EXPECT_THAT(one_complaint(text, {"material.stretchy.damper=drag"}),
              HasSubstr("\"damper\" in [material.stretchy] has no constant"));
}

TEST(Regions, AreReadInOrderAndInSI) {
  const auto scene =
      parsed(scene_with("regions = [{ material = \"hard\", box_min_mm = [0, 1, 2], box_max_mm = [3, 4, 5] }, "
                        "{ material = \"stretchy\", center_mm = [1, 0, 0], radius_mm = 2 }, "
                        "{ material = \"soft\", intensity = [2, 3.5] }]",
                        image));
  const auto& regions = scene.bodies.at(0).regions;
  ASSERT_EQ(regions.size(), 3u);
  EXPECT_EQ(regions[0].material, "hard");
  EXPECT_TRUE(std::get<BoxRegion>(regions[0].where).min.isApprox(Vec3(0, 1e-3, 2e-3)));
  EXPECT_TRUE(std::get<BoxRegion>(regions[0].where).max.isApprox(Vec3(3e-3, 4e-3, 5e-3)));
  EXPECT_EQ(regions[1].material, "stretchy");
  EXPECT_TRUE(std::get<BallRegion>(regions[1].where).center.isApprox(Vec3(1e-3, 0, 0)));
  EXPECT_DOUBLE_EQ(std::get<BallRegion>(regions[1].where).radius, 2e-3);
  EXPECT_EQ(std::get<IntensityRegion>(regions[2].where).lo, 2);
  EXPECT_EQ(std::get<IntensityRegion>(regions[2].where).hi, 3.5);
  EXPECT_EQ(regions[2].place.line, 20);
  EXPECT_THAT(parsed(scene_with("", ball)).bodies.at(0).regions, IsEmpty());
}

std::string region_complaint(const std::string& region, const std::string& shape = ball) {
  return one_complaint(scene_with("regions = [" + region + "]", shape));
}

TEST(Regions, SayWhatIsWrongAndWhere) {
  EXPECT_THAT(region_complaint("{ material = \"hart\", center_mm = [0, 0, 0], radius_mm = 1 }"),
              StartsWith("s.toml:20:25: there is no [material.hart]; did you mean \"hard\"?"));
  EXPECT_THAT(region_complaint("{ center_mm = [0, 0, 0], radius_mm = 1 }"),
              StartsWith("s.toml:20:12: regions of [[body]] \"b\" lacks \"material\"; name a"));
  EXPECT_THAT(region_complaint("{ material = \"hard\" }"),
              StartsWith("s.toml:20:12: regions of [[body]] \"b\" lacks a place; give"));
  EXPECT_THAT(region_complaint("{ material = \"hard\", radius_mm = 1 }"),
              HasSubstr("lacks \"center_mm\"; give the middle"));
  EXPECT_THAT(region_complaint("{ material = \"hard\", box_min_mm = [0, 0, 0] }"),
              HasSubstr("lacks \"box_max_mm\"; give"));
  EXPECT_THAT(region_complaint("{ material = \"hard\", box_min_mm = [0, 0, 0], box_max_mm = [0, -1, 0] }"),
              StartsWith("s.toml:20:70: \"box_max_mm\" lies below \"box_min_mm\"; swap"));
  EXPECT_THAT(region_complaint(
                  "{ material = \"hard\", center_mm = [0, 0, 0], radius_mm = 1, intensity = [1, 2] }", image),
              HasSubstr("has 2 places; give"));
  EXPECT_THAT(region_complaint("{ material = \"hard\", intensity = [1, 2] }"),
              HasSubstr("\"intensity\" needs an image"));
  EXPECT_THAT(region_complaint("{ material = \"hard\", intensity = [2, 1] }", image),
              HasSubstr("runs from 2 down to 1; write"));
  EXPECT_THAT(region_complaint("{ material = \"hard\", radius_m = 1, center_mm = [0, 0, 0], radius_mm = 1 }"),
              StartsWith("s.toml:20:33: unknown key \"radius_m\" in regions of [[body]] \"b\"; did you mean "
                         "\"radius_mm\"?"));
  EXPECT_THAT(region_complaint("3"),
              StartsWith("s.toml:20:12: \"regions\" in [[body]] \"b\" is 3; write { material"));
  EXPECT_THAT(one_complaint(scene_with("regions = 3", ball)), HasSubstr("is 3; write a list of { material"));
}

TEST(Regions, OfOneBodyShareOneKindOfDamper) {
  EXPECT_THAT(
      region_complaint("{ material = \"dragged\", center_mm = [0, 0, 0], radius_mm = 1 }"),
      HasSubstr("materials \"soft\" and \"dragged\" of one body have different dampers; give both the same"));
  EXPECT_THAT(complaints_about(scene_with(
                  "regions = [{ material = \"stretchy\", center_mm = [0, 0, 0], radius_mm = 1 }]", ball)),
              IsEmpty());
}

TEST(Regions, AreAtMostSixtyFour) {
  std::string list;
  for (int i = 0; i < 65; ++i) list += "{ material = \"hard\", center_mm = [0, 0, 0], radius_mm = 1 }, ";
  EXPECT_THAT(region_complaint(list), HasSubstr("65 regions in [[body]] \"b\"; at most 64"));
}

TEST(Physics, SleepsUnlessToldNotTo) {
  EXPECT_TRUE(parsed(scene_with("", ball)).physics->sleep);
  EXPECT_FALSE(parsed(scene_with("", ball), {"physics.sleep=false"}).physics->sleep);
  EXPECT_THAT(one_complaint(scene_with("", ball), {"physics.sleep=deep"}), HasSubstr("write true or false"));
  EXPECT_FALSE(parsed(scene_with("", ball)).physics->subcycle);
  EXPECT_TRUE(parsed(scene_with("", ball), {"physics.subcycle=true"}).physics->subcycle);
}

TEST(Record, KeepsTheEnergyUnlessAListLeavesItOut) {
  EXPECT_TRUE(parsed(scene_with("", ball)).record->energy);
  EXPECT_FALSE(parsed(scene_with("", ball), {"record.what=[\"forces\"]"}).record->energy);
  const auto record = *parsed(scene_with("", ball), {"record.what=[\"energy\"]"}).record;
  EXPECT_TRUE(record.energy);
  EXPECT_FALSE(record.forces);
}

std::string image_with(const std::string& deformable) { return image + "; deformable = " + deformable; }

TEST(Deformable, MayBeCentredOnGravityAndCountNearestCells) {
  const auto region_of = [](const std::string& deformable) {
    return std::get<VolumeShape>(parsed(scene_with("", image_with(deformable))).bodies.at(0).shape)
        .deformable;
  };
  const auto round = region_of("{ center = \"gravity\", radius_voxels = 4 }");
  EXPECT_FALSE(round.all);
  EXPECT_TRUE(round.gravity_center);
  EXPECT_EQ(round.radius_voxels, 4);
  EXPECT_FALSE(round.nearest);
  const auto ten = region_of("{ center_voxel = [1, 2, 3], nearest = 10 }");
  EXPECT_FALSE(ten.gravity_center);
  EXPECT_THAT(ten.center_voxel, ElementsAre(1, 2, 3));
  EXPECT_THAT(ten.nearest, Optional(10));
}

TEST(Deformable, SaysWhatIsWrong) {
  const auto complaint = [](const std::string& deformable) {
    return one_complaint(scene_with("", image_with(deformable)));
  };
  EXPECT_THAT(
      complaint("{ radius_voxels = 4 }"),
      HasSubstr("lacks \"center_voxel\" or \"center\"; give the middle of the region as [i, j, k], or"));
  EXPECT_THAT(complaint("{ center = \"middle\" }"), HasSubstr("is \"middle\"; write \"gravity\""));
  EXPECT_THAT(complaint("{ center = \"gravity\", center_voxel = [1, 2, 3] }"), HasSubstr("keep one of them"));
  EXPECT_THAT(complaint("{ center = \"gravity\", radius_voxels = 4, nearest = 10 }"),
              HasSubstr("keep one of them"));
  EXPECT_THAT(complaint("{ center = \"gravity\", nearest = 0 }"),
              HasSubstr("is 0; write a whole number from 1 to"));
}

TEST(VolumeFile, GivenOnTheCommandLineIsFoundFromThere) {
  // The scene looks beside itself; a person who types --set looks from where he stands.
  const auto text = scene_with("", image);
  const auto here = test::scene_folder() + "/scan.h5";
  const auto scene = parsed(text, {"body.b.file=" + here});
  EXPECT_EQ(std::get<VolumeShape>(scene.bodies.at(0).shape).file, here);
  EXPECT_THAT(one_complaint(text, {"body.b.file=scan.h5"}),
              HasSubstr("there is no file scan.h5; make it with \"palpate import"));
}

}  // namespace
}  // namespace palpate
