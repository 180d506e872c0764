#include "render_node/frame_schedule.h"

#include <gtest/gtest.h>

namespace palpate::render {
namespace {

TEST(FrameSchedule, GivesTheRateInSimulatedTime) {
  FrameSchedule schedule(10);
  int frames = 0;
  for (int i = 0; i < 2000; ++i) frames += schedule.due(i * 1e-3) ? 1 : 0;
  EXPECT_EQ(frames, 20);
  EXPECT_EQ(schedule.skipped(), 0U);
}

TEST(FrameSchedule, DoesNotCatchUpInABurst) {
  FrameSchedule schedule(10);
  EXPECT_TRUE(schedule.due(0.0));
  EXPECT_TRUE(schedule.due(0.55));
  EXPECT_FALSE(schedule.due(0.56));
  EXPECT_EQ(schedule.skipped(), 4U);
}

TEST(FrameSchedule, DrawsOnceWhileTimeStands) {
  FrameSchedule schedule(10);
  EXPECT_TRUE(schedule.due(0.3));
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(schedule.due(0.3));
}

TEST(FrameSchedule, StartsAnewAfterAReset) {
  FrameSchedule schedule(10);
  EXPECT_TRUE(schedule.due(3.0));
  EXPECT_TRUE(schedule.due(0.0));
  EXPECT_EQ(schedule.skipped(), 0U);
}

}  // namespace
}  // namespace palpate::render
