#include "render_node/model/hand_clock.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "render_node/model/view_model.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

TraceSample sample_at(std::uint64_t tick, double t) {
  TraceSample sample;
  sample.tick = tick;
  sample.t = t;
  return sample;
}

TEST(HandClock, KnowsNothingBeforeAHandHasSpokenNorOfTickZero) {
  HandClock clock(1000);
  EXPECT_FALSE(clock.at(7));
  clock.note(sample_at(100, 0.1));
  EXPECT_FALSE(clock.at(0));
  EXPECT_NEAR(*clock.at(100), 0.1, 1e-12);
}

TEST(HandClock, LearnsHowLongATickIs) {
  HandClock clock(1000);
  for (std::uint64_t n = 1; n <= 200; ++n) clock.note(sample_at(n, 5 + 0.002 * static_cast<double>(n)));
  EXPECT_NEAR(*clock.at(200), 5.4, 1e-12);
  EXPECT_NEAR(*clock.at(230), 5.46, 1e-6) << "half the rate that the scene has";
  EXPECT_NEAR(*clock.at(190), 5.38, 1e-6);
}

TEST(HandClock, DoesNotPlaceTicksOfAnotherHand) {
  HandClock clock(1000);
  clock.note(sample_at(100, 0.1));
  EXPECT_FALSE(clock.at(1'000'000));
  EXPECT_FALSE(clock.at(~std::uint64_t{0}));
  clock.note(sample_at(1'000'000, 900));
  EXPECT_FALSE(clock.at(100));
  clock.note(sample_at(3, 0.003));  // a hand that has begun anew
  EXPECT_NEAR(*clock.at(4), 0.004, 1e-6);
}

/// Physics at half the speed of time: what it answers to a tick of the hand belongs under that tick, not at the time simulated.
TEST(LivePlot, HasOneClockForHandAndTissue) {
  ViewModel model(test::small_scene());
  constexpr double delay_s = 0.002;
  for (std::uint64_t tick = 1; tick <= 4000; ++tick) {
    const double t = 1e-3 * static_cast<double>(tick);
    auto trace = test::trace_at({0, 0, 0}, t, t < 3 ? 0 : 2);  // a step at 3 s of the hand
    trace.samples[0].tick = tick;
    model.take(trace);
    if (tick <= 10 || tick % 2 != 0) continue;
    ToolWrench wrench;
    wrench.answers = tick - 2;
    wrench.t = 0.5 * t;
    wrench.force = {0, 0, t - delay_s < 3 ? 0.0 : 2.0};
    wrench.moment = {t - delay_s < 3 ? 0.0 : 0.1, 0, 0};
    model.take(wrench);
  }
  const ToolView& tool = model.tools()[0];
  const auto step = [&](const History& history) {
    for (const auto& point : history.points(tool.on_hand.newest()))
      if (point.value > 0.05) return point.age;
    return -1.0;
  };
  EXPECT_NEAR(step(tool.on_hand), 1.0, 1.5 * History::bucket_s);
  EXPECT_NEAR(step(tool.on_tool), step(tool.on_hand), 1.5 * History::bucket_s);
  EXPECT_NEAR(step(tool.moment_history[0]), step(tool.on_hand), 1.5 * History::bucket_s);
  EXPECT_NEAR(tool.on_tool.points(tool.on_hand.newest()).front().age, 4 - 0.01, 0.02) << "all of it is there";
}

}  // namespace
}  // namespace palpate::render
