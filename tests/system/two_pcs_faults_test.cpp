// Two PCs whose clocks show different times, and whose cable is pulled and put back while the hand presses.

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/time/clock.h"
#include "tests/system/faults/hand_log.h"
#include "tests/system/faults/pressing_scene.h"
#include "tests/system/two_pcs.h"

namespace palpate::test {
namespace {

using testing::HasSubstr;

constexpr double clock_step_s = 0.01;  // of the clock by which the lab says when it pulled the cable

class TwoPcsFaults : public TwoPcs {
 protected:
  void SetUp() override {
    TwoPcs::SetUp();
    setenv("PALPATE_DRIVERS", WATCHED_DRIVERS, 1);
    std::ofstream(folder / "press.toml") << pressing_scene();
  }
  ~TwoPcsFaults() override { unsetenv("PALPATE_DRIVERS"); }

  int session(const std::string& deployment, const std::string& options) const {
    return lab(fmt::format("run {} {} {}", deployment, quoted(folder / "press.toml"), options));
  }
  /// When the cable was pulled and put back, by the clock of the PC that is so much ahead [ns].
  void read_cut(double ahead_s) {
    std::ifstream file(folder / "out" / "cut.txt");
    std::string word;
    double pulled = 0, back = 0;
    ASSERT_TRUE(file >> word >> pulled >> word >> back);
    pulled_ns = ns_from_seconds(pulled + ahead_s);
    back_ns = ns_from_seconds(back + ahead_s);
  }
  /// When the newest picture was written, by this test's clock [ns].
  std::int64_t last_picture_ns(const std::string& pc) const {
    fs::file_time_type newest = fs::file_time_type::min();
    for (const auto& picture : fs::directory_iterator(folder / "out" / pc / "frames"))
      newest = std::max(newest, picture.last_write_time());
    const auto age = fs::file_time_type::clock::now() - newest;
    return now_ns() - std::chrono::duration_cast<std::chrono::nanoseconds>(age).count();
  }
  nlohmann::json haptic(const std::string& pc) const { return summary(pc)["haptic"]; }

  WatchedFile device{"/dev/shm/palpate_two_pcs_" + std::to_string(getpid()), WatchedFile::Role::test};
  HandLog hand{*device, block_stiffness, block_force_limit};
  std::int64_t pulled_ns = 0, back_ns = 0;
};

// Longer than DDS believes in a silent PC (5 s): the two must discover each other anew.
TEST_F(TwoPcsFaults, TheHandLosesItsForceWithTheCableAndFeelsAgainWhenItIsBack) {
  ASSERT_EQ(session("p3", "--seconds 11 --clock 5 --cut '1.7 6'"), 0) << text("said");
  ASSERT_NO_FATAL_FAILURE(read_cut(5));
  hand.read();
  EXPECT_EQ(hand.trouble(), "") << "a kick";
  EXPECT_GT(hand.largest_between(pulled_ns - 1'000'000'000, pulled_ns), 0.3) << "pressed before";
  const double force_s = seconds_from_ns(hand.last_force(pulled_ns, back_ns) - pulled_ns);
  EXPECT_LE(force_s, 0.4 + clock_step_s) << "a force without a source";
  std::printf("cable pulled for %.1f s: the last force after %.0f ms, the next %.2f s after it was back\n",
              seconds_from_ns(back_ns - pulled_ns), 1e3 * force_s,
              seconds_from_ns(hand.next_force(back_ns) - back_ns));
  EXPECT_GT(hand.largest_between(back_ns, back_ns + 5'000'000'000), 0.3) << "felt again";
  EXPECT_THAT(text("out/pc1.txt"), HasSubstr("haptic on "));
  EXPECT_THAT(text("out/pc1.txt"), HasSubstr(" has gone; it may come back"));
  EXPECT_EQ(haptic("pc2")["faults"], 0);
}

TEST_F(TwoPcsFaults, AHandThatIsWithItsTissueDoesNotFeelTheCable) {
  ASSERT_EQ(session("p2", "--seconds 6 --clock -5 --cut '1 3'"), 0) << text("said");
  ASSERT_NO_FATAL_FAILURE(read_cut(-5));
  hand.read();
  EXPECT_EQ(hand.trouble(), "") << "a kick";
  for (std::int64_t t = pulled_ns; t < back_ns; t += 1'000'000'000)
    EXPECT_GT(hand.largest_between(t, t + 1'000'000'000), 0.3)
        << seconds_from_ns(t - pulled_ns) << " s after";
  EXPECT_EQ(haptic("pc2")["faults"], 0);
  EXPECT_GT(last_picture_ns("pc1"), back_ns + 5'000'000'000 + 500'000'000) << "the eye sees the tissue again";
}

class TwoClocks : public TwoPcsFaults, public testing::WithParamInterface<int> {};

TEST_P(TwoClocks, MakeNoDifference) {
  ASSERT_EQ(session("p3", fmt::format("--seconds 3 --clock {}", GetParam())), 0) << text("said");
  hand.read();
  EXPECT_EQ(hand.trouble(), "") << "a kick";
  const auto felt = haptic("pc2");
  EXPECT_EQ(felt["faults"], 0);
  EXPECT_GT(felt["patches"].get<int>(), 500);
  EXPECT_GT(felt["loop_age_ms"]["p50"].get<double>(), 0.0);
  EXPECT_LT(felt["loop_age_ms"]["max"].get<double>(), 2500.0) << "half the difference of the clocks";
  EXPECT_GT(summary("pc1")["tools"]["tip"]["force_peak"].get<double>(), 0.3);
  EXPECT_GT(summary("pc1")["render"]["frames"].get<int>(), 5);
}

INSTANTIATE_TEST_SUITE_P(SecondsAhead, TwoClocks, testing::Values(-5, 5));

}  // namespace
}  // namespace palpate::test
