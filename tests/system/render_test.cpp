// palpate-render as a process: fed over DDS by this test, headless and under a virtual display.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "common/error/error.h"
#include "common/report/json_file.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "tests/system/dds_domain.h"
#include "tests/system/patience.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr double gone_within_s = 1;  // 0.3 where nothing else runs

constexpr const char* scene_text = R"(title = "A cube and a finger"
[material.gel]
density_kg_per_m3 = 1000.0
modulus_kPa = 10
[[body]]
name = "cube"
shape = "box"
size_mm = [20, 20, 20]
lattice = "voxel"
spacing_mm = 5
material = "gel"
[[tool]]
name = "finger"
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 30], [1, 0, 0, 8]]
[render]
size_px = [320, 240]
rate_Hz = 10
)";

template <class Done>
bool eventually(Done done) {
  const auto end = Clock::now() + test::patience;
  while (!done()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

/// The node under test and everything it hears and says.
class RenderNode : public testing::Test {
 protected:
  RenderNode() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "scene.toml") << scene_text;
  }
  ~RenderNode() override {
    if (pid > 0) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
    fs::remove_all(folder);
  }

  void start(std::vector<std::string> words) {
    words.insert(words.end(), {(folder / "scene.toml").string(), "--out", (folder / "out").string(),
                               "--domain", std::to_string(test::own_domain())});
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid = fork();
    if (pid != 0) return;
    execv(argv[0], argv.data());
    _exit(127);
  }

  /// Waits for the end. @return exit code, or -1 if it does not end or was killed
  int end_code() {
    int status = 0;
    if (!eventually([&] { return waitpid(pid, &status, WNOHANG) == pid; })) return -1;
    pid = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  bool hears_me() {
    return eventually(
        [&] { return surfaces.matched() == 1 && blocks.matched() == 1 && commands.matched() == 1; });
  }

  void show_cube() {
    for (const auto& chunk : render::test::chunks_of(cube, 0, 1)) ASSERT_TRUE(surfaces.write(chunk));
  }

  /// Simulated time goes on by 1 s in steps of 10 ms, three times as slowly as the wall's.
  void move_cube_for_a_second() {
    auto block = std::make_unique<VertexBlock>(render::test::block_of(cube, 0, 1, 0));
    for (int i = 0; i < 100; ++i) {
      block->tick += 1;
      block->t += 0.01;
      for (auto& p : block->position) p[2] += 0.0001F;
      ASSERT_TRUE(blocks.write(*block));
      std::this_thread::sleep_for(30ms);
      // A machine that has no time for pictures now gets it before the next tenth begins.
      const std::size_t due = static_cast<std::size_t>(i + 1) / 10;
      if ((i + 1) % 10 != 0) continue;
      ASSERT_TRUE(eventually([&] { return frames() + 2 >= due; }));
    }
  }

  /// Waits until it runs and has drawn so many pictures; without a window it draws none while no simulated time
  /// passes. @return its process, 0 if that takes too long
  pid_t draws(std::uint64_t pictures) {
    NodeStatus status;
    const bool running = eventually([&] {
      while (statuses.take(status)) {
        if (status.phase == NodePhase::running && status.ticks >= pictures &&
            kill(static_cast<pid_t>(status.pid), 0) == 0)
          return true;
      }
      return false;
    });
    return running ? static_cast<pid_t>(status.pid) : 0;
  }
  fs::path report() const { return folder / "out" / "parts" / "render.json"; }

  std::size_t frames() const {
    const auto frames = folder / "out" / "frames";
    if (!fs::exists(frames)) return 0;
    std::size_t n = 0;
    for (const auto& entry : fs::directory_iterator(frames)) n += entry.path().extension() == ".png" ? 1 : 0;
    return n;
  }

  const fs::path folder = fs::path(testing::TempDir()) / ("palpate_render_" + std::to_string(getpid()));
  const render::test::VoxelSurface cube = render::test::cube_surface(8, 0.02, 0xff96b4e6U);
  Participant participant{test::own_domain()};
  Writer<BodySurface> surfaces{participant};
  Writer<VertexBlock> blocks{participant};
  Writer<Command> commands{participant};
  Reader<NodeStatus> statuses{participant};
  pid_t pid = -1;
};

TEST_F(RenderNode, DrawsAFrameForEveryTenthOfASimulatedSecond) {
  start({PALPATE_RENDER, "--headless"});
  ASSERT_TRUE(hears_me());
  show_cube();
  move_cube_for_a_second();
  ASSERT_TRUE(eventually([&] { return frames() >= 8; }));
  NodeStatus status, newest;
  while (statuses.take(status)) newest = status;
  EXPECT_EQ(newest.node, NodeKind::render);
  EXPECT_EQ(newest.pid, static_cast<std::uint32_t>(pid));
  EXPECT_GT(newest.samples_received, 50U);

  kill(pid, SIGTERM);
  EXPECT_EQ(end_code(), exit_ok);
  EXPECT_LE(frames(), 11U);
  const auto report = read_json((folder / "out" / "parts" / "render.json").string()).at("render");
  EXPECT_EQ(report.at("frames").get<std::size_t>(), frames());
  EXPECT_EQ(report.at("facets_visible").get<std::size_t>(), cube.corners.size());
  EXPECT_EQ(report.at("facets_total").get<std::size_t>(), cube.corners.size() + cube.facets_hidden);
  EXPECT_GT(report.at("fps").get<double>(), 1.0);
  EXPECT_TRUE(fs::exists(folder / "out" / "frames" / "frame_00001.png"));
}

TEST_F(RenderNode, ObeysTheCommandStopBeforeAnythingCame) {
  start({PALPATE_RENDER, "--headless"});
  ASSERT_TRUE(hears_me());
  Command stop;
  stop.id = 1;
  stop.kind = CommandKind::stop;
  ASSERT_TRUE(commands.write(stop));
  EXPECT_EQ(end_code(), exit_ok);
  EXPECT_EQ(read_json((folder / "out" / "parts" / "render.json").string()).at("render").at("frames"), 0);
}

TEST_F(RenderNode, CallsAFolderThatCannotBeMadeAMistake) {
  std::ofstream(folder / "out") << "a file where a folder should be";
  start({PALPATE_RENDER, "--headless"});
  EXPECT_EQ(end_code(), exit_mistake);
}

TEST_F(RenderNode, OpensAWindowWhereThereIsADisplayAndLeavesOnSigterm) {
  setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // the system's GLX library keeps some bytes
  // xvfb-run passes signals on to nobody, so the node's own pid, from its status, gets the signal.
  start({XVFB_RUN, "-a", "-s", "-screen 0 640x480x24", PALPATE_RENDER});
  ASSERT_TRUE(hears_me());
  show_cube();
  const pid_t node = draws(6);
  ASSERT_GT(node, 0);
  EXPECT_EQ(frames(), 0U);  // a window, not files
  kill(node, SIGTERM);
  ASSERT_TRUE(eventually([&] { return fs::exists(report()); }));
  EXPECT_EQ(end_code(), exit_ok);  // xvfb-run gives the node's
  EXPECT_GT(read_json(report().string()).at("render").at("frames").get<int>(), 5);
}

/// The least of several, since other programs only ever add to one.
TEST_F(RenderNode, IsGoneWithinASecond) {
  setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  const std::vector<std::string> drawing_to_files = {PALPATE_RENDER, "--headless"};
  const std::vector<std::string> in_a_window = {XVFB_RUN, "-a", "-s", "-screen 0 640x480x24", PALPATE_RENDER};
  for (const auto& words : {drawing_to_files, in_a_window}) {
    double least_s = 1e9;
    for (int n = 0; n < test::tries && least_s >= gone_within_s; ++n) {
      fs::remove(report());
      start(words);
      ASSERT_TRUE(hears_me());
      show_cube();
      const pid_t node = draws(words == in_a_window ? 6 : 0);
      ASSERT_GT(node, 0);
      const auto asked = Clock::now();
      kill(node, SIGTERM);
      ASSERT_TRUE(eventually([&] { return fs::exists(report()); }));
      least_s = std::min(least_s, std::chrono::duration<double>(Clock::now() - asked).count());
      EXPECT_EQ(end_code(), exit_ok);
      ASSERT_TRUE(eventually([&] { return commands.matched() == 0; })) << "it has taken its leave";
    }
    EXPECT_LT(least_s, gone_within_s) << words.back();
  }
}

}  // namespace
}  // namespace palpate
