#include "haptic_node/safety/energy_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace palpate::haptic {
namespace {

constexpr double K = 1000, q = 55e-6, T = 1e-3;

Vec3 measured(const Vec3& x) { return (x / q).array().round().matrix() * q; }

/// A wall at z = 0 and a hand that takes its way whatever it feels, seen in steps of q, pushed a tick after its sample.
struct Wall {
  EnergyLimit limit{q};
  Vec3 x = Vec3::Zero(), v = Vec3::Zero(), seen = Vec3::Zero();
  Vec3 acting = Vec3::Zero(), sent = Vec3::Zero();
  double given = 0;  // truly [J]
  double share = 1;  // of the last tick

  void tick(const Vec3& to) {
    given += acting.dot(to - x);
    x = to;
    const Vec3 now = measured(x);
    v += 0.386 * ((now - seen) / T - v);  // 100 Hz
    seen = now;
    const double d = std::max(0.0, -now.z());
    const Vec3 force(0, 0, K * d);
    share = limit.share({now, v, Eigen::Quaterniond::Identity()}, T, 0.5 * K * d * d, 0, force);
    acting = sent;
    sent = share * force;
    limit.sent(sent, Vec3::Zero());
  }
  /// Given, as the limit believes [J].
  double believed() const { return limit.surplus() - limit.left(); }
};

class AtPace : public testing::TestWithParam<double> {};

/// Pressed and let out again at one step in n ticks. What steps feign is 40 uJ on such a way if nothing is done about it.
TEST_P(AtPace, KnowsWhatWasGiven) {
  Wall wall;
  const double step = q / GetParam();
  double z = 0.1 * q;
  for (; z > -17 * q; z -= step) wall.tick({0, 0, z});
  for (; z < -4 * q; z += step) wall.tick({0, 0, z});
  EXPECT_NEAR(wall.believed(), wall.given, GetParam() < 2 ? 20e-6 : 10e-6);
  EXPECT_LE(wall.given, EnergyLimit::slack);
  if (GetParam() > 3) {  // faster hands do gain by the delay
    EXPECT_EQ(wall.share, 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(EnergyLimit, AtPace, testing::Values(0.7, 1.0, 1.3, 2.0, 2.6, 3.4, 5.2, 11.0, 40.0));

/// A hand that slides fast along a wall trembles across a threshold of its encoder. It moves on the whole nowhere.
TEST(EnergyLimit, IsNotSpentByTremblingOnAThreshold) {
  Wall wall;
  double z = 0;
  for (; z > -18.4 * q; z -= 0.1 * q) wall.tick({0, 0, z});
  const double before = wall.believed();
  const double truly = wall.given;
  for (int i = 0; i < 2000; ++i) wall.tick({i * 0.36 * q, 0, -18.5 * q + 0.1 * q * std::sin(0.35 * i)});
  EXPECT_NEAR(wall.believed() - before, wall.given - truly, 20e-6);
  EXPECT_EQ(wall.share, 1.0);
}

/// Springs that were told to give what never was put in go soft, and never give more than the slack.
TEST(EnergyLimit, GivesNoMoreThanTheSlack) {
  EnergyLimit limit(0);
  const double d = 2e-3;
  double x = -d, given = 0, acting = 0, sent = 0;
  for (int i = 0; i < 200; ++i) {  // appears compressed, and lets itself out
    const double by = 2e-5;
    given += acting * by;
    x += by;
    const double depth = std::max(0.0, -x), force = K * depth;
    const double share = limit.share({{0, 0, x}, {0, 0, by / T}, Eigen::Quaterniond::Identity()}, T,
                                     0.5 * K * depth * depth, 0, {0, 0, force});
    acting = sent;
    sent = share * force;
    limit.sent({0, 0, sent}, Vec3::Zero());
  }
  EXPECT_GT(given, 0.5 * EnergyLimit::slack);
  EXPECT_LE(given, EnergyLimit::slack + 1e-9);
}

}  // namespace
}  // namespace palpate::haptic
