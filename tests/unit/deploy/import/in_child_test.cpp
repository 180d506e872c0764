#include "deploy/import/in_child.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

namespace palpate {
namespace {

int nap() {
  for (int n = 0; n < 35; ++n) usleep(100'000);
  return 7;
}

TEST(RunInChild, SaysWhileItWaitsThatItStillDoes) {
  std::vector<int> said;
  EXPECT_EQ(run_in_child(
                nap, [&](int seconds) { said.push_back(seconds); }, 1),
            7);
  ASSERT_GE(said.size(), 2u);
  EXPECT_EQ(said[0], 1);
  EXPECT_EQ(said[1], 2);
}

TEST(RunInChild, SaysNothingOfWhatIsSoonDone) {
  int said = 0;
  EXPECT_EQ(run_in_child([] { return 3; }, [&](int) { ++said; }, 100), 3);
  EXPECT_EQ(said, 0);
}

}  // namespace
}  // namespace palpate
