#include "render_node/model/history.h"

#include <gtest/gtest.h>

#include "common/message/messages.h"

namespace palpate::render {
namespace {

TEST(History, HoldsTheLastTenSeconds) {
  History history;
  for (int i = 0; i <= 25000; ++i) history.add(i * 1e-3, i * 1e-3);
  const auto points = history.points();
  EXPECT_NEAR(points.front().age, History::span_s, 1e-9);
  EXPECT_NEAR(points.back().age, 0.0, 1e-9);
  EXPECT_EQ(points.size(), 1001U);
  EXPECT_NEAR(history.peak(), 25.0, 1e-9);
  EXPECT_NEAR(history.now(), 25.0, 1e-9);
}

TEST(History, KeepsAPeakOfOneSample) {
  History history;
  for (int i = 0; i < 1000; ++i) history.add(i * 1e-3, i == 503 ? 7.0 : 1.0);
  EXPECT_EQ(history.peak(), 7.0);
  EXPECT_EQ(history.now(), 1.0);
}

TEST(History, KeepsTheSignOfTheLargestMagnitude) {
  History history;
  for (const double value : {0.5, -3.0, 2.0}) history.add(0.001, value);
  ASSERT_EQ(history.points().size(), 1U);
  EXPECT_EQ(history.points().front().value, -3.0);
  EXPECT_EQ(history.peak(), 3.0);
}

TEST(History, ForgetsAPeakThatHasPassed) {
  History history;
  history.add(0.0, 9.0);
  history.add(10.5, 1.0);
  EXPECT_EQ(history.peak(), 1.0);
}

TEST(History, StartsAnewWhenTimeGoesBack) {
  History history;
  history.add(5.0, 3.0);
  history.add(0.1, 1.0);
  EXPECT_EQ(history.points().size(), 1U);
  EXPECT_EQ(history.peak(), 1.0);
}

TEST(History, IgnoresATimeThatIsNone) {
  History history;
  history.add(1.0, 3.0);
  for (const double t : {1e300, 1e17, -1e17, -1e300}) history.add(t, 9.0);
  EXPECT_EQ(history.points().size(), 1U);
  EXPECT_EQ(history.peak(), 3.0);
  history.add(longest_time, 2.0);
  EXPECT_EQ(history.points().size(), 1U) << "what is older than the span has gone";
}

}  // namespace
}  // namespace palpate::render
