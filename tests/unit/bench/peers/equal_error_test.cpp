#include "bench/peers/equal_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::bench {
namespace {

TEST(EqualError, ARunThatIsBeatenInTimeAndErrorIsLeftOut) {
  const auto best = best_runs({{1e-3, 4}, {1e-1, 1}, {2e-1, 2}, {1e-2, 2}, {1e-2, 3}});
  ASSERT_EQ(best.size(), 3U);
  EXPECT_EQ(best[0].error, 1e-1);
  EXPECT_EQ(best[1].error, 1e-2);
  EXPECT_EQ(best[1].seconds, 2);
  EXPECT_EQ(best[2].error, 1e-3);
}

TEST(EqualError, APowerLawIsInterpolatedExactly) {
  // Second order: error = 0.3 / seconds^2.
  std::vector<TimeOfError> runs;
  for (const double seconds : {1.0, 2.0, 3.0, 7.0}) runs.push_back({0.3 / (seconds * seconds), seconds});
  const auto best = best_runs(runs);
  for (const double error : {0.3, 0.2, 0.1, 0.05, 0.01, 0.3 / 49}) {
    const auto seconds = seconds_for(best, error);
    ASSERT_TRUE(seconds) << error;
    EXPECT_NEAR(*seconds, std::sqrt(0.3 / error), 1e-12) << error;
  }
}

TEST(EqualError, ACoarseAnswerCostsWhatTheFastestRunCosts) {
  EXPECT_EQ(seconds_for(best_runs({{1e-2, 2}, {1e-3, 5}}), 1), 2);
}

TEST(EqualError, NoTimeForAnErrorThatIsNeverReached) {
  EXPECT_FALSE(seconds_for(best_runs({{1e-2, 2}, {1e-3, 5}}), 9e-4));
  EXPECT_FALSE(seconds_for({}, 1));
}

}  // namespace
}  // namespace palpate::bench
