// A hand's motion reaches tissue whole, however its messages come.

#include "physics_node/contact/hand_play.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/physics/recorded_hand.h"

namespace palpate::physics {
namespace {

using test::recorded_hand;

constexpr double h = 1e-3;

Vec3 swing(double t) { return {0.01 * t, 0, 0.002 * std::sin(2 * M_PI * 5 * t)}; }

ToolState at_sample(std::uint64_t sample) { return recorded_hand(swing, sample, h); }

/// A hand that has been played from one sample to another.
HandPlay played(std::uint64_t from, std::uint64_t to) {
  HandPlay play(h);
  for (const std::uint64_t sample : {from, to}) {
    const ToolState state = at_sample(sample);
    play.take(&state, h);
  }
  return play;
}

TEST(HandPlay, GoesFromOneMessageToTheNextThroughAllSamplesBetween) {
  HandPlay play(h);
  auto state = at_sample(10);
  EXPECT_FALSE(play.take(&state, h)) << "a hand begins";
  state = at_sample(50);
  EXPECT_TRUE(play.take(&state, h));
  EXPECT_EQ(play.sample(), 50u);
  for (int n = 0; n <= 40; ++n)
    EXPECT_LT((play.at(n / 40.0).x - swing(h * (10 + n))).norm(), 1e-8) << "sample " << 10 + n;
  const Vec3 between = 0.5 * (swing(h * 20) + swing(h * 21));
  EXPECT_LT((play.at(10.5 / 40).x - between).norm(), 1e-8);
  const double speed = 0.002 * 2 * M_PI * 5 * std::cos(2 * M_PI * 5 * h * 50);
  EXPECT_NEAR(play.at(1).v.z(), speed, 0.1 * 0.002 * 2 * M_PI * 5) << "low-passed at 100 Hz";
}

/// Whoever gets few messages plays what gets all of them.
TEST(HandPlay, PlaysTheSameWhateverIsLost) {
  HandPlay all(h), few(h);
  for (std::uint64_t n = 1; n <= 120; ++n) {
    auto state = at_sample(n);
    all.take(&state, h);
    if (n % 40 == 1 || n == 120) few.take(&state, h);
  }
  EXPECT_EQ(all.sample(), few.sample());
  EXPECT_LT((all.at(1).x - few.at(1).x).norm(), 1e-12);
  EXPECT_LT((all.at(1).v - few.at(1).v).norm(), 1e-5);
}

TEST(HandPlay, GoesStraightThroughWhatIsForgotten) {
  const HandPlay play = played(1, 201);  // samples 137 to 200 are told
  EXPECT_LT((play.at(136.0 / 200).x - swing(h * 137)).norm(), 1e-8);
  EXPECT_LT((play.at(68.0 / 200).x - 0.5 * (swing(h) + swing(h * 137))).norm(), 1e-8);
  EXPECT_LT((play.at(1).x - swing(h * 201)).norm(), 1e-12);
}

/// Of two hands that number their samples on, or of one that was somewhere else for long: not a way between them.
TEST(HandPlay, BeginsAnewWhereStampsSayThatItIsAnotherHand) {
  for (const double off : {-1e4, -1.1, -0.9, 0.0, 0.9, 1.1, 1e4}) {
    HandPlay play = played(10, 12);
    ToolState state = at_sample(2012);
    state.stamp_ns = static_cast<std::int64_t>(1e9 * (2 + off));
    EXPECT_EQ(play.take(&state, h), std::abs(off) < 1) << off;
    EXPECT_EQ(play.sample(), 2012u);
    EXPECT_NEAR(play.way(), std::abs(off) < 1 ? (swing(h * 2012) - swing(h * 12)).norm() : 0.0, 1e-12) << off;
  }
}

TEST(HandPlay, StandsWhereNothingNewComes) {
  HandPlay play = played(10, 12);
  const ToolState state = at_sample(12);
  for (const ToolState* now :
       {static_cast<const ToolState*>(nullptr), static_cast<const ToolState*>(&state)}) {
    play.take(now, 2 * h);
    for (const double share : {0.0, 0.5, 1.0}) {
      EXPECT_EQ(play.at(share).x, swing(h * 12));
      EXPECT_TRUE(play.at(share).v.isZero());
    }
  }
  EXPECT_EQ(play.way(), 0);
}

TEST(HandPlay, GoesOnAsFastWhereASampleIsLate) {
  HandPlay play = played(10, 12);
  const ToolState state = at_sample(12);
  const Vec3 speed = play.at(1).v;
  EXPECT_GT(speed.norm(), 0);
  play.take(&state, h);
  EXPECT_EQ(play.at(0.5).v, speed);
  EXPECT_EQ(play.at(0.5).x, swing(h * 12));
  play.take(&state, h);
  EXPECT_TRUE(play.at(0.5).v.isZero());
}

TEST(HandPlay, BeginsAnewWithAnotherHand) {
  HandPlay play(h);
  auto state = at_sample(500);
  play.take(&state, h);
  state = at_sample(3);
  EXPECT_FALSE(play.take(&state, h));
  EXPECT_EQ(play.at(0).x, swing(h * 3)) << "it does not fly there";
}

}  // namespace
}  // namespace palpate::physics
