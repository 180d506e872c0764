// A tip presses a block by 1, 2 and 4 mm: the same force in simulated time and through three processes.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/report/json_file.h"
#include "tests/system/dds_domain.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

struct Row {
  double t = 0, z = 0, force = 0;
};

/// A folder of its own for one test, gone afterwards.
class PressTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "palpate_press_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  /// `palpate WORDS scenes/SCENE.toml --out folder/NAME MORE`. @return exit code
  int palpate(const std::string& words, const std::string& name, const std::string& more = "",
              const std::string& scene = "box_press") const {
    const std::string command =
        test::quoted(PALPATE) + " " + words + " " + test::quoted(SCENES "/" + scene + ".toml") + " --out " +
        test::quoted(folder / name) + " " + more + " >" + test::quoted(folder / (name + ".log")) + " 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::vector<Row> trace(const std::string& name) const {
    std::ifstream file(folder / name / "tool_tip.csv");
    std::vector<Row> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      Row row;
      double x = 0, y = 0, fx = 0, fy = 0, fz = 0;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &row.t, &x, &y, &row.z, &fx, &fy, &fz) !=
          7)
        continue;
      row.force = std::sqrt(fx * fx + fy * fy + fz * fz);
      rows.push_back(row);
    }
    return rows;
  }

  nlohmann::json summary(const std::string& name) const {
    return read_json((folder / name / "summary.json").string());
  }

  fs::path folder;
};

/// Force at the end of the hold at height z, where it has settled: median of the last fifth.
double held_force(const std::vector<Row>& rows, double z) {
  std::vector<double> forces;
  for (const Row& row : rows)
    if (std::abs(row.z - z) < 2e-5) forces.push_back(row.force);
  if (forces.size() < 50) return NAN;
  std::vector<double> last(forces.end() - static_cast<std::ptrdiff_t>(forces.size() / 5), forces.end());
  std::sort(last.begin(), last.end());
  return last[last.size() / 2];
}

double peak(const std::vector<Row>& rows) {
  double most = 0;
  for (const Row& row : rows) most = std::max(most, row.force);
  return most;
}

TEST_F(PressTest, ForceGrowsWithDepthIsTheSameThroughThreeProcessesAndLeavesNothing) {
  ASSERT_EQ(palpate("simulate", "virtual", "--no-frames"), 0);
  ASSERT_EQ(palpate("run", "live", "--headless --domain " + std::to_string(test::own_domain())), 0);
  const auto in_virtual = trace("virtual");
  const auto live = trace("live");

  double before = 0;
  for (const double z : {0.019, 0.018, 0.016}) {  // 1, 2 and 4 mm under the surface of the block
    const double wanted = held_force(in_virtual, z);
    EXPECT_GT(wanted, 1.2 * before) << z;
    EXPECT_NEAR(held_force(live, z), wanted, 0.05 * wanted) << z;
    before = wanted;
  }
  EXPECT_LT(in_virtual.back().force, 0.01 * peak(in_virtual));
  EXPECT_LT(live.back().force, 0.01 * peak(live));

  const auto report = summary("live");
  for (const char* node : {"physics", "haptic", "render"}) {
    EXPECT_TRUE(report["nodes"][node]["seen"].get<bool>()) << node;
    EXPECT_EQ(report["nodes"][node]["exit_code"].get<int>(), 0) << node;
  }
  EXPECT_EQ(report["haptic"]["faults"].get<int>(), 0);
  EXPECT_EQ(report["guard"]["nonfinite"].get<int>(), 0);
  EXPECT_GT(report["render"]["frames"].get<int>(), 0);
  EXPECT_TRUE(fs::exists(folder / "live" / "force.png"));
}

/// 5 Hz and a tap: local planes press tissue with something else, later (0.32 off on this scene).
TEST_F(PressTest, WhereMotionPressesTissueItIsFeltAsItBearsAtAnyRateOfFrames) {
  const std::string scene = "fem_palpate";
  for (const auto& [frame_Hz, most] : {std::pair{"1000", 0.04}, std::pair{"50", 0.04}}) {
    ASSERT_EQ(
        palpate("simulate", frame_Hz, std::string("--no-frames --set physics.frame_Hz=") + frame_Hz, scene),
        0);
    const auto tip = summary(frame_Hz)["tools"]["tip"];
    EXPECT_LT(tip["felt_off_rms"].get<double>(), most) << frame_Hz;
    EXPECT_NEAR(tip["felt_over_true_rms"].get<double>(), 1, most) << frame_Hz;
  }
  ASSERT_EQ(palpate("simulate", "planes", "--no-frames --set tool.tip.force_model=norton", scene), 0);
  EXPECT_GT(summary("planes")["tools"]["tip"]["felt_off_rms"].get<double>(), 0.2);
}

TEST_F(PressTest, SimulatesTheSameBitsTwiceAndOnTwoThreads) {
  ASSERT_EQ(palpate("simulate", "once", "--no-frames --seconds 1"), 0);
  ASSERT_EQ(palpate("simulate", "again", "--no-frames --seconds 1"), 0);
  ASSERT_EQ(palpate("simulate", "two", "--no-frames --seconds 1 --threads 2"), 0);
  ASSERT_EQ(palpate("simulate", "other", "--no-frames --seconds 1 --set material.soft.modulus_kPa=11"), 0);
  EXPECT_EQ(summary("once")["state_hash"], summary("again")["state_hash"]);
  EXPECT_EQ(summary("once")["state_hash"], summary("two")["state_hash"]);
  EXPECT_NE(summary("once")["state_hash"], summary("other")["state_hash"]);
  EXPECT_EQ(summary("two")["threads"].get<int>(), 2);
}

}  // namespace
}  // namespace palpate
