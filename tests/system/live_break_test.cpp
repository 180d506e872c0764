// A body that breaks in one process and is looked at from another one.

#include <fmt/format.h>

#include "common/report/json_file.h"
#include "tests/system/command_run.h"
#include "tests/system/dds_domain.h"

namespace palpate {
namespace {

class LiveBreak : public CommandRun {
 protected:
  /// @return the summary of scenes/fall_crack.toml
  nlohmann::json summary_of(const std::string& command) {
    const auto out = folder / "out";
    EXPECT_EQ(palpate(command + " --out " + test::quoted(out)), 0) << log;
    auto summary = read_json((out / "summary.json").string());
    std::filesystem::remove_all(out);
    return summary;
  }
};

TEST_F(LiveBreak, ReachesTheEyeAsWhatChangedAndLeavesItWithTheSameFacets) {
  const std::string scene = test::quoted(std::string(SCENES) + "/fall_crack.toml");
  const auto live = summary_of("run " + scene + " --headless --nodes physics,render --domain " +
                               std::to_string(test::own_domain()));
  // Physics goes on until it is told to end, and tissue may break until then.
  const auto alone = summary_of(
      fmt::format("simulate {} --set scene.seconds={:.6f}", scene, live["simulated_s"].get<double>()));
  EXPECT_EQ(live["state_hash"], alone["state_hash"]);
  EXPECT_EQ(live["render"]["facets_visible"], alone["render"]["facets_visible"]);
  EXPECT_EQ(live["render"]["facets_total"], alone["render"]["facets_total"]);
  const auto& said = live["wire"]["physics"];
  const auto& heard = live["wire"]["render"]["heard"];
  for (const char* topic : {"BodySurface", "SurfaceChange", "VertexBlock"}) {
    EXPECT_GT(heard[topic]["received"].get<int>(), 0) << topic;
    EXPECT_TRUE(heard[topic]["rejected"].empty()) << topic << heard[topic];
  }
  const auto& bytes = live["surface_bytes"];
  EXPECT_EQ(bytes["first"], 65'588) << "one chunk";
  EXPECT_LE(said["BodySurface"]["bytes"].get<int>() + said["SurfaceChange"]["bytes"].get<int>(),
            bytes["first"].get<int>() + bytes["sent"].get<int>())
      << "what waits when there is something newer is not sent";
  EXPECT_LT(bytes["sent"].get<int>(), bytes["whole"].get<int>());
}

}  // namespace
}  // namespace palpate
