// The operations among the scenes that come with palpate: what scalpel, scissors and forceps take, and what is left.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/system/shipped_scenes.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using test::ShippedScenes;

/// An incision: what it took and what the books say of it are one, the tissue is in one piece and has all of its masses.
TEST_F(ShippedScenes, AScalpelOpensTissue) {
  const auto summary = simulate("scalpel", "");
  const auto& blade = summary["tools"]["scalpel"];
  const double area = 1e-6 * blade["cut_area_mm2"].get<double>(),
               cut = summary["energy"]["cut"].get<double>();
  EXPECT_GT(area, 300e-6);
  EXPECT_LT(area, 450e-6) << "of the way at the depth of the hand";
  EXPECT_NEAR(cut, 190 * area, 1e-6 * cut);
  EXPECT_GT(blade["tissue_work"].get<double>(), cut);
  EXPECT_NEAR(blade["felt_over_true_rms"].get<double>(), 1, 0.06);
  EXPECT_GT(summary["bodies"]["tissue"]["largest_fragment"].get<double>(), 0.999);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 1e-3);
}

/// Three snips cut a strip off a sheet: the handles pay for all of it, and the strip falls.
TEST_F(ShippedScenes, ScissorsCutAStripOff) {
  const auto summary = simulate("scissors", "");
  const auto &blades = summary["tools"]["scissors"], &sheet = summary["bodies"]["sheet"];
  const double area = 1e-6 * blades["cut_area_mm2"].get<double>();
  EXPECT_NEAR(area, 0.060 * 0.008, 0.08 * 0.060 * 0.008);
  EXPECT_NEAR(summary["energy"]["cut"].get<double>(), 190 * area, 1e-6 * 190 * area);
  EXPECT_NEAR(blades["handle_work"].get<double>(), 190 * area, 0.05 * 190 * area);
  EXPECT_GT(blades["handle_torque_peak"].get<double>(), 0.1);
  EXPECT_EQ(sheet["fragments"], 2);
  EXPECT_NEAR(sheet["largest_fragment"].get<double>(), 0.6, 0.1);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 1e-3);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
}

TEST_F(ShippedScenes, ForcepsLiftSkinAndLetItGo) {
  const auto summary = simulate("forceps", "");
  const auto& jaws = summary["tools"]["forceps"];
  EXPECT_GT(jaws["force_peak"].get<double>(), 0.5);
  EXPECT_LT(jaws["force_peak"].get<double>(), 3) << "it would slip";
  EXPECT_GT(jaws["tissue_work"].get<double>(), 1e-3);
  EXPECT_LT(jaws["tissue_work"].get<double>(), jaws["hand_work"].get<double>());
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01);
  EXPECT_LT(summary["energy"]["elastic"].get<double>(), 1e-3 * summary["energy"]["tool_work"].get<double>())
      << "it has come back";
}

/// A scalpel opens it: what the hand pays is its toughness times what has opened, and no tetrahedron suffers.
TEST_F(ShippedScenes, ALobeOfTetrahedraIsOpened) {
  const std::string file = (folder / "lobe.msh").string();
  ASSERT_EQ(palpate("import --phantom lobe --out " + test::quoted(file)), 0) << log;
  const auto summary = simulate("scalpel_mesh", "--set body.lobe.file=" + test::quoted(file));
  const auto &lobe = summary["bodies"]["lobe"], &scalpel = summary["tools"]["scalpel"];
  const double area = 1e-6 * scalpel["cut_area_mm2"].get<double>();
  EXPECT_GT(area, 600e-6) << "some 80 mm long, up to 12 mm deep";
  EXPECT_LT(area, 1000e-6);
  EXPECT_NEAR(summary["energy"]["cut"].get<double>(), 190 * area, 1e-6 * 190 * area);
  EXPECT_EQ(lobe["fragments"], 1);
  EXPECT_EQ(lobe["elements"], lobe["live_elements"]);
  EXPECT_GT(lobe["min_corner_J"].get<double>(), 0.4);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 1e-4);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
}

/// A tip that comes to a cut of before and stands there: lips that lie on each other bear nothing, and feed it nothing.
TEST_F(ShippedScenes, ATipRestsOnACutAsOnWholeTissue) {
  const fs::path scene = folder / "tip_on_a_cut.toml";
  std::ofstream(scene) << R"(title = "A tip on a cut"
gravity_m_per_s2 = [0, 0, 0]
[scene]
seconds = 1.2
[[body]]
name = "block"
lattice = "voxel"
model = "fem"
shape = "box"
size_mm = [24, 20, 10]
spacing_mm = 2
fixed = ["-z", "-y", "+y"]
material = "m"
[material.m]
density_kg_per_m3 = 1000
modulus_kPa = 200
viscosity_Pa_s = 5
cut_toughness_J_per_m2 = 190
[[tool]]
name = "scalpel"
shape = "scalpel"
length_mm = 40
stiffness_N_per_m = 800
device = "one"
[device.one]
driver = "simulated"
hand = "rigid"
force_limit_N = 20
waypoints = [[0, 50, 0.3, -9], [0.4, -30, 0.3, -9], [0.5, -60, 0.3, -9], [1.2, -60, 0.3, -9]]
[[tool]]
name = "tip"
shape = "point"
radius_mm = 3
force_model = "norton"
device = "other"
[device.other]
driver = "simulated"
hand = "rigid"
waypoints = [[0, 0, 1, 20], [0.5, 0, 1, 8], [0.7, 0, 1, 2], [1.2, 0, 1, 2]]
)";
  ASSERT_EQ(palpate("simulate " + test::quoted(scene) + " --no-frames --out " + test::quoted(folder / "cut")),
            0)
      << log;
  const auto summary = read_json((folder / "cut" / "summary.json").string());
  EXPECT_GT(summary["tools"]["scalpel"]["cut_area_mm2"].get<double>(), 200);
  const auto& tip = summary["tools"]["tip"];
  EXPECT_GT(tip["force_peak"].get<double>(), 0.5);
  EXPECT_LT(tip["tissue_work"].get<double>(), 1e-3)
      << "0.3 mJ without a cut, 200 of lips that push it to and fro";
}

/// A patient's gall bladder as a bag of springs, under the pressure of its bile.
class GallBladder : public ShippedScenes {
 protected:
  nlohmann::json with_bladder(const std::string& scene, const std::string& keys = {}) {
    const std::string file = (folder / "gall_bladder.h5").string();
    import_part("85,85 --tetrahedra-mm 4 --largest", file);
    return simulate(scene, "--set body.gall_bladder.file=" + test::quoted(file) + keys);
  }
};

TEST_F(GallBladder, IsOpenedByAScalpel) {
  const auto summary = with_bladder("open_gall_bladder");
  const auto& scalpel = summary["tools"]["scalpel"];
  EXPECT_GT(scalpel["cut_area_mm2"].get<double>(), 15);
  EXPECT_NEAR(scalpel["cut_work"].get<double>(), 120e-6 * scalpel["cut_area_mm2"].get<double>(), 1e-9);
  EXPECT_LT(scalpel["force_peak"].get<double>(), 1);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.001);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
}

TEST_F(GallBladder, OfAnImageIsPressed) {
  const auto summary = with_bladder("gall_bladder");
  const auto& finger = summary["tools"]["finger"];
  // A dent of 5 mm by a ball of 5 mm: some 2 pi R d p = 0.2 N at the most.
  EXPECT_GT(finger["force_peak"].get<double>(), 0.05);
  EXPECT_LT(finger["force_peak"].get<double>(), 0.2);
  EXPECT_LT(finger["felt_off_rms"].get<double>(), 0.2);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
}

/// With liver and gall bladder.
class Dissection : public GallBladder {
 protected:
  nlohmann::json dissect(const std::string& scene) {
    const std::string liver = (folder / "liver.h5").string();
    import_part("255,255 --tetrahedra-mm 17", liver);
    return with_bladder(scene, " --set body.liver.file=" + test::quoted(liver));
  }
};

/// A scalpel frees it, and what is left of its bed when it hangs by little tears.
TEST_F(Dissection, AScalpelFreesAGallBladder) {
  const auto summary = dissect("gallbladder");
  const auto& bed = summary["connections"]["bed"];
  EXPECT_GT(bed["cut"].get<int>(), 0.75 * bed["strands"].get<int>());
  EXPECT_EQ(bed["cut"].get<int>() + bed["torn"].get<int>(), bed["strands"].get<int>());
  EXPECT_EQ(bed["pull"].get<double>(), 0);
  const auto& scalpel = summary["tools"]["scalpel"];
  EXPECT_NEAR(scalpel["cut_work"].get<double>(), 30e-6 * scalpel["cut_area_mm2"].get<double>(), 1e-9);
  EXPECT_NEAR(summary["energy"]["cut"].get<double>(), scalpel["cut_work"].get<double>(), 1e-9);
  EXPECT_LT(scalpel["felt_off_rms"].get<double>(), 0.25);
  EXPECT_LT(scalpel["force_peak"].get<double>(), 30 * 0.032) << "toughness times all of its edge";
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01);
  ASSERT_EQ(summary["warnings"].size(), 1U) << summary["warnings"];
  EXPECT_NE(summary["warnings"][0].get<std::string>().find("\"scalpel\" went through"), std::string::npos);
}

/// Forceps free the gall bladder: all of its bed tears, as one piece, and the liver stays.
TEST_F(Dissection, AGallBladderIsPulledOffItsLiver) {
  const auto summary = dissect("blunt_dissection");
  const auto& bed = summary["connections"]["bed"];
  EXPECT_GT(bed["strands"].get<int>(), 100);
  EXPECT_EQ(bed["torn"], bed["strands"]);
  EXPECT_EQ(bed["pull"].get<double>(), 0);
  const auto& forceps = summary["tools"]["forceps"];
  EXPECT_GT(forceps["force_peak"].get<double>(), 0.5);
  EXPECT_LT(forceps["force_peak"].get<double>(), 3) << "the grip";
  EXPECT_LT(forceps["felt_off_rms"].get<double>(), 0.15);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
}

}  // namespace
}  // namespace palpate
