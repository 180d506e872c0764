// palpate run over fake nodes (tests/support/fake_node.cpp): what it starts, how it ends, what it leaves.

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "common/scene/scene.h"
#include "common/wire/loopback_config.h"
#include "common/wire/participant.h"
#include "tests/system/supervised_run.h"

namespace palpate {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class Supervision : public testing::Test {
 protected:
  /// Moments when the nodes heard that they should stop.
  std::int64_t told_ns(const std::string& node) const { return run.summary().at(node).at("told_ns"); }
  void expect_nobody_left(const std::map<std::string, pid_t>& pids) const {
    for (const auto& [name, pid] : pids) EXPECT_NE(kill(pid, 0), 0) << name << " was left behind";
  }
  static constexpr const char* all_running =
      "physics 1000 Hz x0.00 | haptic 1000 Hz loop 0.0 ms | render 1000 Hz";

  test::SupervisedRun run;
};

TEST_F(Supervision, SeesAllThreeNodesAndGathersWhatTheyLeave) {
  run.start({"--seconds", "1.2"});
  ASSERT_EQ(run.wait(), 0) << run.text("stderr");
  const auto summary = run.summary();
  for (const char* node : {"physics", "haptic", "render"}) {
    EXPECT_EQ(summary["nodes"][node]["seen"], true) << node;
    EXPECT_EQ(summary["nodes"][node]["exit_code"], 0) << node;
    EXPECT_NEAR(summary["nodes"][node]["rate_Hz"].get<double>(), 1000, 1e-9) << node;
  }
  EXPECT_EQ(summary["simulated_s"], 1.5) << "a key of the physics part";
  EXPECT_GE(summary["wall_s"].get<double>(), 1.2);
  EXPECT_EQ(summary["scene"], (run.folder / "scene.toml").string());
  EXPECT_FALSE(std::filesystem::exists(run.out() / "parts"));
  EXPECT_THAT(run.text("stdout"), HasSubstr("summary  " + (run.out() / "summary.json").string()));
  EXPECT_EQ(run.text("stderr"), "");
}

TEST_F(Supervision, CountsSecondsFromTheMomentTheSlowestNodeRuns) {
  const auto start = Clock::now();
  run.start({"--seconds", "0.5"}, {{"FAKE_PHYSICS", "slow"}});
  ASSERT_EQ(run.wait(), 0) << run.text("stderr");
  EXPECT_GT(Clock::now() - start, std::chrono::milliseconds(1500));
}

TEST_F(Supervision, SeesWhatHappensSlowlyToTheEndOfTheScene) {
  run.start({"--set", "scene.seconds=2"}, {{"FAKE_PHYSICS", "behind"}});
  ASSERT_EQ(run.wait(), 0) << run.text("stderr");
  // 4 s from its own start; without a look at the time of the tissue it would be 2 s.
  EXPECT_GT(run.summary()["wall_s"].get<double>(), 2.7);
}

TEST_F(Supervision, StartsOnlyTheNodesAskedFor) {
  run.start({"--nodes", "haptic,physics", "--seconds", "0.3"});
  ASSERT_EQ(run.wait(), 0) << run.text("stderr");
  EXPECT_FALSE(run.summary()["nodes"].contains("render"));
  EXPECT_TRUE(run.summary()["nodes"]["haptic"]["seen"]);
}

TEST_F(Supervision, EndsTheOthersHapticFirstWhenANodeIsKilled) {
  run.start({"--seconds", "60"});
  ASSERT_TRUE(run.said(all_running)) << run.text("stdout");
  const auto pids = run.node_pids();
  ASSERT_EQ(pids.size(), 3U);
  kill(pids.at("palpate-physics"), SIGKILL);
  EXPECT_EQ(run.wait(), 1);
  EXPECT_EQ(run.text("stderr"), "palpate: physics was ended by signal 9 (SIGKILL, Killed)\n");
  EXPECT_LT(told_ns("haptic"), told_ns("render"));
  EXPECT_EQ(run.summary()["nodes"]["physics"]["signal"], 9);
  EXPECT_EQ(run.summary()["nodes"]["render"]["exit_code"], 0);
  expect_nobody_left(pids);
}

TEST_F(Supervision, NamesTheSignalThatHasEndedTheHand) {
  run.start({"--seconds", "60"});
  ASSERT_TRUE(run.said(all_running)) << run.text("stdout");
  kill(run.node_pids().at("palpate-haptic"), SIGSEGV);
  EXPECT_EQ(run.wait(), 1);
  EXPECT_EQ(run.text("stderr"), "palpate: haptic was ended by signal 11 (SIGSEGV, Segmentation fault)\n");
}

TEST_F(Supervision, ReportsANodeThatAborts) {
  run.start({"--seconds", "60"}, {{"FAKE_RENDER", "crash"}});
  EXPECT_EQ(run.wait(), 1);
  EXPECT_THAT(run.text("stderr"), HasSubstr("palpate: render was ended by signal 6"));
  EXPECT_LT(told_ns("haptic"), told_ns("physics"));
}

TEST_F(Supervision, ReturnsTwoWhenANodeFindsAMistake) {
  run.start({"--seconds", "60"}, {{"FAKE_HAPTIC", "mistake"}});
  EXPECT_EQ(run.wait(), 2);
  EXPECT_THAT(run.text("stderr"), HasSubstr("palpate: haptic ended with exit code 2"));
  EXPECT_FALSE(std::filesystem::exists(run.out() / "summary.json"));
}

TEST_F(Supervision, EndsWellWhenAWindowIsClosed) {
  run.start({"--seconds", "60"}, {{"FAKE_RENDER", "leave"}});
  EXPECT_EQ(run.wait(), 0) << run.text("stderr");
  EXPECT_LT(told_ns("haptic"), told_ns("physics"));
}

/// The nodes are fakes, so that the window is one in name only: what counts is who ends the session.
TEST_F(Supervision, StaysOpenWithAWindowWhenTheScenesTimeIsOver) {
  run.headless = false;
  run.start({"--set", "scene.seconds=0.2"}, {{"DISPLAY", ":98765"}});
  const auto heard = [&](const char* words) {
    for (int i = 0; i < 2000 && run.text("stderr").find(words) == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return run.text("stderr").find(words) != std::string::npos;
  };
  ASSERT_TRUE(heard("the 0.2 s of the scene are over; close the window or press Ctrl-C to end"))
      << run.text("stderr");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(run.node_pids().size(), 3u) << "all nodes live on";
  kill(run.pid, SIGINT);
  EXPECT_EQ(run.wait(), 0) << run.text("stderr");
}

TEST_F(Supervision, EndsByItselfWithoutAWindow) {
  run.start({"--set", "scene.seconds=0.2"}, {{"DISPLAY", ":98765"}});
  EXPECT_EQ(run.wait(), 0) << run.text("stderr");
}

// A second is a promise to the person at the device: the least of several stops, since other programs only ever add to one.
TEST_F(Supervision, EndsWithinASecondOfCtrlCWithWholeFiles) {
  double least_s = 1e9;
  for (int n = 0; n < test::tries && least_s >= 1 && !HasFailure(); ++n) {
    run.start({"--seconds", "60"});
    ASSERT_TRUE(run.said(all_running)) << run.text("stdout");
    const auto pids = run.node_pids();
    const auto start = Clock::now();
    kill(run.pid, SIGINT);
    EXPECT_EQ(run.wait(), 0);
    least_s = std::min(least_s, std::chrono::duration<double>(Clock::now() - start).count());
    EXPECT_LT(told_ns("haptic"), told_ns("physics"));
    EXPECT_LT(told_ns("physics"), told_ns("render"));
    EXPECT_FALSE(std::filesystem::exists(run.out() / "parts"));
    expect_nobody_left(pids);
  }
  EXPECT_LT(least_s, 1);
}

TEST_F(Supervision, KillsANodeThatHangsWithinASecondOfCtrlC) {
  double least_s = 1e9;
  for (int n = 0; n < test::tries && least_s >= 1 && !HasFailure(); ++n) {
    run.start({"--seconds", "60"}, {{"FAKE_HAPTIC", "hang"}});
    ASSERT_TRUE(run.said(all_running)) << run.text("stdout");
    const auto pids = run.node_pids();
    const auto start = Clock::now();
    kill(run.pid, SIGINT);
    EXPECT_EQ(run.wait(), 1);
    least_s = std::min(least_s, std::chrono::duration<double>(Clock::now() - start).count());
    EXPECT_EQ(run.text("stderr"), "palpate: haptic did not end when it was told to, and was killed\n");
    EXPECT_EQ(run.summary()["nodes"]["haptic"]["killed"], true);
    EXPECT_EQ(run.summary()["nodes"]["physics"]["exit_code"], 0);
    expect_nobody_left(pids);
  }
  EXPECT_LT(least_s, 1);
}

TEST_F(Supervision, LeavesNoNodeBehindWhenItIsKilledItself) {
  run.start({"--seconds", "60"});
  ASSERT_TRUE(run.said(all_running)) << run.text("stdout");
  const auto pids = run.node_pids();
  ASSERT_EQ(pids.size(), 3U);
  kill(run.pid, SIGKILL);
  EXPECT_EQ(run.wait(), -1);
  const auto gone = [&] {
    return std::all_of(pids.begin(), pids.end(), [](const auto& node) { return kill(node.second, 0) != 0; });
  };
  for (int i = 0; i < 1000 && !gone(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  expect_nobody_left(pids);
}

TEST_F(Supervision, CanBeStoppedWhileANodeIsStillSilent) {
  run.start({"--seconds", "60"}, {{"FAKE_PHYSICS", "mute"}});
  ASSERT_TRUE(run.said("physics starting | haptic 1000 Hz")) << run.text("stdout");
  kill(run.pid, SIGTERM);
  EXPECT_EQ(run.wait(), 0) << run.text("stderr");
  EXPECT_EQ(run.summary()["nodes"]["physics"]["seen"], false);
}

/// A mistake: exit 2, a line that says `words`, and nothing started or written.
void expect_mistake(test::SupervisedRun& run, const std::vector<std::string>& extra,
                    const std::string& words) {
  run.start(extra);
  EXPECT_EQ(run.wait(), 2) << words;
  const std::string said = run.text("stderr");
  EXPECT_THAT(said, HasSubstr(words));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_FALSE(std::filesystem::exists(run.out())) << words;
}

TEST_F(Supervision, RefusesADomainWithAnotherSession) {
  Participant other(run.domain);
  expect_mistake(run, {}, "is taken, by another session perhaps; end that one or choose another domain");
}

TEST_F(Supervision, RefusesAPortThatAnotherProgramHolds) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(discovery_port(run.domain, 2) + 1));
  ASSERT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  expect_mistake(run, {}, "UDP port " + std::to_string(discovery_port(run.domain, 2) + 1));
  close(descriptor);
}

TEST_F(Supervision, RefusesMistakesBeforeAnythingStarts) {
  expect_mistake(run, {"--set", "physics.sped=3"}, "sped");
  expect_mistake(run, {"--set", "body.cube.spacing_mm=-1"}, "spacing_mm");
  expect_mistake(run, {"--nodes", "physics,eye"}, "\"eye\" is not a node");
  expect_mistake(run, {"--nodes", ""}, "names no node");
  expect_mistake(run, {"--device", "nosuch"}, "no driver \"nosuch\"");
  expect_mistake(run, {"--seconds", "-3"}, "--seconds");
  expect_mistake(run, {"--seconds", "soon"}, "--seconds");
  expect_mistake(run, {"--domain", "101"}, "--domain");
  expect_mistake(run, {"--loudly"}, "--loudly");
  std::filesystem::remove(run.folder / "bin" / "palpate-haptic");
  expect_mistake(run, {}, "palpate-haptic: no such program");
  std::ofstream(run.folder / "scene.toml") << "title = \n";
  expect_mistake(run, {}, "scene.toml:1");
  std::filesystem::remove(run.folder / "scene.toml");
  expect_mistake(run, {}, "scene.toml: no such file");
}

TEST_F(Supervision, RefusesAFolderThatCannotBeMade) {
  run.out_folder = run.folder / "scene.toml" / "out";
  expect_mistake(run, {}, run.out_folder.string() + ": cannot be written to");
}

}  // namespace
}  // namespace palpate
