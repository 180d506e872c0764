// A session of real programs is recorded and run again; one that is killed leaves what was recorded until then.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <regex>
#include <thread>
#include <vector>

#include "common/report/json_file.h"
#include "tests/system/command_run.h"
#include "tests/system/dds_domain.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

class ReplayTest : public CommandRun {
 protected:
  std::string out(const std::string& name) const { return (folder / name).string(); }

  /// `palpate run` of a shipped scene.
  int run(const std::string& scene, const std::string& more, const std::string& name = "live") {
    return palpate("run " + test::quoted(SCENES "/" + scene) + " --headless --domain " +
                   std::to_string(test::own_domain()) + " --out " + test::quoted(out(name)) + " " + more);
  }

  /// The record of a session alone, in another folder.
  std::string taken_away(const std::string& name = "live") const {
    fs::create_directories(folder / "elsewhere");
    const std::string path = out("elsewhere/copied.h5");
    fs::copy_file(out(name) + "/record.h5", path, fs::copy_options::overwrite_existing);
    return path;
  }

  /// The physics node whose command line has our folder.
  std::optional<pid_t> node_of_this_session() const {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::ifstream line(entry.path() / "cmdline");
      const std::string words{std::istreambuf_iterator<char>(line), {}};
      const std::string program = words.substr(0, words.find('\0'));
      if (fs::path(program).filename() == "palpate-physics" && words.find(out("live")) != std::string::npos)
        return std::stoi(entry.path().filename().string());
    }
    return std::nullopt;
  }

  /// Seconds run again, as palpate replay says.
  double seconds_said() const {
    std::smatch found;
    return std::regex_search(log, found, std::regex("([0-9.]+) s run again")) ? std::stod(found[1]) : 0;
  }
};

TEST_F(ReplayTest, UndoesAgainWhatAPersonUndid) {
  const std::string domain = std::to_string(test::own_domain());
  EXPECT_EQ(palpate("undo --domain " + domain), 2);
  EXPECT_NE(log.find("no physics node in domain " + domain), std::string::npos) << log;
  int ended = -1;
  std::thread session([&] { ended = run("scalpel.toml", "--seconds 9"); });
  std::this_thread::sleep_for(
      std::chrono::seconds(6));  // the blade has been led through by then, or is in tissue
  const int asked = std::system((test::quoted(PALPATE) + " undo --domain " + domain).c_str());
  session.join();
  ASSERT_EQ(ended, 0) << log;
  EXPECT_EQ(asked, 0);
  const auto live = read_json(out("live/summary.json"));
  EXPECT_GE(live["strokes"]["begun"], 1);
  EXPECT_EQ(live["strokes"]["undone"], 1);
  ASSERT_EQ(palpate("replay " + test::quoted(out("live/record.h5")) + " --out " + test::quoted(out("again"))),
            0)
      << log;
  EXPECT_NE(log.find("all as recorded"), std::string::npos) << log;
  const auto again = read_json(out("again/summary.json"));
  EXPECT_EQ(again["state_hash"], live["state_hash"]);
  EXPECT_EQ(again["strokes"], live["strokes"]);
}

TEST_F(ReplayTest, GoesOnWhereASessionWas) {
  ASSERT_EQ(run("scalpel.toml", "--seconds 6"), 0) << log;
  const std::string record = out("live/record.h5");
  const auto from = [&](const std::string& more) {
    return "--seconds 2 --from " + test::quoted(record) + more;
  };
  EXPECT_EQ(run("scalpel.toml", from("")), 2) << "would write over what it begins from";
  EXPECT_NE(log.find("give another folder with --out"), std::string::npos) << log;
  EXPECT_EQ(run("scalpel.toml", from(" --at 60"), "second"), 2);
  EXPECT_NE(log.find("cannot begin at 60 s"), std::string::npos) << log;
  EXPECT_EQ(run("scalpel.toml", from(" --set material.soft.modulus_kPa=390"), "second"), 2);
  EXPECT_NE(log.find("scalpel.toml: another state than that of"), std::string::npos) << log;
  const double live_s = read_json(out("live/summary.json"))["simulated_s"];
  const double at = std::floor(0.8 * live_s * 1000) / 1000;  // half cut
  ASSERT_EQ(run("scalpel.toml", from(fmt::format(" --at {:.3f}", at)), "second"), 0) << log;
  const auto second = read_json(out("second/summary.json"));
  EXPECT_NEAR(second["began_s"], at, 0.003);
  EXPECT_GT(second["simulated_s"].get<double>(), second["began_s"].get<double>() + 0.1);
  ASSERT_EQ(
      palpate("replay " + test::quoted(out("second/record.h5")) + " --out " + test::quoted(out("again"))), 0)
      << log;
  EXPECT_NE(log.find("all as recorded"), std::string::npos) << log;
  EXPECT_EQ(read_json(out("again/summary.json"))["state_hash"], second["state_hash"]);
}

TEST_F(ReplayTest, RunsALiveSessionWithBreaksAgain) {
  ASSERT_EQ(run("knife_breaks.toml", "--seconds 2"), 0) << log;
  const auto live = read_json(out("live/summary.json"));
  const std::string record = taken_away();
  fs::remove_all(out("live"));
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(palpate("replay " + test::quoted(record) + " --threads " + threads + " --out " +
                      test::quoted(out("again"))),
              0)
        << log;
    EXPECT_NE(log.find("all as recorded"), std::string::npos) << log;
    EXPECT_NEAR(seconds_said(), live["simulated_s"], 1e-3);
    const auto again = read_json(out("again/summary.json"));
    EXPECT_EQ(again["state_hash"], live["state_hash"]);
    EXPECT_GT(again["bodies"]["block"]["broken_fraction"].get<double>() +
                  again["bodies"]["knife"]["broken_fraction"].get<double>(),
              0)
        << "the test is about what breaks";
  }
  const double half =
      std::floor(500 * live["simulated_s"].get<double>()) / 1000;  // a busy machine simulates little
  ASSERT_EQ(palpate(fmt::format("replay {} --until {:.3f}", test::quoted(record), half)), 0) << log;
  EXPECT_NEAR(seconds_said(), half, 1e-9);
  EXPECT_EQ(
      palpate("replay " + test::quoted(out("again/record.h5")) + " --out " + test::quoted(out("again"))), 2)
      << "would write over what it reads";
  EXPECT_EQ(palpate("replay " + test::quoted(out("again/record.h5"))), 0)
      << "what is run again leaves a record of its own: " << log;
}

TEST_F(ReplayTest, RunsASceneWithoutAHandAgain) {
  ASSERT_EQ(run("fall_crush.toml", "--seconds 1"), 0) << log;
  ASSERT_EQ(palpate("replay " + test::quoted(taken_away())), 0) << log;
  EXPECT_GT(seconds_said(), 0.1) << log;
}

TEST_F(ReplayTest, NamesAFlippedByte) {
  ASSERT_EQ(palpate("simulate " + test::quoted(SCENES "/box_press.toml") + " --no-frames --seconds 1 --out " +
                    test::quoted(out("live"))),
            0)
      << log;
  const std::string record = taken_away();
  std::fstream file(record, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto at = bytes.find("modulus_kPa");  // in the text of the scene
  ASSERT_NE(at, std::string::npos);
  file.seekp(static_cast<std::streamoff>(at));
  file.put('n');
  file.close();
  EXPECT_EQ(palpate("replay " + test::quoted(record)), 2);
  EXPECT_NE(log.find("copied.h5: damaged or truncated in dataset /scene/text"), std::string::npos) << log;
}

TEST_F(ReplayTest, HoldsWhatWasFlushedWhenPhysicsIsKilled) {
  std::thread killer([this] {
    const fs::path record = folder / "live" / "record.h5";
    while (!fs::exists(record)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(3500));
    const auto node = node_of_this_session();
    if (node) kill(*node, SIGKILL);
  });
  EXPECT_EQ(run("box_press.toml", "--seconds 30"), 1) << log;
  killer.join();
  EXPECT_NE(log.find("was cut short"), std::string::npos) << log;
  ASSERT_EQ(palpate("replay " + test::quoted(taken_away())), 0) << log;
  EXPECT_GT(seconds_said(), 0.5) << log;
  EXPECT_EQ(palpate("info " + test::quoted(out("live/record.h5"))), 0);
  EXPECT_EQ(log.find("cut short"), std::string::npos) << "palpate run has mended it: " << log;
}

}  // namespace
}  // namespace palpate
