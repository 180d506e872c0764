// The scenes that come with palpate: the energy of each is accounted for, and what one promises it keeps.

#include <gtest/gtest.h>

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
