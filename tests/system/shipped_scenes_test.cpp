// The scenes that come with palpate: the energy of each is accounted for, and what one promises it keeps.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "common/message/vec3.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/world.h"
#include "tests/system/shipped_scenes.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using test::ShippedScenes;

TEST_F(ShippedScenes, OfMadeBodiesAccountForTheirEnergy) {
  simulate("box_press", "");
  simulate("block_100k", "--seconds 0.9");
}

TEST_F(ShippedScenes, StripOfFiniteElementsTearsInTwo) {
  const auto summary = simulate("fem_tear", "");
  const auto& strip = summary["bodies"]["strip"];
  EXPECT_EQ(strip["outcome"], "disunion");
  EXPECT_GT(strip["largest_fragment"].get<double>(), 0.5);
  EXPECT_GT(strip["second_fragment"].get<double>(), 0.15);
  EXPECT_GT(strip["min_corner_J"].get<double>(), 0.3);
  EXPECT_GT(summary["energy"]["broken"].get<double>(), 1e-3);
}

TEST_F(ShippedScenes, ClayKeepsItsDent) {
  const auto summary = simulate("fem_yield", "");
  const auto &block = summary["bodies"]["block"], &ball = summary["bodies"]["ball"];
  EXPECT_EQ(ball["outcome"], "crush");
  EXPECT_GT(ball["yielded_fraction"].get<double>(), 0.5);
  EXPECT_GT(block["yielded_fraction"].get<double>(), 0.06);
  EXPECT_LT(block["yielded_fraction"].get<double>(), 0.5) << "only where it was pressed";
  EXPECT_GT(block["shape_rms_m"].get<double>(), 0.1e-3);
  for (const auto& body : {block, ball}) EXPECT_GT(body["min_corner_J"].get<double>(), 0.1);
  EXPECT_GT(summary["energy"]["plastic"].get<double>(), 1e-3);
}

/// Pressed, turned and drawn along with friction, a stick is felt as it is borne, with its lever; the hand's work goes into friction.
TEST_F(ShippedScenes, StickIsFeltAsItIsBorne) {
  const auto summary = simulate("fem_stick", "");
  const auto& stick = summary["tools"]["stick"];
  EXPECT_LT(stick["felt_off_rms"].get<double>(), 0.05);
  EXPECT_NEAR(stick["felt_over_true_rms"].get<double>(), 1, 0.03);
  const double lever =
      summary["haptic"]["torque_max_N_m"].get<double>() / summary["haptic"]["force_max_N"].get<double>();
  EXPECT_NEAR(lever, 0.056, 0.006)
      << "50 mm from the tip to the middle of the block, and more where the far end is deeper";
  const double rubbed = 0.3 * 0.43 * 0.012;  // mu F d
  EXPECT_NEAR(stick["hand_work"].get<double>(), rubbed, 0.15 * rubbed);
  EXPECT_LT(std::abs(stick["tissue_work"].get<double>()), 0.1 * rubbed) << "elastic tissue keeps nothing";
}

TEST_F(ShippedScenes, VesselPushedAsideReturns) {
  const auto summary = simulate("vessel_push", "");
  // Let go at 2 s; its length is 1 m.
  EXPECT_NEAR(summary["simulated_s"].get<double>(), 7, 1e-6);
  EXPECT_LT(summary["bodies"]["vessel"]["shape_rms_m"].get<double>(), 1e-3);
  const auto held = simulate("vessel_push", "--seconds 2");
  EXPECT_GT(held["bodies"]["vessel"]["shape_rms_m"].get<double>(), 0.01);
}

TEST_F(ShippedScenes, AneurysmOfAMadeAngiogramIsPressed) {
  const std::string file = (folder / "angiogram.h5").string();
  ASSERT_EQ(palpate("import --phantom aneurysm --out " + test::quoted(file)), 0) << log;
  const auto summary = simulate("aneurysm", "--seconds 0.7 --set body.vessels.file=" + file);
  EXPECT_GT(summary["tools"]["tip"]["force_peak"].get<double>(), 0.01);
  EXPECT_LT(summary["bodies"]["vessels"]["masses"].get<int>(), 10000);
}

/// In, half way back, in again and beyond, and out.
TEST_F(ShippedScenes, ANeedleGoesIntoALobe) {
  const std::string file = (folder / "lobe.msh").string();
  ASSERT_EQ(palpate("import --phantom lobe --out " + test::quoted(file)), 0) << log;
  const auto summary = simulate("needle", "--set body.lobe.file=" + test::quoted(file));
  const auto& needle = summary["tools"]["needle"];
  const double goes_on = 164 * 1.5e-3;
  EXPECT_EQ(needle["punctures"].get<int>(), 1);
  EXPECT_NEAR(needle["puncture_force"].get<double>(), 2 * goes_on, 0.02 * goes_on);
  EXPECT_GT(needle["deepest_mm"].get<double>(), 15);
  EXPECT_NEAR(needle["cut_area_mm2"].get<double>(), 1.5 * needle["deepest_mm"].get<double>(), 1);
  EXPECT_NEAR(summary["energy"]["cut"].get<double>(), needle["cut_work"].get<double>(), 1e-9);
  EXPECT_GT(needle["shaft_friction_work"].get<double>(), 2e-3);
  EXPECT_NEAR(needle["felt_over_true_rms"].get<double>(), 1, 0.15);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 1e-4);
}

/// Pressed, recorded, drawn, exported; and run again from its record alone it has the same bits.
TEST_F(ShippedScenes, ALobeOfTetrahedraIsPressed) {
  const std::string file = (folder / "lobe.msh").string(),
                    set = " --set body.lobe.file=" + test::quoted(file);
  ASSERT_EQ(palpate("import --phantom lobe --out " + test::quoted(file)), 0) << log;
  const auto summary = simulate("fem_mesh", "--set 'record.what=[\"positions\"]'" + set);
  const auto& lobe = summary["bodies"]["lobe"];
  EXPECT_GT(summary["tools"]["tip"]["force_peak"].get<double>(), 0.3);
  EXPECT_EQ(lobe["elements"], 6336);
  EXPECT_GT(lobe["min_corner_J"].get<double>(), 0.3);
  EXPECT_EQ(lobe["outcome"], "restitution");
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
  const std::string record = (folder / "fem_mesh" / "record.h5").string(),
                    again = (folder / "again").string();
  EXPECT_TRUE(fs::exists(folder / "fem_mesh" / "record.pvd"));
  ASSERT_EQ(palpate("replay " + test::quoted(record) + " --out " + test::quoted(again)), 0) << log;
  EXPECT_EQ(read_json(again + "/summary.json")["state_hash"], summary["state_hash"]);
  EXPECT_TRUE(fs::exists(again + "/record.pvd")) << "read anew from the mesh that the record has";
}

/// A patient's liver, from a labelled image to a force: what the hand feels is what the tissue bears.
TEST_F(ShippedScenes, ALiverOfAnImageIsPalpated) {
  const std::string file = (folder / "liver.h5").string();
  import_part("255,255 --tetrahedra-mm 9.7", file);
  ASSERT_EQ(palpate("info " + test::quoted(file)), 0) << log;
  EXPECT_NE(log.find("in 1 piece and 1 region"), log.npos) << log;
  const auto summary = simulate("liver", "--seconds 1.5 --set body.liver.file=" + test::quoted(file));
  const auto& finger = summary["tools"]["finger"];
  EXPECT_GT(finger["force_peak"].get<double>(), 0.2);
  EXPECT_LT(finger["felt_off_rms"].get<double>(), 0.03);
  EXPECT_NEAR(summary["bodies"]["liver"]["elements"].get<int>(), 22400, 500);
  EXPECT_GT(summary["bodies"]["liver"]["min_corner_J"].get<double>(), 0.1);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
}

/// Rows of a tool's CSV: t, x, y, z, fx, fy, fz.
std::vector<std::array<double, 7>> read_trace(const fs::path& file) {
  std::vector<std::array<double, 7>> rows;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    char comma = 0;
    for (double& value : rows.emplace_back()) words >> value >> comma;
  }
  return rows;
}

/// What physics answers without a hand: a steady force F at the place x until all rests, in series with the hand's spring. The
/// displacement is the one that the nodal forces do work on. [N/m]
double quasi_static_stiffness(const Scene& scene, const Vec3& x, double F) {
  physics::World world(scene);
  ToolState state;
  state.engaged = 1;
  state.p_WT = array(x);
  const double K = scene.tools[0].stiffness;
  state.proxy = array(Vec3(x + Vec3(0, 0, F / K)));
  state.force_on_hand = state.force_now = {0, 0, F};
  for (std::uint64_t n = 1; n <= 2000; ++n) {
    state.tick = n;
    const std::optional<ToolState> hand = state;
    world.frame(std::span(&hand, 1));
  }
  double work = 0;
  for (const auto& f : dynamic_cast<const physics::PressingTool&>(world.tool(0)).forces())
    work += f.force.dot(world.body(0).displacement(f.cell));
  return 1 / (work / (F * F) + 1 / K);
}

TEST_F(ShippedScenes, ALumpIsFelt) {
  simulate("inclusion", "--seconds 6");
  // Held 2 mm deep beside the lump at 2.4 s, over it at 5.9 s.
  constexpr double depth = 0.002;
  double beside = 0, over = 0;
  for (const auto& x : read_trace(folder / "inclusion" / "tool_tip.csv")) {
    if (std::abs(x[0] - 2.4) < 1e-6) beside = x[6];
    if (std::abs(x[0] - 5.9) < 1e-6) over = x[6];
  }
  ASSERT_GT(beside, 0.1);
  EXPECT_GT(over, 1.23 * beside);
  // Pressed by a force that is told, not by a motion.
  const Scene scene = load_scene(std::string(SCENES) + "/inclusion.toml", {"tool.tip.force_model=norton"});
  const double soft = quasi_static_stiffness(scene, {-0.03, 0, 0.014}, beside);
  const double hard = quasi_static_stiffness(scene, {0.03, 0, 0.014}, over);
  std::printf("felt %.4f and %.4f N, %.1f and %.1f N/m; physics alone %.1f and %.1f N/m\n", beside, over,
              beside / depth, over / depth, soft, hard);
  EXPECT_NEAR(beside / depth, soft, 0.05 * soft);
  EXPECT_NEAR(over / depth, hard, 0.05 * hard);
}

TEST_F(ShippedScenes, WithAStepFarTooLongEndWithADiagnosis) {
  const fs::path out = folder / "out";
  EXPECT_EQ(palpate("simulate " + test::quoted(SCENES "/box_press.toml") + " --no-frames --out " +
                    test::quoted(out) + " --set physics.step_ms=1 --set material.soft.modulus_kPa=1e8"),
            1);
  EXPECT_NE(log.find("expect the guard to act"), std::string::npos) << log;
  EXPECT_NE(log.find("body \"block\" cannot be stepped"), std::string::npos) << log;
  const auto summary = read_json((out / "summary.json").string());
  EXPECT_EQ(summary["guard"]["halved"].get<int>(), 6);
  EXPECT_TRUE(summary["guard"].contains("stopped"));
}

}  // namespace
}  // namespace palpate
