#include "deploy/palpate/progress.h"

#include <gtest/gtest.h>

namespace palpate::deploy {
namespace {

TEST(ProgressLine, ComesEveryTenSecondsWithWhatIsToGo) {
  double said = 0;
  EXPECT_EQ(progress_line(0.5, 6, 3, said), "");
  EXPECT_EQ(progress_line(2, 6, 10, said), "2.00 of 6.00 s simulated in 10 s, 20 s to go");
  EXPECT_EQ(progress_line(2.1, 6, 12, said), "");
  EXPECT_EQ(progress_line(4, 6, 20.5, said), "4.00 of 6.00 s simulated in 20 s, 10 s to go");
  EXPECT_EQ(progress_line(6, 6, 40, said), "") << "the summary says it";
  said = 0;
  EXPECT_EQ(progress_line(0, 6, 30, said), "0.00 of 6.00 s simulated in 30 s");
}

}  // namespace
}  // namespace palpate::deploy
