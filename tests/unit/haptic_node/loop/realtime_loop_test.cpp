// The real-time thread in wall time. This machine may be busy: only what must hold however late it runs is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/scene/device_spec.h"
#include "haptic_node/loop/haptic_summary.h"
#include "haptic_node/loop/rate_meter.h"
#include "tests/unit/haptic_node/loop/running_loop.h"

namespace palpate::haptic::test {
namespace {

TEST(RealtimeLoop, TicksArmsAndTracesWithoutAGap) {
  RunningLoop running(scene_with(HandModel::arm, press(0.003)));
  running.live(1500ms, true);
  running.loop->finish();
  running.live(1ms, false);
  const LoopStats* stats = running.loop->stats();
  ASSERT_NE(stats, nullptr);
  EXPECT_EQ(stats->ticks, running.last_tick);
  EXPECT_TRUE(running.in_order);
  EXPECT_EQ(running.channels[0]->trace_lost.load(), 0u);
  EXPECT_GT(running.channels[0]->session.get()->first_run_ns(), 0);
  std::uint64_t waking = 0;
  for (const auto count : stats->lateness) waking += count;
  EXPECT_EQ(waking, stats->ticks);
  EXPECT_EQ(stats->period.total(), stats->ticks - 1);
  EXPECT_NEAR(static_cast<double>(stats->ticks + stats->skipped) * 1e-3,
              seconds_from_ns(stats->last_ns - stats->start_ns), 0.01);
  EXPECT_EQ(stats->compute.total(), stats->ticks);
  EXPECT_EQ(stats->compute_cpu.total(), stats->ticks);
}

TEST(RealtimeLoop, EndsWithNoForceAndClosedDevices) {
  auto least = std::chrono::steady_clock::duration::max();  // of several: other programs only ever add to one
  for (int n = 0; n < 5 && least >= 1s; ++n) {
    RunningLoop running(scene_with(HandModel::rigid, {{0, {0, 0, 0.005}}, {0.2, {0, 0, -0.004}}}));
    running.live(600ms, true);
    const auto begin = std::chrono::steady_clock::now();
    running.loop->finish();
    least = std::min(least, std::chrono::steady_clock::now() - begin);
    for (const double f : running.channels[0]->session.get()->trace().force) EXPECT_EQ(f, 0.0);
    running.channels[0]->session.get()->close();
    EXPECT_EQ(running.channels[0]->session.get()->state(), HapticState::off);
  }
  EXPECT_LT(least, 1s);
}

/// 1000 Hz for two seconds, then 300 ms for each tick, as a driver does that blocks.
TEST(RateMeter, CountsTicksOfTheWallClockWhateverTheLoopDoes) {
  RateMeter meter;
  std::int64_t now = 5'000'000'000;
  std::uint64_t ticks = 70;
  EXPECT_EQ(meter.take(ticks, now), 0.0);
  double rate = 0;
  for (int i = 0; i < 10; ++i) rate = meter.take(ticks += 200, now += 200'000'000);
  EXPECT_NEAR(rate, 1000.0, 1e-6);
  double slowest = 1e9, fastest = 0;
  for (int ms = 200; ms <= 9000; ms += 200) {
    rate = meter.take(ticks + static_cast<std::uint64_t>(ms / 300), now + ms * 1'000'000ll);
    if (ms < 1400) continue;
    slowest = std::min(slowest, rate);
    fastest = std::max(fastest, rate);
  }
  EXPECT_GE(slowest, 2.0);  // of a true 3.33: one tick more or less in a second
  EXPECT_LE(fastest, 4.5);
  for (int i = 0; i < 8; ++i) rate = meter.take(ticks + 30, now + 9'000'000'000 + i * 200'000'000ll);
  EXPECT_EQ(rate, 0.0) << "a loop that stands still";
}

TEST(HapticSummary, HasTheKeysOfASummary) {
  LoopStats stats;
  stats.ticks = 1001;
  stats.start_ns = 0;
  stats.last_ns = 1'001'000'000;
  stats.period.add(1000);
  stats.compute.add(5);
  SessionReport report;
  report.counts.energy_max = 1e-3;
  report.counts.stale_events = 2;
  SessionReport other = report;
  report.counts.force_max = 2;
  other.counts.torque_max = 0.03;
  const nlohmann::json haptic = haptic_summary(stats, {report, other}, 0,
                                               {{"tip", 1.5, FaultCause::overtemp, "warm motors"}})["haptic"];
  EXPECT_EQ(haptic["fault_causes"][0]["cause"], "overtemp");
  EXPECT_EQ(haptic["fault_causes"][0]["driver"], "warm motors");
  EXPECT_NEAR(haptic["rate_Hz"].get<double>(), 1000, 1e-9);
  EXPECT_EQ(haptic["stale_events"], 4);
  EXPECT_EQ(haptic["energy_max_J"], 1e-3);
  EXPECT_EQ(haptic["force_max_N"], 2.0);
  EXPECT_EQ(haptic["torque_max_N_m"], 0.03);
  for (const char* key : {"p50", "p99", "p999", "max"}) EXPECT_TRUE(haptic["period_us"].contains(key));
  EXPECT_FALSE(haptic.contains("loop_age_ms")) << "no patch answered";
}

}  // namespace
}  // namespace palpate::haptic::test
