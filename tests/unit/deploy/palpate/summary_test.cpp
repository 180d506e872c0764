#include "deploy/palpate/summary.h"
#include "deploy/palpate/hand_warnings.h"

#include <gtest/gtest.h>

#include "common/report/json_file.h"
#include "common/scene/scene.h"
#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

class Summary : public testing::Test {
 protected:
  Summary() {
    std::filesystem::create_directories(folder / "parts");
    scene.path = "scenes/cube.toml";
    scene.seed = 4;
    result.wall_s = 2.5;
    result.nodes = {{.node = NodeKind::physics,
                     .seen = true,
                     .ending = Ending{false, 0},
                     .killed = false,
                     .mean_rate_Hz = 998,
                     .mean_real_time_factor = 0.998},
                    {.node = NodeKind::haptic,
                     .seen = true,
                     .ending = Ending{true, 11},
                     .killed = false,
                     .mean_rate_Hz = 0,
                     .mean_real_time_factor = 0}};
  }
  test::TemporaryFolder folder;
  Scene scene;
  SessionResult result;
};

TEST_F(Summary, HoldsTheKeysOfAllParts) {
  folder.write("parts/physics.json", R"({"steps": 10, "wall_s": 2.25, "scene": "from physics"})");
  folder.write("parts/haptic.json", R"({"haptic": {"rate_Hz": 1000}})");
  const auto summary = merged_summary(folder.path(), scene, result);
  EXPECT_EQ(summary["steps"], 10);
  EXPECT_EQ(summary["haptic"]["rate_Hz"], 1000);
  EXPECT_EQ(summary["wall_s"], 2.25) << "what a node says stands";
  EXPECT_EQ(summary["scene"], "from physics");
  EXPECT_EQ(summary["seed"], 4);
  EXPECT_FALSE(summary.contains("render"));
}

TEST_F(Summary, SaysWhatBecameOfEachNode) {
  const auto nodes = merged_summary(folder.path(), scene, result)["nodes"];
  EXPECT_EQ(
      nodes["physics"],
      (nlohmann::json{{"seen", true}, {"exit_code", 0}, {"rate_Hz", 998.0}, {"real_time_factor", 0.998}}));
  EXPECT_EQ(nodes["haptic"], (nlohmann::json{{"seen", true}, {"signal", 11}}));
}

TEST_F(Summary, HoldsTheWarningsOfAllParts) {
  folder.write("parts/physics.json", R"({"warnings": ["one", "two"]})");
  folder.write("parts/haptic.json", R"({"warnings": ["three", "one"], "haptic": {}})");
  folder.write("parts/render.json", R"({"render": {}})");
  const nlohmann::json summary = merged_summary(folder.path(), scene, result);
  EXPECT_EQ(summary["warnings"], (nlohmann::json{"one", "two", "three"}));
  EXPECT_EQ(summary["guard"]["warnings"], 3);
}

TEST_F(Summary, SaysInWordsWhatTheCountsOfTheHandMean) {
  folder.write("parts/haptic.json",
               R"({"haptic": {"stale_events": 3, "safe_events": 0, "faults": 1, "watchdog_stops": 0}})");
  const auto warnings = merged_summary(folder.path(), scene, result)["warnings"];
  ASSERT_EQ(warnings.size(), 2u) << warnings;
  EXPECT_EQ(warnings[0].get<std::string>().find("physics was silent for the hand 3 time(s)"), 0u);
  EXPECT_EQ(warnings[1].get<std::string>().find("a device had 1 fault(s)"), 0u);
}

/// A line that names tool and cause needs no second one that counts it.
TEST_F(Summary, SaysNothingMoreOfFaultsThatAreNamed) {
  const nlohmann::json summary = {{"haptic", {{"stale_events", 3u}, {"faults", 1u}}}};
  EXPECT_EQ(hand_warnings(summary, Faults::counted).size(), 2u);
  const auto others = hand_warnings(summary, Faults::named);
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].find("physics was silent"), 0u);
}

TEST_F(Summary, HasWarningsWhereNobodyWarns) {
  folder.write("parts/physics.json", R"({"warnings": "not an array"})");
  EXPECT_EQ(merged_summary(folder.path(), scene, result)["warnings"], nlohmann::json::array());
}

TEST_F(Summary, LeavesOutAPartThatWasCutShort) {
  folder.write("parts/physics.json", R"({"steps": 10, "wall)");
  folder.write("parts/haptic.json", R"({"haptic": {}})");
  testing::internal::CaptureStderr();
  const auto summary = merged_summary(folder.path(), scene, result);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("physics.json"), std::string::npos);
  EXPECT_FALSE(summary.contains("steps"));
  EXPECT_TRUE(summary.contains("haptic"));
}

TEST_F(Summary, ReplacesTheParts) {
  folder.write("parts/physics.json", R"({"steps": 10})");
  EXPECT_EQ(read_json(write_summary(folder.path(), scene, result).string())["steps"], 10);
  EXPECT_FALSE(std::filesystem::exists(folder / "parts"));
}

}  // namespace
}  // namespace palpate::deploy
