#include "haptic_node/tissue/friction_contact.h"

#include <gtest/gtest.h>

#include <random>

namespace palpate::haptic {
namespace {

TEST(FrictionContact, IsNoneOutside) {
  const FrictionContact c = solve_contact(Mat3::Identity() / 500, Vec3(1e-3, 2e-3, 3e-3), Vec3::UnitZ(), 0.3);
  EXPECT_FALSE(c.touching);
  EXPECT_EQ(c.force, Vec3(Vec3::Zero()));
  EXPECT_EQ(c.gap, Vec3(1e-3, 2e-3, 0));
}

TEST(FrictionContact, SticksByTheWholeCompliance) {
  Mat3 C;
  C << 3e-3, 1e-4, 2e-4, 1e-4, 3e-3, -1e-4, 2e-4, -1e-4, 5e-3;
  const Vec3 e(0.2e-3, -0.1e-3, -3e-3);
  const FrictionContact c = solve_contact(C, e, Vec3::UnitZ(), 0.5);
  EXPECT_TRUE(c.touching);
  EXPECT_LT((C * c.force - e).norm(), 1e-15);
  EXPECT_EQ(c.gap, Vec3(Vec3::Zero()));
}

/// 500 N/m, 2 mm deep, 3 mm aside, mu 0.3: 1 N and 0.3 N, and 3 mm less 0.6 mm have slid.
TEST(FrictionContact, SlidesOnTheCone) {
  const FrictionContact c = solve_contact(Mat3::Identity() / 500, Vec3(3e-3, 0, -2e-3), Vec3::UnitZ(), 0.3);
  EXPECT_LT((c.force - Vec3(0.3, 0, -1)).norm(), 1e-12);
  EXPECT_LT((c.gap - Vec3(2.4e-3, 0, 0)).norm(), 1e-14);
}

/// For any compliance: the force is in the cone, what slides slides along, and pressing meets the point.
TEST(FrictionContact, KeepsItsLaws) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  int sticking = 0, sliding = 0;
  for (int i = 0; i < 10'000; ++i) {
    Mat3 A;
    for (Eigen::Index k = 0; k < 9; ++k) A.data()[k] = any(random);
    const Mat3 C = 1e-3 * (A * A.transpose() + Mat3::Identity());
    const Vec3 n = Vec3(0.3 * any(random), 0.3 * any(random), 1).normalized();
    const Vec3 e = 2e-3 * Vec3(any(random), any(random), any(random));
    const double mu = 0.5 * (1 + any(random));
    const FrictionContact c = solve_contact(C, e, n, mu);
    ASSERT_EQ(c.touching, n.dot(e) < 0);
    const double pressed = -n.dot(c.force);
    if (!c.touching) continue;
    EXPECT_GT(pressed, 0);
    EXPECT_LE((c.force + pressed * n).norm(), mu * pressed + 1e-9);
    EXPECT_NEAR(n.dot(c.gap), 0, 1e-12);
    EXPECT_LT((C * c.force + c.gap - e).norm(), 1e-12);
    ++(c.gap.norm() > 0 ? sliding : sticking);
  }
  EXPECT_GT(sticking, 300);
  EXPECT_GT(sliding, 300);
}

}  // namespace
}  // namespace palpate::haptic
