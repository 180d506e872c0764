// The scenes that come with palpate: the energy of each is accounted for, and what one promises it keeps.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

#include "common/report/json_file.h"
#include "tests/system/command_run.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

class ShippedScenes : public CommandRun {
 protected:
  nlohmann::json simulate(const std::string& scene, const std::string& more) {
    const fs::path out = folder / scene;
    EXPECT_EQ(palpate("simulate " + std::string(SCENES) + "/" + scene + ".toml --no-frames --out " +
                      out.string() + " " + more),
              0)
        << log;
    const auto summary = read_json((out / "summary.json").string());
    EXPECT_GT(summary["energy"]["exchanged"].get<double>(), 0) << scene;
    EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01) << scene;
    EXPECT_EQ(summary["guard"]["restored"].get<int>(), 0) << scene;
    return summary;
  }
};

TEST_F(ShippedScenes, OfMadeBodiesAccountForTheirEnergy) {
  simulate("box_press", "");
  simulate("block_100k", "--seconds 0.9");
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
  ASSERT_EQ(palpate("import --phantom aneurysm --out " + file), 0) << log;
  const auto summary = simulate("aneurysm", "--seconds 0.7 --set body.vessels.file=" + file);
  EXPECT_GT(summary["tools"]["tip"]["force_peak"].get<double>(), 0.01);
  EXPECT_LT(summary["bodies"]["vessels"]["masses"].get<int>(), 10000);
}

TEST_F(ShippedScenes, ALumpIsFelt) {
  simulate("inclusion", "--seconds 6");
  // Held 2 mm deep beside the lump at 2.4 s, over it at 5.9 s.
  std::ifstream in(folder / "inclusion" / "tool_tip.csv");
  double beside = 0, over = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::array<double, 7> x{};
    char comma = 0;
    for (double& value : x) words >> value >> comma;
    if (std::abs(x[0] - 2.4) < 1e-6) beside = x[6];
    if (std::abs(x[0] - 5.9) < 1e-6) over = x[6];
  }
  EXPECT_GT(beside, 0.1);
  EXPECT_GT(over, 1.23 * beside);
}

TEST_F(ShippedScenes, WithAStepFarTooLongEndWithADiagnosis) {
  const fs::path out = folder / "out";
  EXPECT_EQ(palpate("simulate " + std::string(SCENES) + "/box_press.toml --no-frames --out " + out.string() +
                    " --set physics.step_ms=1 --set material.soft.modulus_kPa=1e8"),
            1);
  EXPECT_NE(log.find("expect the guard to act"), std::string::npos) << log;
  EXPECT_NE(log.find("body \"block\" cannot be stepped"), std::string::npos) << log;
  const auto summary = read_json((out / "summary.json").string());
  EXPECT_EQ(summary["guard"]["halved"].get<int>(), 6);
  EXPECT_TRUE(summary["guard"].contains("stopped"));
}

}  // namespace
}  // namespace palpate
