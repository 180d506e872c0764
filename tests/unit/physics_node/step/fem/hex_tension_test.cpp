// When tissue begins to break: against eigenvalues, and what must not break.
#include "physics_node/step/fem/hex_tension.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "physics_node/material/lame.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;

struct Tissue {
  double nu, b;
  Lame lame() const { return lame_of(10e3, nu); }
  double of_volume() const { return (lame().lambda + lame().mu) / lame().mu; }
  TensionLimit<double> limit() const { return tension_limit(b, lame().mu, lame().lambda); }

  bool begins(const Eigen::Matrix3d& F) const {
    Tensor<double> h;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        h[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = F(i, j) - (i == j ? 1 : 0);
    return least_minor<One>(breaking_stretch<One>(limit(), of_volume(), h), stretching<One>(h)) <= 0;
  }
  /// As hex_tension.h says it: principal stretches and stresses.
  bool must_begin(const Eigen::Matrix3d& F) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squared(F.transpose() * F);
    const double l2 = squared.eigenvalues()[2], J = F.determinant();
    const double mu = lame().mu, q = (lame().lambda + mu) * (J - 1) - mu;
    return l2 >= b * b && mu * l2 + q * J >= 0.5 * bar_stress();
  }
  /// Kirchhoff's, of a bar stretched to b, by bisection for its sides.
  double bar_stress() const {
    const double mu = lame().mu, lambda = lame().lambda;
    double lo = 0.2, hi = 1;
    for (int n = 0; n < 100; ++n) {
      const double t = 0.5 * (lo + hi), J = b * t * t;
      (mu * t * t + ((lambda + mu) * (J - 1) - mu) * J > 0 ? hi : lo) = t;
    }
    const double J = b * lo * lo;
    return mu * b * b + ((lambda + mu) * (J - 1) - mu) * J;
  }
  Eigen::Matrix3d bar(double stretch) const {
    const double mu = lame().mu, J = 1 + (1 - 1 / stretch) * mu / (lame().lambda + mu);
    const double t = std::sqrt(J / stretch);
    return Eigen::Vector3d(stretch, t, t).asDiagonal();
  }
};

constexpr Tissue tissues[] = {{0.3, 1.1}, {0.45, 1.3}, {0.49, 2.0}};

TEST(TensionLimit, IsThatOfABar) {
  for (const Tissue& tissue : tissues) {
    EXPECT_NEAR(2 * tissue.lame().mu * tissue.limit().tension, tissue.bar_stress(),
                1e-9 * tissue.bar_stress());
    EXPECT_FALSE(tissue.begins(tissue.bar(tissue.b - 1e-9)));
    EXPECT_TRUE(tissue.begins(tissue.bar(tissue.b + 1e-9)));
  }
}

TEST(TensionLimit, AgreesWithPrincipalStretchesAndStresses) {
  std::mt19937_64 dice(7);
  std::normal_distribution<double> some(0, 0.4);
  int begun = 0, whole = 0;
  for (const Tissue& tissue : tissues)
    for (int n = 0; n < 20000; ++n) {
      Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
      for (int i = 0; i < 9; ++i) F(i / 3, i % 3) += some(dice);
      const bool must = tissue.must_begin(F);
      EXPECT_EQ(tissue.begins(F), must) << F;
      (must ? begun : whole) += 1;
    }
  EXPECT_GT(begun, 1000);
  EXPECT_GT(whole, 1000);
}

TEST(TensionLimit, DoesNotSeeRotation) {
  std::mt19937_64 dice(3);
  std::normal_distribution<double> some(0, 1);
  for (const Tissue& tissue : tissues)
    for (int n = 0; n < 200; ++n) {
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(some(dice), some(dice), some(dice), some(dice)).normalized();
      const Eigen::Matrix3d R = q.toRotationMatrix();
      EXPECT_FALSE(tissue.begins(R));
      EXPECT_FALSE(tissue.begins(R * tissue.bar(tissue.b - 1e-6)));
      EXPECT_TRUE(tissue.begins(R * tissue.bar(tissue.b + 1e-6) * R.transpose()));
    }
}

/// A bar pressed to 0.4 bulges to 1.6 times its width, and nothing pulls at its sides.
TEST(TensionLimit, LeavesWhatIsPressedWhole) {
  for (const Tissue& tissue : tissues)
    for (double stretch = 0.4; stretch < 1; stretch += 0.01) {
      EXPECT_FALSE(tissue.begins(tissue.bar(stretch))) << stretch;
      EXPECT_FALSE(tissue.begins(Eigen::Vector3d(stretch, 1, 1).asDiagonal())) << stretch;
      EXPECT_FALSE(tissue.begins(Eigen::Vector3d(stretch, stretch, stretch).asDiagonal())) << stretch;
    }
}

TEST(TensionLimit, BreaksSheetsAndShearsAtTheSameStretch) {
  for (const Tissue& tissue : tissues)
    for (const double beyond : {-1e-6, 1e-6}) {
      const double l = tissue.b + beyond;
      EXPECT_EQ(tissue.begins(Eigen::Vector3d(l, 1, 1 / l).asDiagonal()), beyond > 0);
      Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
      shear(0, 1) = l - 1 / l;  // its largest stretch is l
      EXPECT_EQ(tissue.begins(shear), beyond > 0);
    }
}

}  // namespace
}  // namespace palpate::physics
