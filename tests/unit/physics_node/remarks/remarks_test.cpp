// A sound scene has no remark, and each mistake of a newcomer has its own and no other.

#include "physics_node/remarks/remarks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/record/volume.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"

namespace palpate::physics {
namespace {

constexpr const char* sound = R"(gravity_m_per_s2 = [0, 0, -9.81]
[scene]
seconds = 3
[material.soft]
density_kg_per_m3 = 1000
modulus_kPa = 10
viscosity_Pa_s = 1
[[body]]
name = "block"
lattice = "voxel"
shape = "box"
size_mm = [60, 60, 30]
spacing_mm = 5
material = "soft"
fixed = ["-z"]
[[tool]]
name = "tip"
device = "hand"
radius_mm = 8
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 25], [1, 0, 0, 12], [2, 0, 0, 25]]
[render]
camera = { distance_mm = 300, target_mm = [0, 0, 0] }
)";

Remarks remarks_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  const World world(parse_scene(text, "s.toml", settings));
  return remarks_about(world);
}

std::string all(const Remarks& remarks) {
  std::string text;
  for (const auto& remark : remarks) text += remark + "\n";
  return text;
}

TEST(Remarks, HaveNothingToSayAboutASoundScene) { EXPECT_EQ(all(remarks_of(sound)), ""); }

/// Whose corners never come near: they hang over.
TEST(Remarks, SayNothingOfAPlateThatIsWiderThanTheBody) {
  const std::vector<std::string> plate = {"body.block.model=fem", "tool.tip.shape=box",
                                          "tool.tip.size_mm=[200,200,10]"};
  std::string text(sound);
  text.erase(text.find("radius_mm = 8\n"), 14);
  EXPECT_EQ(all(remarks_of(text, plate)), "");
  std::vector<std::string> beside = plate;
  beside.push_back("device.hand.waypoints=[[0,0,0,45],[1,0,0,25],[2,0,0,45]]");
  EXPECT_NE(all(remarks_of(text, beside)).find("never touches a body and stays 10 mm"), std::string::npos)
      << all(remarks_of(text, beside));
}

TEST(Remarks, KnowTheBallRoundATip) {
  const std::string by_the_edge = "device.hand.waypoints=[[0,35,0,25],[1,35,0,12],[2,35,0,25]]";
  for (const int radius : {1, 20}) {
    const std::string said = all(remarks_of(
        sound, {"body.block.model=fem", by_the_edge, "tool.tip.radius_mm=" + std::to_string(radius)}));
    EXPECT_EQ(said.find("never touches") != std::string::npos, radius == 1) << said;
  }
}

/// A box of 10 mm in whole cells of 4 mm is one of 12 mm.
TEST(Remarks, SayHowMuchLargerCellsMakeABox) {
  const std::vector<std::string> small = {"body.block.size_mm=[10,10,10]", "body.block.spacing_mm=4"};
  const std::string said = all(remarks_of(sound, small));
  EXPECT_NE(said.find("its cells make 1.73 times the volume of its box"), std::string::npos) << said;
  EXPECT_EQ(said.find("border_cells"), std::string::npos) << "springs have none: " << said;
  std::vector<std::string> solid = small;
  solid.emplace_back("body.block.model=\"fem\"");
  EXPECT_EQ(all(remarks_of(sound, solid)).find("border_cells"), std::string::npos)
      << "too few cells for that";
  solid.emplace_back("body.block.border_cells=\"filled\"");
  const std::string filled = all(remarks_of(sound, solid));
  EXPECT_NE(filled.find("a box 2.5 cells thick"), std::string::npos) << filled;
  EXPECT_EQ(filled.find("times the volume"), std::string::npos) << filled;
  solid[1] = "body.block.spacing_mm=2.5";
  EXPECT_EQ(all(remarks_of(sound, solid)).find("cells thick"), std::string::npos);
  solid = {"body.block.size_mm=[30,30,30]", "body.block.spacing_mm=3.5", "body.block.model=\"fem\""};
  EXPECT_NE(all(remarks_of(sound, solid)).find("border_cells = \"filled\""), std::string::npos);
}

TEST(Remarks, SayWhereATipPressesMasses) {
  const std::string fem = "body.block.model=\"fem\"";
  EXPECT_NE(
      all(remarks_of(sound, {fem, "physics.integrator=\"backward_euler\""})).find("bears two or three times"),
      std::string::npos);
  EXPECT_NE(all(remarks_of(sound, {fem, "tool.tip.force_model=\"direct\""})).find("of the papers"),
            std::string::npos);
}

struct Mistake {
  std::string name;
  std::vector<std::string> settings;
  std::string words;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class MistakeOfANewcomer : public testing::TestWithParam<Mistake> {};

TEST_P(MistakeOfANewcomer, HasItsOwnLineAndNoOther) {
  const Remarks remarks = remarks_of(sound, GetParam().settings);
  ASSERT_EQ(remarks.size(), 1u) << all(remarks);
  EXPECT_NE(remarks[0].find(GetParam().words), std::string::npos) << remarks[0];
  EXPECT_EQ(remarks[0].find('\n'), std::string::npos);
  const bool says_where = remarks[0].find("s.toml") == 0 || remarks[0].find("--set ") == 0;
  EXPECT_TRUE(says_where) << remarks[0];
}

const std::string path = "device.hand.waypoints=";
const std::string ball = "body.block.";

INSTANTIATE_TEST_SUITE_P(
    , MistakeOfANewcomer,
    testing::Values(
        Mistake{"ModulusInPa",
                {"material.soft.modulus_kPa=3e8", "physics.integrator=backward_euler"},
                "as stiff as bone"},
        Mistake{"ModulusInMPa", {"material.soft.modulus_kPa=0.01"}, "softer than jelly"},
        Mistake{"LawForSmallStrain", {"material.soft.law=green", "body.block.model=fem"}, "gives way"},
        Mistake{"FoamForSmallStrain",
                {"material.soft.poisson_ratio=0.1", "body.block.model=fem"},
                "gives way where it is pressed below 0.62 of its length"},
        Mistake{"CellsTooLargeForTheirCrack",
                {"body.block.model=fem", "material.soft.break_ratio=1.3",
                 "material.soft.fracture_energy_J_per_m2=1"},
                "cells of 5 mm hold 1.92 J/m^2 when they begin to break"},
        Mistake{"DensityInGramsPerCm3", {"material.soft.density_kg_per_m3=1.06"}, "has a density of 1.06"},
        Mistake{"SizesInMetres",
                {"body.block.size_mm=[0.06,0.06,0.03]", "body.block.spacing_mm=0.005",
                 path + "[[0,0,0,0.025],[1,0,0,0.012]]", "render.camera={distance_mm=0.3}",
                 "physics.integrator=backward_euler"},
                "measures 0.06 mm"},
        Mistake{"GravityInMillimetres", {"gravity_m_per_s2=[0,0,-9810]"}, "gravity is 9810"},
        Mistake{"GravityUpwards", {"gravity_m_per_s2=[0,0,9.81]"}, "gravity points up"},
        Mistake{"TooFewFrames", {"physics.frame_Hz=25"}, "at 25 frames a second"},
        Mistake{"TooManySteps", {"physics.step_ms=0.0005"}, "2000 steps a frame are too many"},
        Mistake{"TooManyStepsByViscosity",
                {"body.block.model=fem", "material.soft.viscosity_Pa_s=200", "physics.step_ms=0.0005"},
                "too many for real time; less viscosity, larger cells"},
        Mistake{"NothingHeld", {"body.block.fixed=[]"}, "falls: nothing holds it"},
        Mistake{"NothingHeldWithoutGravity",
                {"body.block.fixed=[]", "gravity_m_per_s2=[0,0,0]"},
                "drifts away once it is touched"},
        Mistake{"AllHeld",
                {"body.block.fixed=[{min_mm=[-99,-99,-99],max_mm=[99,99,99]}]"},
                "nothing of it moves"},
        Mistake{"HoldOfNothing",
                {"body.block.fixed=[\"-z\",{min_mm=[-0.1,-0.1,0.001],max_mm=[-0.05,0.1,0.1]}]"},
                "holds none of its masses"},
        Mistake{"BelowTheFloor", {"floor.height_mm=0"}, "mm below the floor"},
        Mistake{"ToolBeginsInside", {path + "[[0,0,0,3],[1,0,0,0]]"}, "begins inside tissue"},
        Mistake{"PathNeverTouches",
                {path + "[[0,0,0,45],[1,0,0,25],[2,0,0,45]]"},
                "never touches a body and stays 10"},
        Mistake{"PathBesideTheBody", {path + "[[0,0,0.2,25],[1,200,0,12]]"}, "never touches"},
        Mistake{"PathInMetresForMillimetres",
                {path + "[[0,0,0,25000],[4,0,0,24000]]", "scene.seconds=5"},
                "begins 25 m away"},
        Mistake{"FasterThanAHand", {path + "[[0,0,0,25],[0.001,0,0,12],[1,0,0,25]]"}, "is led at 13 m/s"},
        Mistake{
            "SceneEndsBeforeThePath", {"scene.seconds=1.5"}, "its path takes 2 s, the scene ends after 1.5"},
        Mistake{"TipSmallerThanItsCells",
                {"body.block.model=fem", "tool.tip.radius_mm=2"},
                "presses cells of 5 mm of body \"block\" at their corners"},
        Mistake{"JawsBetweenMasses",
                {"tool.tip.shape=forceps", "tool.tip.radius_mm=2"},
                "close between masses that lie 5 mm apart and may hold none"},
        Mistake{"StickThatBeginsInside",
                {"tool.tip.shape=stick", "tool.tip.length_mm=60", "tool.tip.radius_mm=4",
                 path + "[[0,0,0,30],[1,0,0,12]]"},
                "begins inside tissue"},
        Mistake{"CameraLooksAway",
                {"render.camera={distance_mm=300,target_mm=[0,0,900]}"},
                "looks past all bodies"},
        Mistake{"SectionBesideAllBodies", {"render.section={axis=\"x\",at_mm=500}"}, "meets no body"},
        Mistake{"CameraFarAway", {"render.camera={distance_mm=300000}"}, "are a dot in the picture"}),
    [](const auto& which) { return which.param.name; });

/// None of its own points need lie in tissue.
TEST(Remarks, SayThatAPlateBeginsAroundTissue) {
  std::string text = sound;
  const std::string round = "radius_mm = 8";
  text.replace(text.find(round), round.size(), "shape = \"box\"\nsize_mm = [200, 200, 6]");
  EXPECT_EQ(all(remarks_of(text)).find("begins inside"), std::string::npos) << "10 mm above";
  const Remarks remarks = remarks_of(text, {path + "[[0,0,0,12],[1,0,0,25]]"});
  EXPECT_NE(all(remarks).find("tool \"tip\" begins inside tissue"), std::string::npos) << all(remarks);
}

/// The box round a cylinder may reach into tissue that the cylinder stands clear of.
TEST(Remarks, LookAtARoundToolAsItIs) {
  std::string text = sound;
  const std::string round = "radius_mm = 8";
  text.replace(text.find(round), round.size(), "shape = \"cylinder\"\nradius_mm = 4\nlength_mm = 20");
  const auto inside = [&](const char* start) {
    return all(remarks_of(text, {path + "[[" + start + "],[1,0,0,40]]"})).find("begins inside") !=
           std::string::npos;
  };
  EXPECT_FALSE(inside("0,33,33,10"));
  EXPECT_TRUE(inside("0,32,32,10"));
  EXPECT_TRUE(inside("0,33,0,10"));
}

TEST(Remarks, SayThatTwoBodiesBeginInOnePlace) {
  const std::string other = std::string(sound) + R"([[body]]
name = "other"
shape = "sphere"
radius_mm = 12
spacing_mm = 5
material = "soft"
lattice = "fcc"
at_mm = [0, 0, 20]
)";
  const Remarks remarks = remarks_of(other, {"gravity_m_per_s2=[0,0,0]", "body.other.fixed=[\"+z\"]",
                                             path + "[[0,25,0,25],[1,25,0,12],[2,25,0,25]]"});
  ASSERT_EQ(remarks.size(), 2u) << all(remarks);
  EXPECT_NE(remarks[0].find("body \"block\" begins inside body \"other\""), std::string::npos) << remarks[0];
  EXPECT_NE(remarks[1].find("body \"other\" begins inside body \"block\""), std::string::npos) << remarks[1];
}

TEST(Remarks, SayThatAnImageIsCutAmiss) {
  const palpate::test::ScratchFolder folder;
  const auto tissue = [](int, int, int k) { return k < 9 ? 100.0F : 0.0F; };
  write_volume(test::made_volume({20, 20, 10}, tissue), folder / "v.h5");
  const std::string text = R"([material.soft]
density_kg_per_m3 = 1000
modulus_kPa = 10
[[body]]
name = "image"
shape = "volume"
file = ")" + (folder / "v.h5") +
                           R"("
keep = [50, 400]
material = "soft"
deformable = { center_voxel = [10, 10, 5], radius_voxels = 4 }
)";
  EXPECT_EQ(all(remarks_of(text)), "");
  const Remarks air = remarks_of(text, {"body.image.keep=[0,400]"});
  ASSERT_EQ(air.size(), 1u) << all(air);
  EXPECT_NE(air[0].find("\"keep\" takes 100 % of the image"), std::string::npos) << air[0];
  const Remarks outside =
      remarks_of(text, {"body.image.deformable={center_voxel=[10,21,5],radius_voxels=4}"});
  ASSERT_EQ(outside.size(), 1u) << all(outside);
  EXPECT_NE(outside[0].find("center_voxel = [10, 21, 5] lies outside its 20 x 20 x 10 cells"),
            std::string::npos)
      << outside[0];
}

}  // namespace
}  // namespace palpate::physics
