// A fault ended by a person while the real-time thread runs: the session is taken from it and another handed to it.

#include "haptic_node/loop/device_reset.h"

#include <gtest/gtest.h>

#include "common/error/error.h"
#include "common/scene/device_spec.h"
#include "common/scene/scene.h"
#include "tests/unit/haptic_node/loop/running_loop.h"
#include "tests/unit/haptic_node/loop/watched_world.h"

namespace palpate::haptic::test {
namespace {

struct ResetTest : testing::Test {
  ResetTest()
      : file(watched_file(), palpate::test::WatchedFile::Role::test),
        scene(watched(scene_with(HandModel::rigid, {{0, {0, 0, 0.02}}, {0.3, {0, 0, 0.015}}}))),
        running(scene),
        reset(*running.channels[0], [this] {
          if (refuse) throw InputError("no device at all");
          return open_session(scene, 0, "");
        }) {}

  void live(std::chrono::milliseconds span) {
    running.live(span, true, [this] { reset.step(running.report.state, running.report.cause); });
  }
  /// Until it is so, or 5 s: this machine may be busy.
  bool becomes(HapticState state) {
    for (int i = 0; i < 500 && running.report.state != state; ++i) live(10ms);
    return running.report.state == state;
  }

  palpate::test::WatchedFile file;
  Scene scene;
  RunningLoop running;
  bool refuse = false;
  DeviceReset reset;
};

TEST_F(ResetTest, OpensTheDeviceAnewWithoutAGapInTicks) {
  ASSERT_TRUE(becomes(HapticState::run));
  file->unplugged = 1;
  ASSERT_TRUE(becomes(HapticState::fault));
  EXPECT_EQ(file->after_lost, 0u);
  file->unplugged = 0;
  running.channels[0]->reset_asked = true;
  ASSERT_TRUE(becomes(HapticState::run));
  EXPECT_EQ(file->closed, 1u);
  EXPECT_EQ(file->opened, 2u);
  EXPECT_EQ(file->calibrated, 2u);
  EXPECT_EQ(running.report.counts.faults, 1u);
  EXPECT_TRUE(running.in_order) << "ticks of the trace go on";
}

TEST_F(ResetTest, StaysAFaultWhenTheDeviceCannotBeOpenedAndMayBeAskedAgain) {
  ASSERT_TRUE(becomes(HapticState::run));
  file->estop = 1;
  ASSERT_TRUE(becomes(HapticState::fault));
  refuse = true;
  running.channels[0]->reset_asked = true;
  live(200ms);
  EXPECT_FALSE(reset.busy());
  EXPECT_EQ(running.report.state, HapticState::fault);
  EXPECT_EQ(file->closed, 1u);
  refuse = false;
  file->estop = 0;
  running.channels[0]->reset_asked = true;
  EXPECT_TRUE(becomes(HapticState::run));
  EXPECT_EQ(file->closed, 1u);
}

/// Nobody else is left who could hear that the motors are to stop.
TEST_F(ResetTest, ClosesADeviceWhoseVendorsSideIsDeadAndOpensItWhenAsked) {
  ASSERT_TRUE(becomes(HapticState::run));
  file->dead = 1;
  ASSERT_TRUE(becomes(HapticState::fault));
  EXPECT_EQ(running.report.cause, FaultCause::silent);
  for (int i = 0; i < 500 && file->closed == 0; ++i) live(10ms);
  live(100ms);
  EXPECT_EQ(file->closed, 1u);
  EXPECT_EQ(file->opened, 1u);
  EXPECT_TRUE(reset.has_session());
  EXPECT_FALSE(reset.hangs());
  file->dead = 0;
  running.channels[0]->reset_asked = true;
  ASSERT_TRUE(becomes(HapticState::run));
  live(100ms);
  EXPECT_EQ(file->closed, 1u);
  EXPECT_EQ(file->opened, 2u);
}

TEST_F(ResetTest, DoesNotOpenADeviceAgainThatItsDriverHasNotLetGoOf) {
  ASSERT_TRUE(becomes(HapticState::run));
  file->dead = file->hang_close = 1;
  ASSERT_TRUE(becomes(HapticState::fault));
  for (int i = 0; i < 500 && !reset.hangs(); ++i) live(10ms);
  EXPECT_TRUE(reset.hangs());
  EXPECT_EQ(file->powered, 0u);
  running.channels[0]->reset_asked = true;
  live(100ms);
  EXPECT_EQ(file->opened, 1u);
  file->dead = file->hang_close = 0;
  for (int i = 0; i < 500 && file->closed == 0; ++i) live(10ms);
  running.channels[0]->reset_asked = true;
  ASSERT_TRUE(becomes(HapticState::run)) << "it has come back after all";
  EXPECT_EQ(file->opened, 2u);
}

TEST_F(ResetTest, LeavesAToolWithoutAFaultAlone) {
  ASSERT_TRUE(becomes(HapticState::run));
  running.channels[0]->reset_asked = true;
  live(100ms);
  EXPECT_EQ(file->opened, 1u);
  EXPECT_EQ(running.report.state, HapticState::run);
}

TEST_F(ResetTest, KeepsTheFlightOfAFault) {
  ASSERT_TRUE(becomes(HapticState::run));
  file->estop = 1;
  ASSERT_TRUE(becomes(HapticState::fault));
  live(100ms);
  running.loop->finish();
  running.channels[0]->flight.end();
  EXPECT_TRUE(running.channels[0]->flight.has_kept());
}

}  // namespace
}  // namespace palpate::haptic::test
