#include "haptic_node/control/answer_watch.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace palpate::haptic {
namespace {

/// A wrench that breaks one promise is not believed, whichever it is.
TEST(AnswerWatch, BelievesNoWrenchThatBreaksAPromise) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ToolWrench sound;
  EXPECT_TRUE(is_sound(sound, 0));
  sound.normal = {0, 0.6, 0.8};
  sound.stretch = -0.02;
  EXPECT_TRUE(is_sound(sound, 0));
  const std::pair<const char*, std::function<void(ToolWrench&)>> wrongs[] = {
      {"other tool", [](ToolWrench& w) { w.tool = 1; }},
      {"NaN force", [=](ToolWrench& w) { w.force[1] = nan; }},
      {"tip beyond reach", [](ToolWrench& w) { w.tip[0] = 1e4; }},
      {"stiffer than rigid", [](ToolWrench& w) { w.stiffness[14] = 2 * rigid_stiffness; }},
      {"attitude of length 2", [](ToolWrench& w) { w.q_WT[0] = 2; }},
      {"normal of length 0.6", [](ToolWrench& w) { w.normal[2] = 0; }},
      {"NaN normal", [=](ToolWrench& w) { w.normal[0] = nan; }},
      {"NaN stretch", [=](ToolWrench& w) { w.stretch = nan; }},
      {"stretched beyond reach", [](ToolWrench& w) { w.stretch = 1e30; }},
  };
  for (const auto& [name, spoil] : wrongs) {
    ToolWrench wrench = sound;
    spoil(wrench);
    EXPECT_FALSE(is_sound(wrench, 0)) << name;
  }
}

ContactPatch patch_of(std::uint64_t tick) {
  ContactPatch patch;
  patch.tick = tick;
  return patch;
}

constexpr std::int64_t ms = 1'000'000;

/// A tick that physics cannot have come to is counted and counts for nothing: those that follow are not older.
TEST(AnswerWatch, IsNotShutByATickThatLiesInTheFuture) {
  PatchWatch watch(0);
  std::int64_t now = 1'000 * ms;
  std::uint64_t taken = 0;
  for (std::uint64_t tick = 1; tick <= 2000; ++tick, now += ms) {
    const ContactPatch patch = patch_of(tick), huge = patch_of(~0ULL - tick);
    if (tick > 1 && tick % 91 == 0) {
      EXPECT_FALSE(watch.accept(&huge, now));
    }
    taken += watch.accept(&patch, now);
  }
  EXPECT_EQ(taken, 2000U);
  EXPECT_EQ(watch.rejected(), 21U);
}

TEST(AnswerWatch, RecoversFromAFirstTickThatLiesInTheFuture) {
  PatchWatch watch(0);
  std::int64_t now = 1'000 * ms;
  const ContactPatch huge = patch_of(~0ULL);
  EXPECT_TRUE(watch.accept(&huge, now));
  std::uint64_t taken = 0;
  for (std::uint64_t tick = 1; tick <= 1000; ++tick) {
    const ContactPatch patch = patch_of(tick);
    taken += watch.accept(&patch, now += ms);
  }
  EXPECT_GE(taken, 800U) << "after the patience for a silence";
}

TEST(AnswerWatch, TakesAnyTickOfSomebodyElse) {
  PatchWatch watch(0);
  const ContactPatch late = patch_of(5'000'000), early = patch_of(3), earlier = patch_of(2);
  EXPECT_TRUE(watch.accept(&late, 1000 * ms));
  EXPECT_FALSE(watch.accept(&early, 1001 * ms)) << "older";
  watch.listen_anew();
  EXPECT_FALSE(watch.accept(&early, 1002 * ms)) << "it was looked at before";
  EXPECT_TRUE(watch.accept(&earlier, 1003 * ms));
  EXPECT_TRUE(watch.accept(&early, 1004 * ms));
}

}  // namespace
}  // namespace palpate::haptic
