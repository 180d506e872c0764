#include "haptic_node/safety/leak_limit.h"

#include <gtest/gtest.h>

namespace palpate::haptic {
namespace {

constexpr double T = 1e-3, K = 500;

/// A wall as the copy sees it: pressed `e` deep after a way of `way`, with a force held for a tick and a tick late.
LeakStep on_a_wall(double e, double way, double force_before) {
  const double energy = 0.5 * K * e * e;
  return LeakStep::along(way, way / T, 0.5 * (force_before + K * e) * way, 0, K * e, energy, energy);
}

/// Presses from 0.2 to 2.2 mm and back, again and again. @return most that the hand has got out of it [J]
double bounced(bool limited, int times) {
  LeakLimit limit(0, T);
  double got = 0, most = 0, sent[2] = {0, 0}, before = 0;
  for (int k = 0; k < times; ++k)
    for (int n = 1; n <= 40; ++n) {
      const double way = n <= 20 ? 1e-4 : -1e-4, e = 0.2e-3 + (n <= 20 ? 1e-4 * n : 1e-4 * (40 - n));
      got -= sent[1] * way;
      const double share = limit.share(on_a_wall(e, way, before));
      before = K * e;
      const double force = limited ? share * K * e : K * e;
      limit.sent(force);
      sent[1] = sent[0], sent[0] = force;
      most = std::max(most, got);
    }
  return most;
}

TEST(LeakLimit, GivesNoMoreThanItsSlackHoweverOften) {
  EXPECT_GT(bounced(false, 50), 10 * LeakLimit::slack);  // what late forces give without it
  EXPECT_LE(bounced(true, 50), 2 * LeakLimit::slack + 0.5 * K * 0.2e-3 * 0.2e-3);
}

/// What the copy dissipates is no leak: viscous tissue is not held back.
TEST(LeakLimit, KnowsWhatTheCopyDissipates) {
  for (const bool told : {true, false}) {
    LeakLimit limit(0, T);
    double least = 1;
    for (int n = 0; n < 5000; ++n) {
      // The hand goes back and forth against 0.5 N of pure drag: it gives work both ways.
      const double way = n % 100 < 50 ? 2e-5 : -2e-5, force = way > 0 ? 0.75 : 0.25;
      const LeakStep step =
          LeakStep::along(way, way / T, force * way, told ? 0.25 * std::abs(way) : 0.0, force, 1e-4, 3e-4);
      least = std::min(least, limit.share(step));
      limit.sent(0.5);
    }
    EXPECT_EQ(least == 1, told) << least;
    EXPECT_EQ(least < 0.5, !told) << least;
  }
}

/// On the way out only the spring's energy counts: that of the tissue is not its to give.
TEST(LeakLimit, CountsTheSpringAloneOnTheWayOut) {
  const auto share = [](double speed) {
    LeakLimit limit(0, T);
    const LeakStep step = LeakStep::along(0, speed, 0.2e-3, 0, 1.0, 0.3e-3, 10e-3);
    return limit.share(step);
  };
  EXPECT_EQ(share(0), 1);
  EXPECT_NEAR(share(-0.01), 2 * (0.3 - 0.2 + 0.04) / 0.3, 1e-12);
}

/// A surface never stays away: without contact half the slack is there again, once the copy has come to rest.
TEST(LeakLimit, ForgetsOutsideWhatTheCopyHasNoMore) {
  LeakLimit limit(0, T);
  const LeakStep leak = LeakStep::along(0, 0, 5e-3, 0, 1.0, 0.3e-3, 0.3e-3);
  EXPECT_EQ(limit.share(leak), 0);
  EXPECT_EQ(limit.left(), 0);
  limit.sent(0);
  LeakStep swings;
  swings.whole_energy = 3e-3;
  EXPECT_EQ(limit.share(swings), 1);
  EXPECT_NEAR(limit.leak(), 3e-3 + 0.5 * LeakLimit::slack, 1e-18);
  EXPECT_EQ(limit.share({}), 1);
  EXPECT_NEAR(limit.leak(), 0.5 * LeakLimit::slack, 1e-18);
}

}  // namespace
}  // namespace palpate::haptic
