// The scenes that come with palpate: the energy of each is accounted for, and what one promises it keeps.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/report/json_file.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

class ShippedScenes : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "palpate_scenes_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  /// `palpate WORDS`, its output in `log`. @return exit code
  int palpate(const std::string& words) {
    const fs::path file = folder / "log";
    const int status =
        std::system((std::string(PALPATE) + " " + words + " >" + file.string() + " 2>&1").c_str());
    std::ifstream in(file);
    log.assign(std::istreambuf_iterator<char>(in), {});
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

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

  fs::path folder;
  std::string log;
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
