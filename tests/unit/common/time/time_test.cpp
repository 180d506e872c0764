#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "common/time/clock.h"
#include "common/time/histogram.h"
#include "common/time/ticker.h"

namespace palpate {
namespace {

TEST(Histogram, FindsPercentilesToTheWidthOfABin) {
  Histogram<100> histogram(1.0);
  for (int i = 1; i <= 100; ++i) histogram.add(i - 0.5);
  EXPECT_EQ(histogram.total(), 100u);
  EXPECT_DOUBLE_EQ(histogram.percentile(0.5), 50);
  EXPECT_DOUBLE_EQ(histogram.percentile(0.99), 99);
  EXPECT_DOUBLE_EQ(histogram.percentile(1.0), 99.5);
  EXPECT_DOUBLE_EQ(histogram.mean(), 50);
}

TEST(Histogram, CountsWhatIsBeyondItsLastBin) {
  Histogram<10> histogram(1.0);
  histogram.add(5);
  histogram.add(1e300);
  histogram.add(-3);
  histogram.add(std::nan(""));
  EXPECT_EQ(histogram.total(), 3u);
  EXPECT_EQ(histogram.overflow(), 1u);
  EXPECT_EQ(histogram.count(0), 1u);
  EXPECT_EQ(histogram.percentile(1.0), 1e300);
}

TEST(Histogram, OfNothingSaysZero) { EXPECT_EQ(Histogram<10>().percentile(0.5), 0.0); }

TEST(OctaveBin, DoublesFromBinToBin) {
  EXPECT_EQ(octave_bin(-5, 24), 0u);
  EXPECT_EQ(octave_bin(1, 24), 0u);
  EXPECT_EQ(octave_bin(2, 24), 1u);
  EXPECT_EQ(octave_bin(3, 24), 1u);
  EXPECT_EQ(octave_bin(1024, 24), 10u);
  EXPECT_EQ(octave_bin(std::int64_t{1} << 40, 24), 23u);
}

TEST(Clock, ConvertsSecondsBothWays) {
  EXPECT_EQ(ns_from_seconds(1.5), 1'500'000'000);
  EXPECT_EQ(ns_from_seconds(-1e-9), -1);
  EXPECT_DOUBLE_EQ(seconds_from_ns(2'500'000), 0.0025);
}

TEST(Ticker, NeverWakesEarlyAndKeepsToItsGrid) {
  Ticker ticker(500);
  const auto first = ticker.wait();
  for (int i = 0; i < 20; ++i) {
    const auto wake = ticker.wait();
    EXPECT_GE(wake.woke_ns, wake.due_ns);
    EXPECT_EQ((wake.due_ns - first.due_ns) % ticker.period_ns(), 0);
  }
}

TEST(Ticker, SkipsMissedDeadlinesInsteadOfCatchingUp) {
  Ticker ticker(1000);
  const auto before = ticker.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(25));
  const auto late = ticker.wait();
  EXPECT_GE(late.skipped, 24u);
  const auto next = ticker.wait();
  EXPECT_GE(next.due_ns - late.due_ns, ticker.period_ns());
  EXPECT_EQ(late.due_ns - before.due_ns, static_cast<std::int64_t>(late.skipped + 1) * ticker.period_ns());
}

}  // namespace
}  // namespace palpate
