// A hand listens to one physics, a session has one physics and one hand: what a second one meets.

#include <cmath>
#include <utility>

#include "common/report/json_file.h"
#include "common/wire/writer.h"
#include "tests/system/hand_session.h"

namespace palpate::test {
namespace {

class OnePhysics : public HandSession {
 protected:
  /// Starts one more. @return its exit code, -1 if it stays for 20 s
  int second(const char* program) {
    pid_t pid = start(program);
    int status = 0;
    const bool ended = until([&] { return waitpid(pid, &status, WNOHANG) == pid; });
    if (!ended) end(pid, SIGKILL);
    return ended && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Once the hand has come to rest, which takes a busy machine longer.
  double force_at_rest() {
    double force = 0;
    EXPECT_TRUE(until([&] {
      const double last = std::exchange(force, force_now());
      std::this_thread::sleep_for(100ms);
      return force > 0.3 && std::abs(force - last) < 0.01 * force;
    })) << log();
    return force;
  }
  bool lives(pid_t pid) const { return kill(pid, 0) == 0 && waitpid(pid, nullptr, WNOHANG) == 0; }

  Participant participant{domain};
};

TEST_F(OnePhysics, IsAllThatASessionTakes) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  EXPECT_EQ(second(PALPATE_PHYSICS), 2) << log();
  EXPECT_EQ(second(PALPATE_HAPTIC), 2) << log();
  EXPECT_NE(log().find("physics is in this session already, on "), std::string::npos) << log();
  EXPECT_NE(log().find("haptic is in this session already, on "), std::string::npos) << log();
  EXPECT_TRUE(lives(physics) && lives(haptic));
  EXPECT_GT(force_now(), 0.3) << "the hand has felt nothing of it";
  expect_no_kick();
}

/// Whoever comes later goes, though the hand is still looking round for a session it does not fit in.
TEST_F(OnePhysics, OfAnotherSceneGoesAndTheHandStays) {
  start_both();
  ASSERT_TRUE(until([this] { return device->writes > 0 && log().find("loaded in") != std::string::npos; }))
      << log();
  std::ofstream(folder / "scene.toml", std::ios::app) << "\n# another one\n";
  for (const char* program : {PALPATE_PHYSICS, PALPATE_HAPTIC}) EXPECT_EQ(second(program), 2) << log();
  EXPECT_TRUE(presses()) << log();
  EXPECT_TRUE(lives(physics) && lives(haptic)) << log();
  expect_no_kick();
}

/// Empty patches whose ticks lie far in the future, eleven a second and then a flood of them.
TEST_F(OnePhysics, IsFeltWhateverAStrangerSays) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  const double before = force_at_rest();
  Writer<ContactPatch> stranger(participant);
  ASSERT_TRUE(until([&] { return stranger.matched() > 0; }));
  ContactPatch patch;
  patch.tick = ~0ULL - 1'000'000;
  std::uint64_t said = 0;
  for (int i = 0; i < 2000; ++i) {
    if (i < 1000 && i % 91 != 0) {
      std::this_thread::sleep_for(1ms);
      continue;
    }
    patch.tick += 1;
    ASSERT_TRUE(stranger.write(patch));
    ++said;
    if (i % 10 == 0) std::this_thread::sleep_for(1ms);
    if (device->at(device->writes - 1).z < 0.0161) {
      EXPECT_NEAR(force_now(), before, 0.2 * before) << "after " << said << " patches of a stranger";
    }
  }
  EXPECT_TRUE(until([&] {
    return log().find("ContactPatch of a process that does not say who it is") != std::string::npos;
  })) << log();
  const int status = end(haptic, SIGTERM);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  const auto part = read_json((folder / "out" / "parts" / "haptic.json").string());
  EXPECT_GT(part.at("haptic").at("foreign_patches").get<std::uint64_t>(), said / 2);
  EXPECT_EQ(part.at("haptic").at("patches_rejected").get<std::uint64_t>(), 0U);
  EXPECT_NE(part.at("wire")
                .at("haptic")
                .at("heard")
                .at("ContactPatch")
                .at("first_refused")
                .get<std::string>()
                .find("is not heard: physics on "),
            std::string::npos);
  expect_no_kick();
}

/// Two hands that claim one tool: the tissue follows the one that was first.
TEST_F(OnePhysics, ListensToOneHand) {
  start_both();
  ASSERT_TRUE(presses()) << log();
  const double before = force_at_rest();
  Writer<ToolState> stranger(participant);
  ASSERT_TRUE(until([&] { return stranger.matched() > 0; }));
  ToolState state;
  state.p_WT = {0, 0, 0.2};
  state.engaged = 1;
  state.tick = 1ULL << 60;
  for (int i = 0; i < 500; ++i) {
    state.tick += 1;
    ASSERT_TRUE(stranger.write(state));
    std::this_thread::sleep_for(1ms);
  }
  if (device->at(device->writes - 1).z < 0.0161) {
    EXPECT_NEAR(force_now(), before, 0.2 * before);
  }
  EXPECT_TRUE(until([&] {
    return log().find("ToolState of a process that does not say who it is") != std::string::npos;
  })) << log();
}

}  // namespace
}  // namespace palpate::test
