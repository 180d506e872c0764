// What a visitor does first, with real processes under a virtual display (CMakeLists.txt): click on the cheek, turn
// the wheel, feel it.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "common/report/json_file.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "tests/system/dds_domain.h"
#include "tests/system/patience.h"
#include "tests/system/shell.h"
// Last: Xlib's macros.
#include "tests/unit/render_node/ui/window_hand.h"

namespace palpate {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr double enough_N = 0.1;
constexpr double within_s = 20;  // of the hand's clock, which begins before there is anything to see

constexpr const char* cheek = R"(title = "A cheek"
gravity_m_per_s2 = [0, 0, 0]
[[body]]
name = "cheek"
shape = "sphere"
radius_mm = 40
lattice = "voxel"
model = "fem"
spacing_mm = 6
material = "soft"
fixed = [{ min_mm = [-50, 10, -50], max_mm = [50, 50, 50] }]
[material.soft]
density_kg_per_m3 = 1000.0
modulus_kPa = 5.0
viscosity_Pa_s = 1.0
[[tool]]
name = "finger"
shape = "point"
radius_mm = 8
device = "hand"
[device.hand]
driver = "mouse"
[render]
size_px = [1024, 768]
camera = { yaw_deg = 0, pitch_deg = 10 }
)";

class FeelByMouse : public testing::Test {
 protected:
  FeelByMouse() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "cheek.toml") << cheek;
  }
  ~FeelByMouse() override {
    if (session.joinable()) stop();
    fs::remove_all(folder);
  }
  void start() {
    const std::string command = test::quoted(PALPATE) + " run " + test::quoted(folder / "cheek.toml") +
                                " --domain " + std::to_string(test::own_domain()) + " --out " +
                                test::quoted(folder / "out") + " >" + test::quoted(folder / "log") + " 2>&1";
    session = std::thread([this, command] { status = std::system(command.c_str()); });
  }
  /// Whatever became of the test: the session ends.
  void stop() {
    Participant participant(test::own_domain());
    Writer<Command> commands(participant);
    Command command;
    command.kind = CommandKind::stop;
    for (const auto end = std::chrono::steady_clock::now() + test::patience;
         status == running && commands.matched() == 0 && std::chrono::steady_clock::now() < end;)
      std::this_thread::sleep_for(20ms);
    commands.write(command);
    session.join();
  }
  /// The window, once it shows the tissue and the hand is ready.
  std::unique_ptr<render::test::WindowHand> hand_at_the_window() {
    const auto end = std::chrono::steady_clock::now() + test::patience;
    while (!fs::exists(folder / "out"))  // it wants the ports of its domain for itself until it has begun
      if (status != running || std::chrono::steady_clock::now() > end) return nullptr;
    wire = std::make_unique<Wire>();
    for (bool shown = false, ready = false; !shown || !ready; std::this_thread::sleep_for(20ms)) {
      if (status != running || std::chrono::steady_clock::now() > end) return nullptr;
      for (NodeStatus node; wire->statuses.take(node);) {
        shown =
            shown || (node.node == NodeKind::render && node.phase == NodePhase::running && node.ticks > 2);
        ready = ready || (node.node == NodeKind::haptic && node.phase != NodePhase::loading);
      }
    }
    return std::make_unique<render::test::WindowHand>("A cheek");
  }
  void hear() {
    for (HapticTrace trace; wire->traces.take(trace);)
      for (std::uint32_t i = 0; i < trace.n_samples; ++i) {
        t = trace.samples[i].t;
        const auto& f = trace.samples[i].force;
        felt = std::max(felt, std::hypot(f[0], f[1], f[2]));
        if (felt > enough_N && felt_at == 0) felt_at = t;
      }
  }

  /// Frames of the tissue, once it stands still for three statuses on end.
  std::uint64_t frames_at_rest() {
    std::uint64_t frames = 0;
    const auto end = std::chrono::steady_clock::now() + test::patience;
    for (int same = 0; same < 3 && std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(20ms))
      for (NodeStatus node; wire->statuses.take(node);) {
        if (node.node != NodeKind::physics) continue;
        same = node.ticks == frames ? same + 1 : 0;
        frames = node.ticks;
      }
    return frames;
  }
  static void tap(render::test::WindowHand& hand, KeySym key) {
    hand.key(key, true);
    hand.key(key, false);
  }

  struct Wire {
    Participant participant{test::own_domain()};
    Reader<NodeStatus> statuses{participant};
    Reader<HapticTrace> traces{participant};
  };
  const fs::path folder = fs::path(testing::TempDir()) / ("palpate_feel_" + std::to_string(getpid()));
  std::thread session;
  std::unique_ptr<Wire> wire;
  static constexpr int running = -1;
  std::atomic<int> status{running};
  double t = 0, felt = 0, felt_at = 0;
};

TEST_F(FeelByMouse, AClickAndTheWheelAreEnough) {
  start();
  const auto hand = hand_at_the_window();
  ASSERT_TRUE(hand && hand->found());
  hand->move(676, 384);  // the middle of what the column leaves free
  std::this_thread::sleep_for(300ms);
  hand->click(1);
  const auto end = std::chrono::steady_clock::now() + test::patience;
  for (int notches = 0; felt <= enough_N && std::chrono::steady_clock::now() < end; ++notches) {
    if (notches < 40) hand->wheel(true);
    std::this_thread::sleep_for(200ms);
    hear();
  }
  EXPECT_GT(felt, enough_N);
  EXPECT_LT(felt_at, within_s);
  RecordProperty("felt_at_s", std::to_string(felt_at));
  hand->click(3);
  hand->key(XK_F12, true);
  hand->key(XK_F12, false);
  const fs::path picture = folder / "out" / "picture_0001.png";
  while (!fs::exists(picture) && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(20ms);
  EXPECT_TRUE(fs::exists(picture));
  if (const char* kept = std::getenv("PALPATE_TEST_PICTURES"); kept != nullptr && fs::exists(picture))
    fs::copy_file(picture, fs::path(kept) / "feel.png", fs::copy_options::overwrite_existing);
  hand->key(XK_Escape, true);
  hand->key(XK_Escape, false);
  while (status == running && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(20ms);
  EXPECT_EQ(status, 0);
}

TEST_F(FeelByMouse, StandsStillAndGoesOnByFrames) {
  start();
  const auto hand = hand_at_the_window();
  ASSERT_TRUE(hand && hand->found());
  tap(*hand, XK_p);
  const std::uint64_t at_rest = frames_at_rest();
  tap(*hand, XK_period);
  tap(*hand, XK_period);
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(frames_at_rest(), at_rest + 2);
  hand->key(XK_period, true, true);
  hand->key(XK_period, false, true);
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(frames_at_rest(), at_rest + 12);
  tap(*hand, XK_p);
  std::this_thread::sleep_for(500ms);
  tap(*hand, XK_p);
  EXPECT_GT(frames_at_rest(), at_rest + 12);
  tap(*hand, XK_Escape);
  const auto end = std::chrono::steady_clock::now() + test::patience;
  while (status == running && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(20ms);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace palpate
