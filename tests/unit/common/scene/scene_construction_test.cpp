// Shapes, tools of elements, cavities, slices and walls: what they become, and each mistake as one line at its place.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
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

constexpr auto material = "[material.steel]\nmass_g = 1\nk1_N_per_m = 1e5\n";  // 3 lines

/// The scene of one body: its shape on line 6, the next key on line 7.
std::string body(const std::string& keys) {
  return fmt::format("{}[[body]]\nname = \"b\"\n{}\nspacing_mm = 1\nmaterial = \"steel\"\n", material, keys);
}

std::string hand(const std::string& from) {
  return fmt::format("[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, {}], [1, 0, 0, 0]]\n", from);
}

struct Mistake {
  std::string text, place, fragment;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.text; }

class ConstructionMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(ConstructionMistakes, AreOneLineAtTheirPlace) {
  const auto lines = complaints_about(GetParam().text);
  ASSERT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
  EXPECT_THAT(lines[0], StartsWith("s.toml:" + GetParam().place + ": "));
  EXPECT_THAT(lines[0], HasSubstr(GetParam().fragment));
  EXPECT_THAT(lines[0], testing::AnyOf(HasSubstr("; "), HasSubstr("? "))) << "says what would be right";
}

const std::string knife = "shape = \"knife\"\nlength_mm = 20\nheight_mm = 8";
const std::string needle = "shape = \"needle\"\nlength_mm = 40\ndiameter_mm = 6\ntheta_deg = [0, 0, 0, 30]";
const std::string box = "shape = \"box\"\nsize_mm = [9, 9, 9]";
const std::string tube = "shape = \"tube\"\nouter_radius_mm = 6\nlength_mm = 20";

INSTANTIATE_TEST_SUITE_P(
    Shapes, ConstructionMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {body("shape = \"knife\"\nheight_mm = 8"), "4:1",
         "[[body]] \"b\" lacks \"length_mm\"; give the length of the edge"},
        {body("shape = \"knife\"\nlength_mm = 8"), "4:1",
         "lacks \"height_mm\"; give the height of the blade"},
        {body("shape = \"knife\"\nlength_mm = 20\nheight_mm = 1.9"), "8:13",
         "is 1.9; a blade is two cells or more, 2 with spacing_mm = 1"},
        {body(knife + "\ntheta_deg = [0, 0, 0, 30]"), "9:13",
         "is a list of 4; write [tangential, twist, direction]"},
        {body(knife + "\ntheta_deg = [0, \"up\", 0]"), "9:17", "is \"up\"; write a finite number"},
        {body(knife + "\nlattice = \"voxel\""), "9:11",
         "a knife or needle stands on an \"fcc\" lattice; leave \"lattice\" out"},
        {body(box) + "[render]\nshow = [\"strain\", \"stress\"]\n", "11:8",
         "are colours of the same tissue; name one of them"},
        {body(box + "\nskin = \"smooth\""), "8:8",
         "\"skin\" is of cells; write lattice = \"voxel\", or leave \"skin\" out"},
        {body("shape = \"needle\"\nlength_mm = 40\ndiameter_mm = 6"), "4:1",
         "lacks \"theta_deg\"; give [swing, twist, rotation, sharpening]"},
        {body("shape = \"needle\"\ndiameter_mm = 6\ntheta_deg = [0, 0, 0, 30]"), "4:1",
         "lacks \"length_mm\"; give the length of the needle"},
        {body("shape = \"needle\"\nlength_mm = 40\ntheta_deg = [0, 0, 0, 30]"), "4:1",
         "lacks \"diameter_mm\""},
        {body("shape = \"needle\"\nlength_mm = 40\ndiameter_mm = 6\ntheta_deg = [0, 0, 0]"), "9:13",
         "is a list of 3; write [swing, twist, rotation, sharpening]"},
        {body("shape = \"needle\"\nlength_mm = 40\ndiameter_mm = 6\ntheta_deg = [0, 0, 0, 91]"), "9:13",
         "the sharpening angle in [[body]] \"b\" is 91; write a number from 5 to 90"},
        {body("shape = \"needle\"\nlength_mm = 90\ndiameter_mm = 6\ntheta_deg = [0, 0, 0, 4.9]"), "9:13",
         "is 4.9; write a number from 5 to 90"},
        {body("shape = \"needle\"\nlength_mm = 40\ndiameter_mm = 3.9\ntheta_deg = [0, 0, 0, 30]"), "8:15",
         "four cells wide or more, 4 with spacing_mm = 1"},
        {body("shape = \"needle\"\nlength_mm = 12\ndiameter_mm = 6\ntheta_deg = [0, 0, 0, 30]"), "7:13",
         "the bevel and two cells of shaft take 12.39"},
        {body(box + "\ntheta_deg = [0, 0, 9]\nlattice = \"voxel\""), "8:13",
         "voxels lie along the axes of the world; leave \"theta_deg\" out"},
        {body(tube + "\nwall_layers = 0"), "9:15", "is 0; write a whole number from 1"},
        {body(tube + "\nwall_layers = 2\ninner_radius_mm = 3"), "9:15",
         "both \"inner_radius_mm\" and \"wall_layers\" are given; keep one"},
        {body(box + "\nhandle = [\"up\"]"), "8:11", "is \"up\"; write \"-x\", \"+x\""},
        {body(box + "\nhandle = \"+z\""), "8:10", "is \"+z\"; write a list of \"-x\""},
    }));

INSTANTIATE_TEST_SUITE_P(
    Cavities, ConstructionMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {body(box) + "[[body.cavity]]\n", "10:1",
         "cavity of [[body]] \"b\" lacks a place; give box_min_mm and box_max_mm, or center_mm and "
         "radius_mm"},
        {body(box) + "[[body.cavity]]\ncenter_mm = [0, 0, 0]\n", "10:1", "lacks \"radius_mm\""},
        {body(box) + "[[body.cavity]]\nbox_min_mm = [0, 0, 0]\nbox_max_mm = [1, 1, -1]\n", "12:14",
         "swap the corners"},
        {body(box) + "[[body.cavity]]\nbox_min_mm = [0, 0, 0]\nbox_max_mm = [1, 1, 1]\ncenter_mm = [0, 0, "
                     "0]\nradius_mm = 1\n",
         "10:1", "has 2 places"},
        {body(box) + "[[body.cavity]]\ncentre_mm = [0, 0, 0]\ncenter_mm = [0, 0, 0]\nradius_mm = 1\n", "11:1",
         "unknown key \"centre_mm\""},
        {body(box + "\ncavity = [3]"), "8:11", "is 3; write a table under [[body.cavity]]"},
        {body(box + "\ncavity = 3"), "8:10", "is 3; write a table under [[body.cavity]]"},
    }));

std::string slices(const std::string& files, const std::string& more) {
  return fmt::format("{}[[body]]\nname = \"b\"\nshape = \"slices\"\nfiles = {}\n{}\nmaterial = \"steel\"\n",
                     material, files, more);
}
const std::string plane_keys = "pixel_mm = [1, 2]\nplane_mm = 3\nkeep = [9, 99]";

/// Two empty pictures: only their presence is looked at.
const std::string& pictures() {
  static const std::string pattern = [] {
    std::filesystem::create_directories(test::scene_folder() + "/brain");
    for (const auto* name : {"s_10", "s_9"})
      std::ofstream(fmt::format("{}/brain/{}.png", test::scene_folder(), name)) << "x";
    return std::string("\"brain/s_*.png\"");
  }();
  return pattern;
}

INSTANTIATE_TEST_SUITE_P(
    Slices, ConstructionMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {slices("\"brain/t_*.png\"", plane_keys), "7:9",
         "there is no file brain/t_*.png; give a pattern like"},
        {slices("[]", plane_keys), "7:9", "is a list of 0; write a pattern like"},
        {slices("[3]", plane_keys), "7:9", "write a pattern like"},
        {slices("7", plane_keys), "7:9", "\"files\" in [[body]] \"b\" is 7; write a pattern like"},
        {slices(pictures(), "plane_mm = 3\nkeep = [9, 99]"), "4:1",
         "lacks \"pixel_mm\"; give the distance of pixels as [dx, dy]"},
        {slices(pictures(), "pixel_mm = [1, 2]\nkeep = [9, 99]"), "4:1",
         "lacks \"plane_mm\"; give the distance of the planes"},
        {slices(pictures(), "pixel_mm = [1, 0]\nplane_mm = 3\nkeep = [9, 99]"), "8:16",
         "is 0; write a number above 0"},
        {slices(pictures(), "pixel_mm = [1, 2]\nplane_mm = 3"), "4:1", "lacks \"keep\""},
        {slices(pictures(), plane_keys + "\nspacing_mm = 2"), "11:14",
         "an image brings its own spacing; leave it out"},
        {slices(pictures(), plane_keys + "\nlattice = \"fcc\""), "4:1", "lacks \"spacing_mm\""},
        {slices(pictures(), plane_keys + "\ntheta_deg = [0, 0, 1]"), "11:1", "unknown key \"theta_deg\""},
    }));

const std::string least = body(box);  // 9 lines

INSTANTIATE_TEST_SUITE_P(Walls, ConstructionMistakes,
                         testing::ValuesIn(std::vector<Mistake>{
                             {least + "[[wall]]\nnormal = [0, 0, 1]\n", "10:1",
                              "[[wall]] lacks \"point_mm\"; give any point of its surface"},
                             {least + "[[wall]]\npoint_mm = [0, 0, 1]\n", "10:1",
                              "[[wall]] lacks \"normal\"; give the direction away from it"},
                             {least + "[[wall]]\npoint_mm = [0, 0, 1]\nnormal = [0, 0, 0]\n", "12:10",
                              "\"normal\" in [[wall]] has no length; give a direction"},
                             {least + "[wall]\n", "10:1", "write each of them as a table under [[wall]]"},
                         }));

/// Lines 1 to 3 the device, 4 to 6 the material.
std::string knife_tool(const std::string& body_keys, const std::string& tool_keys,
                       const std::string& from = "0, 0, 0") {
  return hand(from) + body(body_keys) + "[[tool]]\nname = \"t\"\ndevice = \"hand\"\n" + tool_keys;
}

INSTANTIATE_TEST_SUITE_P(
    Tools, ConstructionMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {knife_tool(knife, "body = \"c\"\n"), "17:8", "there is no [[body]] \"c\"; "},
        {knife_tool(knife, "body = \"b\"\nshape = \"knife\"\n"), "17:8",
         "both \"shape\" and \"body\" are given; keep one of them"},
        {knife_tool(knife, "body = 3\n"), "17:8", "is 3; write a text in quotes"},
        {knife_tool(knife, "body = \"b\"\nradius_mm = 3\n"), "18:1",
         "unknown key \"radius_mm\" in [[tool]] \"t\""},
        {knife_tool(knife, "body = \"b\"\nlow_pass_Hz = 0\n"), "18:15", "is 0; write a number above 0"},
        {knife_tool(box, "body = \"b\"\n"), "16:8", "body \"b\" has no handle; give it handle = [\"+z\"]"},
        {knife_tool(knife + "\nhandle = []", "body = \"b\"\n"), "18:8", "body \"b\" has no handle"},
        {knife_tool(knife + "\nfixed = [\"+z\"]", "body = \"b\"\n"), "18:8",
         "body \"b\" is fixed; a tool moves"},
        {knife_tool(knife, "body = \"b\"\n", "3, 0, 4"), "16:10",
         "the path of device \"hand\" begins at [3, 0, 4], 5 mm from the tip of body \"b\"; begin within 1 "
         "mm of its at_mm = [0, 0, 0]"},
        {knife_tool(knife, "body = \"b\"\n[[tool]]\nname = \"u\"\ndevice = \"hand\"\nbody = \"b\"\n"), "21:8",
         "body \"b\" is tool \"t\" already; give each tool a body of its own"},
        {knife_tool(knife, "shape = \"rod\"\n"), "17:9",
         "is \"rod\"; write \"point\", \"stick\", \"cylinder\", \"cone\", \"box\", \"scalpel\", "
         "\"scissors\", \"forceps\", "
         "\"knife\" or "
         "\"needle\", "
         "or body = "},
    }));

TEST(SceneConstruction, ReadsKnifeAndNeedle) {
  const auto blade = parsed(body(knife + "\ntheta_deg = [90, 0, 30]\nat_mm = [1, 2, 3]")).bodies.at(0);
  EXPECT_DOUBLE_EQ(std::get<KnifeShape>(blade.shape).length, 0.02);
  EXPECT_DOUBLE_EQ(std::get<KnifeShape>(blade.shape).height, 0.008);
  EXPECT_TRUE(blade.orientation.isApprox(rotation_of_angles({rad_from_deg(90), 0, rad_from_deg(30)})));
  EXPECT_TRUE((blade.orientation * Vec3::UnitX()).isApprox(Vec3::UnitY())) << "the edge swings to +y";
  EXPECT_THAT(blade.handle_faces, ElementsAre(false, false, false, false, false, true));
  const auto pipe = parsed(body(needle)).bodies.at(0);
  EXPECT_DOUBLE_EQ(std::get<NeedleShape>(pipe.shape).diameter, 0.006);
  EXPECT_DOUBLE_EQ(std::get<NeedleShape>(pipe.shape).sharpening, rad_from_deg(30));
  EXPECT_EQ(pipe.orientation, Eigen::Matrix3d::Identity());
  const auto grip = parsed(body(knife + "\nhandle = [\"-x\", \"+y\"]")).bodies.at(0);
  EXPECT_THAT(grip.handle_faces, ElementsAre(true, false, false, true, false, false));
}

TEST(SceneConstruction, ReadsWallLayersCavitiesAndWalls) {
  const auto scene = parsed(
      body(tube + "\nwall_layers = 3") +
      "[[body.cavity]]\ncenter_mm = [1, 2, 3]\nradius_mm = 4\n[[body.cavity]]\nbox_min_mm = [0, 0, 0]\n"
      "box_max_mm = [1, 1, 1]\n[[wall]]\npoint_mm = [1, 2, 3]\nnormal = [0, 3, -4]\n"
      "[[wall]]\npoint_mm = [0, 0, 0]\nnormal = [1e-200, 0, 0]\n");
  EXPECT_THAT(std::get<TubeShape>(scene.bodies.at(0).shape).wall_layers, Optional(3));
  ASSERT_EQ(scene.bodies[0].cavities.size(), 2u);
  EXPECT_DOUBLE_EQ(std::get<BallRegion>(scene.bodies[0].cavities[0].where).radius, 0.004);
  EXPECT_EQ(scene.bodies[0].cavities[1].place.line, 15);
  ASSERT_EQ(scene.walls.size(), 2u);
  EXPECT_TRUE(scene.walls[0].point.isApprox(Vec3(1e-3, 2e-3, 3e-3)));
  EXPECT_TRUE(scene.walls[0].normal.isApprox(Vec3(0, 0.6, -0.8)));
  EXPECT_TRUE(scene.walls[1].normal.isApprox(Vec3::UnitX())) << "whatever its length";
}

TEST(SceneConstruction, ReadsSlicesInTheOrderOfTheirNumbers) {
  const auto scene = parsed(slices(pictures(), plane_keys + "\nlargest_component = true"));
  EXPECT_EQ(scene.bodies.at(0).lattice, LatticeKind::voxel);
  const auto& image = std::get<VolumeShape>(scene.bodies[0].shape);
  ASSERT_TRUE(image.slices);
  const auto folder = test::scene_folder() + "/brain/";
  EXPECT_THAT(image.slices->files, ElementsAre(folder + "s_9.png", folder + "s_10.png"));
  EXPECT_TRUE(image.slices->spacing.isApprox(Vec3(1e-3, 2e-3, 3e-3)));
  EXPECT_TRUE(image.largest_component);
  const auto listed = parsed(
      slices("[\"brain/s_10.png\", \"brain/s_9.png\"]", plane_keys + "\nlattice = \"fcc\"\nspacing_mm = 6"));
  EXPECT_THAT(std::get<VolumeShape>(listed.bodies.at(0).shape).slices->files,
              ElementsAre(folder + "s_10.png", folder + "s_9.png"));
  EXPECT_EQ(listed.bodies[0].lattice, LatticeKind::fcc);
}

TEST(SceneConstruction, MakesAToolOfABody) {
  const auto scene =
      parsed(knife_tool(knife + "\nat_mm = [0, 0, 9]",
                        "body = \"b\"\nlow_pass_Hz = 5\nset_point_mm = [0, 0, 9]\n", "0, 0.6, 9.7"));
  ASSERT_EQ(scene.tools.size(), 1u);
  EXPECT_EQ(scene.tools[0].shape, ToolShape::body);
  EXPECT_EQ(scene.tools[0].body, "b");
  EXPECT_EQ(scene.tools[0].low_pass_Hz, 5);
  const auto own =
      parsed(hand("0, 0, 0") + material + "[[tool]]\nname = \"blade\"\ndevice = \"hand\"\nlow_pass_Hz = 9\n" +
             knife + "\nspacing_mm = 1\nmaterial = \"steel\"\n" + "[[body]]\nname = \"b\"\n" + box +
             "\nspacing_mm = 1\nmaterial = \"steel\"\n");
  ASSERT_EQ(own.bodies.size(), 2u);
  EXPECT_EQ(own.bodies[1].name, "blade");
  EXPECT_EQ(own.tools.at(0).body, "blade");
  EXPECT_EQ(own.tools[0].name, "blade");
}

TEST(SceneConstruction, CountsTheBodiesOfToolsToo) {
  std::string text = hand("0, 0, 0") + material;
  for (int i = 0; i < 64; ++i)
    text += fmt::format("[[body]]\nname = \"b{}\"\n{}\nspacing_mm = 1\nmaterial = \"steel\"\n", i, box);
  text += "[[tool]]\nname = \"t\"\ndevice = \"hand\"\n" + knife + "\nspacing_mm = 1\nmaterial = \"steel\"\n";
  EXPECT_THAT(complaints_about(text),
              ElementsAre(HasSubstr("too many bodies, those of tools included; at most 64")));
}

TEST(Springs, HaveNoPoissonRatioThatASceneCouldState) {
  EXPECT_THAT(
      complaints_about("[material.m]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.3\n"
                       "[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius_mm = 20\nspacing_mm = 5\n"
                       "material = \"m\"\n"),
      ElementsAre(HasSubstr("has poisson_ratio, which only finite elements follow")));
}

}  // namespace
}  // namespace palpate
