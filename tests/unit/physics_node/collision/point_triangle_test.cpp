#include "physics_node/collision/point_triangle.h"

#include <gtest/gtest.h>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Dice;

struct Moving {
  Vec3 p, dp;
  Triangle t, dt;
};

Moving random_motion(Dice& dice, double speed) {
  Moving m;
  m.p = dice.within(1);
  m.dp = dice.within(speed);
  for (std::size_t i = 0; i < 3; ++i) m.t[i] = dice.within(1), m.dt[i] = dice.within(speed);
  return m;
}

Triangle at_time(const Moving& m, double s) {
  return {m.t[0] + s * m.dt[0], m.t[1] + s * m.dt[1], m.t[2] + s * m.dt[2]};
}

TEST(PointTriangle, NoSampledPointOfATriangleIsNearerThanTheClosestOne) {
  Dice dice(1);
  for (int n = 0; n < 2000; ++n) {
    const Moving m = random_motion(dice, 0);
    const ClosestPoint found = closest_point(m.p, m.t);
    ASSERT_NEAR(found.weight.sum(), 1, 1e-12) << "seed 1, case " << n;
    ASSERT_GE(found.weight.minCoeff(), 0) << "seed 1, case " << n;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 q = m.t[0] + i / 20.0 * (m.t[1] - m.t[0]) + j / 20.0 * (m.t[2] - m.t[0]);
        ASSERT_GE((m.p - q).norm(), found.distance - 1e-12) << "seed 1, case " << n;
      }
  }
}

TEST(PointTriangle, ATriangleOfOnePointIsThatPoint) {
  const Vec3 a(1, 2, 3);
  const ClosestPoint found = closest_point({1, 2, 5}, {a, a, a});
  EXPECT_DOUBLE_EQ(found.distance, 2);
  EXPECT_EQ(found.away, Vec3(0, 0, 2));
}

TEST(PointTriangle, AdvancementNeverMissesAnApproach) {
  Dice dice(2);
  int near = 0, alarms = 0;
  for (int n = 0; n < 3600; ++n) {
    const bool fast = n >= 3000;  // by some hundred times their distance
    const Moving m = random_motion(dice, fast ? 50 : 2);
    const Vec3 away = closest_point(m.p, m.t).away;
    const double start = away.norm(), least = 0.3 * start;
    const bool told = comes_nearer(m.p, m.dp, m.t, m.dt, away, least);
    double nearest = start;
    const int looks = fast ? 10000 : 400;
    for (int i = 0; i <= looks; ++i) {
      const double s = 1.0 * i / looks;
      nearest = std::min(nearest, closest_point(m.p + s * m.dp, at_time(m, s)).distance);
    }
    if (nearest < least) {
      ++near;
      ASSERT_TRUE(told) << "seed 2, case " << n;
    }
    // It may err to the side of yes by a tenth of what is left.
    if (told) {
      ++alarms;
      ASSERT_LT(nearest, least + 0.1 * (start - least) + 0.02) << "seed 2, case " << n;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_LT(alarms, 3000);
}

TEST(PointTriangle, PassagesAreThoseThatSidesTell) {
  // A point that starts on one side of a large triangle and ends on the other has gone through it an odd number of times.
  Dice dice(3);
  int through = 0;
  for (int n = 0; n < 3000; ++n) {
    Moving m = random_motion(dice, 0.2);
    m.t = {Vec3(-50, -50, 0), Vec3(50, -50, 0), Vec3(0, 80, 0)};
    m.p.z() = dice.between(-0.3, 0.3);
    const auto side = [&](double s) {
      const Triangle t = at_time(m, s);
      return (t[1] - t[0]).cross(t[2] - t[0]).dot(m.p + s * m.dp - t[0]) > 0;
    };
    int crossings = 0;
    for (int s = 0; s < 200; ++s) crossings += side(s / 200.0) != side((s + 1) / 200.0) ? 1 : 0;
    ASSERT_EQ(passes_through(m.p, m.dp, m.t, m.dt), crossings > 0) << "seed 3, case " << n;
    through += crossings > 0 ? 1 : 0;
  }
  EXPECT_GT(through, 300);
}

}  // namespace
}  // namespace palpate::physics
