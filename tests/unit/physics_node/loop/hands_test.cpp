// The samples of the hands come late, twice, in another order or not at all; physics never goes back in time.

#include "physics_node/loop/hands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace palpate::physics {
namespace {

constexpr std::int64_t ms = 1'000'000, start = 7'000 * ms;

ToolState sample(std::uint64_t tick, std::uint32_t tool = 0) {
  ToolState state;
  state.tool = tool;
  state.tick = tick;
  state.p_WT = {static_cast<double>(tick), 0, 0};
  return state;
}

TEST(Hands, HaveNothingBeforeTheFirstSample) {
  Hands hands(2);
  EXPECT_FALSE(hands.at(start)[0]);
  EXPECT_FALSE(hands.at(start)[1]);
  EXPECT_FALSE(hands.any());
}

TEST(Hands, GiveTheNewestByTickWhateverTheOrderInWhichSamplesCome) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<std::uint64_t> ticks(60);
    std::iota(ticks.begin(), ticks.end(), 1);
    ticks.insert(ticks.end(), {5, 30, 60});  // copies
    std::shuffle(ticks.begin(), ticks.end(), random);
    Hands hands(1);
    std::uint64_t newest = 0;
    std::int64_t now = start;
    for (const auto tick : ticks) {
      now += ms / 4;
      EXPECT_EQ(hands.take(sample(tick), now), tick > newest);
      newest = std::max(newest, tick);
      ASSERT_TRUE(hands.at(now)[0]);
      EXPECT_EQ(hands.at(now)[0]->tick, newest);
      EXPECT_EQ(hands.at(now)[0]->p_WT[0], static_cast<double>(newest));
    }
  }
}

TEST(Hands, OrderByTickAndNotByTheStampOfTheHand) {
  Hands hands(1);
  ToolState first = sample(10), second = sample(11);
  first.stamp_ns = 9'000'000 * ms;
  second.stamp_ns = -ms;
  EXPECT_TRUE(hands.take(first, start));
  EXPECT_TRUE(hands.take(second, start));
}

TEST(Hands, KeepASampleForFiftyMilliseconds) {
  Hands hands(1);
  hands.take(sample(100), start);
  EXPECT_TRUE(hands.at(start + 50 * ms)[0]);
  EXPECT_TRUE(hands.any());
  EXPECT_FALSE(hands.at(start + 50 * ms + 1)[0]);
  EXPECT_FALSE(hands.any());
}

TEST(Hands, TakeAnyTickAsANewStartAfterFiftyMillisecondsOfSilence) {
  Hands hands(1);
  hands.take(sample(100), start);
  EXPECT_FALSE(hands.take(sample(3), start + 50 * ms));
  EXPECT_TRUE(hands.take(sample(3), start + 50 * ms + 1));
  EXPECT_EQ(hands.at(start + 51 * ms)[0]->tick, 3U);
  EXPECT_TRUE(hands.take(sample(4), start + 52 * ms));
}

TEST(Hands, AreNotKeptAliveByCopiesOfOldSamples) {
  Hands hands(1);
  hands.take(sample(100), start);
  for (std::int64_t t = 10; t <= 50; t += 10) hands.take(sample(100), start + t * ms);
  EXPECT_FALSE(hands.at(start + 51 * ms)[0]);
}

TEST(Hands, TakeAnyTickOfAnotherHand) {
  Hands hands(1);
  hands.take(sample(100), start);
  EXPECT_FALSE(hands.take(sample(3), start + ms));
  hands.begin_anew();
  EXPECT_FALSE(hands.at(start + ms)[0]);
  EXPECT_TRUE(hands.take(sample(3), start + ms));
  EXPECT_EQ(hands.at(start + ms)[0]->tick, 3U);
}

TEST(Hands, RefuseATickThatNoHandCanHaveReached) {
  Hands hands(1);
  hands.take(sample(100), start);
  EXPECT_FALSE(hands.take(sample(std::numeric_limits<std::uint64_t>::max()), start + ms));
  EXPECT_FALSE(hands.take(sample(100 + 10'001), start + ms));
  EXPECT_EQ(hands.ticks_rejected(), 2U);
  EXPECT_TRUE(hands.take(sample(101), start + 2 * ms));
  EXPECT_EQ(hands.samples_lost(), 0U);
}

TEST(Hands, CountTheTicksThatNeverCame) {
  Hands hands(1);
  hands.take(sample(100), start);
  hands.take(sample(104), start + ms);
  EXPECT_EQ(hands.samples_lost(), 3U);
  hands.take(sample(900), start + 60 * ms);  // begun anew: nobody knows how many
  EXPECT_EQ(hands.samples_lost(), 3U);
}

TEST(Hands, AreIndependentAndIgnoreToolsThatAreNotThere) {
  Hands hands(2);
  hands.take(sample(100, 1), start);
  EXPECT_FALSE(hands.at(start)[0]);
  EXPECT_TRUE(hands.at(start)[1]);
  EXPECT_TRUE(hands.take(sample(3, 0), start + 40 * ms));
  EXPECT_FALSE(hands.take(sample(1, 2), start));
  EXPECT_FALSE(hands.take(sample(1, std::numeric_limits<std::uint32_t>::max()), start));
  EXPECT_TRUE(hands.at(start + 60 * ms)[0]);
  EXPECT_FALSE(hands.at(start + 60 * ms)[1]);
}

}  // namespace
}  // namespace palpate::physics
