// A session goes on where a recorded one was, half cut or not, to the same bits, and its own record holds both.
#include "physics_node/record/catch_up.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "common/error/error.h"
#include "common/message/tissue_reset.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/record/replay.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/unit/physics_node/record/cut_block.h"

namespace palpate::physics {
namespace {

using palpate::test::ScratchFolder;
using test::cut_block;
using test::led_blade;

constexpr double to_its_end = std::numeric_limits<double>::infinity();
constexpr auto patient = [] { return true; };

/// A session in a folder of its own, with a record.
struct Recorded {
  explicit Recorded(const std::string& text) {
    std::ofstream(folder / "scene.toml") << text;
    world.emplace(load_scene(folder / "scene.toml"));
    recorder.emplace(*world, source_of(load_scene(folder / "scene.toml"), {}), folder.path(),
                     Recorder::WhenBehind::wait);
  }
  void frame(const std::optional<ToolState>& hand) {
    world->frame(std::span(&hand, 1));
    recorder->frame(*world, std::span(&hand, 1));
  }
  void lead(int from, int to) {
    for (int n = from; n < to; ++n) frame(led_blade(n));
  }
  std::string close() {
    recorder->finish(*world);
    return folder / "record.h5";
  }

  ScratchFolder folder;
  std::optional<World> world;
  std::optional<Recorder> recorder;
};

void expect_runs_again(const std::string& path, const World& as) {
  const ScratchFolder files;
  SessionRecord record(path);
  const auto laid_out = record.lay_out(files.path());
  World world(laid_out.scene);
  Replay replay(record, world);
  while (replay.frame()) {
  }
  EXPECT_FALSE(replay.difference());
  EXPECT_EQ(world.report().frames, as.report().frames);
  EXPECT_EQ(world.state_hash(), as.state_hash());
}

class CatchUp : public ::testing::TestWithParam<const char*> {};

TEST_P(CatchUp, GoesOnHalfCutWithTheSameBits) {
  const std::string text = cut_block(GetParam());
  Recorded morning(text);
  morning.lead(0, 150);  // the blade stands in the tissue
  const std::string record = morning.close();
  // What would have come of it without a break, but for the hand that was taken off.
  morning.world->frame(std::vector<std::optional<ToolState>>(1));
  const std::int64_t cut = morning.world->body(0).breaks();
  EXPECT_GT(cut, 3);

  Recorded evening(text);
  const CaughtUp caught_up = catch_up(record, to_its_end, *evening.world, &*evening.recorder, patient);
  EXPECT_NEAR(caught_up.t, 0.151, 1e-9);
  EXPECT_GE(caught_up.compared, 150u / frames_between_hashes);
  EXPECT_EQ(evening.world->body(0).breaks(), cut);
  EXPECT_EQ(evening.world->state_hash(), morning.world->state_hash());
  constexpr std::int64_t hours = 10'000'000'000'000;
  for (int n = 0; n < 240; ++n) {
    const std::optional<ToolState> hand = led_blade(n, 0.6, hours);  // further
    morning.world->frame(std::span(&hand, 1));
    evening.frame(hand);
  }
  EXPECT_EQ(evening.world->state_hash(), morning.world->state_hash());
  EXPECT_GT(evening.world->body(0).breaks(), cut);
  expect_runs_again(evening.close(), *evening.world);
}

INSTANTIATE_TEST_SUITE_P(Bodies, CatchUp,
                         ::testing::Values("lattice = \"fcc\"", "lattice = \"voxel\"\nmodel = \"fem\""));

TEST(CatchUpTo, AMomentBeforeTheStrokeThatWasUndone) {
  const std::string text = cut_block("lattice = \"fcc\"");
  Recorded first(text);
  first.lead(0, 190);
  Command undo{.id = 1, .kind = CommandKind::reset};
  std::ranges::copy(last_stroke, undo.name.begin());
  first.recorder->command(*first.world, undo);
  ASSERT_TRUE(first.world->undo());
  first.lead(190, 240);
  const std::string record = first.close();
  for (const auto& [at, whole] : {std::pair{0.1, true}, std::pair{0.19, false}, std::pair{0.2, true}}) {
    Recorded second(text);
    EXPECT_NEAR(catch_up(record, at, *second.world, &*second.recorder, patient).t, at + 0.001, 1e-9);
    EXPECT_EQ(second.world->body(0).breaks() == 0, whole) << at;
    EXPECT_EQ(second.world->report().undone, at > 0.195 ? 1 : 0);
    expect_runs_again(second.close(), *second.world);
  }
}

/// @return what the person is told
std::string refusal(const std::string& record, double at, const std::string& text) {
  const ScratchFolder folder;
  std::ofstream(folder / "scene.toml") << text;
  World world(load_scene(folder / "scene.toml"));
  try {
    catch_up(record, at, world, nullptr, patient);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CatchUpTo, NoOtherSceneAndNoTimeThatTheRecordDoesNotHold) {
  const std::string text = cut_block("lattice = \"fcc\"");
  Recorded first(text);
  first.lead(0, 160);
  const std::string record = first.close();
  EXPECT_EQ(refusal(record, 0.16, text), "");
  EXPECT_NE(refusal(record, 0.2, text).find("holds 0.160 s and cannot begin at 0.2 s"), std::string::npos)
      << refusal(record, 0.2, text);
  for (const auto& [from, to, what] :
       {std::tuple{"modulus_kPa = 200", "modulus_kPa = 201", "scene.toml: another state than that of"},
        std::tuple{"size_mm = [16, 16, 10]", "size_mm = [16, 16, 12]",
                   "scene.toml: another state than that of"},
        std::tuple{"name = \"blade\"", "name = \"knife\"",
                   "record.h5: knows no tool \"knife\"; it is of another scene"}}) {
    std::string other = text;
    other.replace(other.find(from), std::string(from).size(), to);
    EXPECT_NE(refusal(record, to_its_end, other).find(what), std::string::npos)
        << to << ": " << refusal(record, to_its_end, other);
  }
  EXPECT_NE(refusal("/nowhere/record.h5", to_its_end, text).find("no such file"), std::string::npos);
}

TEST(CatchUpTo, WhereAPersonNoLongerWaits) {
  const std::string text = cut_block("lattice = \"fcc\"");
  Recorded first(text);
  first.lead(0, 160);
  const std::string record = first.close();
  Recorded second(text);
  int frames = 0;
  const CaughtUp caught_up =
      catch_up(record, to_its_end, *second.world, &*second.recorder, [&frames] { return ++frames <= 50; });
  EXPECT_NEAR(caught_up.t, 0.051, 1e-9);
}

}  // namespace
}  // namespace palpate::physics
