#include "render_node/model/threshold_control.h"
#include "common/scene/body_spec.h"
#include "common/scene/scene.h"

#include <gtest/gtest.h>

#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

Scene with_window(double lo, double hi) {
  Scene scene = test::small_scene();
  VolumeShape volume;
  volume.keep_min = lo;
  volume.keep_max = hi;
  scene.bodies[0].shape = volume;
  scene.bodies[0].lattice = LatticeKind::voxel;
  return scene;
}

TEST(ThresholdControl, GuessesTheRangeFromTheWindow) {
  const ThresholdControl ct(with_window(226, 3071)), grey(with_window(90, 255));
  EXPECT_EQ(ct.lo(), -1024);
  EXPECT_EQ(ct.hi(), 3071);
  EXPECT_EQ(ct.value(), 226);
  EXPECT_EQ(grey.lo(), 0);
  EXPECT_EQ(grey.hi(), 255);
  EXPECT_FALSE(ThresholdControl(test::small_scene()).applies());
}

TEST(ThresholdControl, CommandsAtMostFiveTimesASecondWhileDragged) {
  ThresholdControl control(with_window(-300, 3071));
  int commands = 0;
  for (int i = 1; i <= 1000; ++i) {
    control.set(-300 + i);
    commands += control.due(i * 1e-3, false).has_value() ? 1 : 0;
  }
  EXPECT_EQ(commands, 5);
}

TEST(ThresholdControl, CommandsTheLastValueWhenLetGo) {
  ThresholdControl control(with_window(-300, 3071));
  control.set(10);
  EXPECT_EQ(control.due(1.0, false), 10);
  control.set(11);
  EXPECT_EQ(control.due(1.01, false), std::nullopt);
  EXPECT_EQ(control.due(1.02, true), 11);
  EXPECT_EQ(control.due(2.0, true), std::nullopt);
}

TEST(ThresholdControl, DoesNotEchoWhatAnotherCommanded) {
  ThresholdControl control(with_window(-300, 3071));
  control.obey(500);
  EXPECT_EQ(control.value(), 500);
  EXPECT_EQ(control.due(9.0, true), std::nullopt);
}

}  // namespace
}  // namespace palpate::render
