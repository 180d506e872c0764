// Every hyperelastic law, by what must hold of all: stress is the slope of the energy and its change that of the stress, a
// turned body is strained as before, rest is free of stress, small strain is linear elasticity of the moduli stated.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "physics_node/material/lame.h"
#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"

namespace palpate::physics {
namespace {

using Matrix = Eigen::Matrix3d;

Tensor<double> tensor(const Matrix& m) {
  Tensor<double> t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      t[i][j] = m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return t;
}
Matrix matrix(const Tensor<double>& t) {
  Matrix m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = t[i][j];
  return m;
}

template <class Law>
class Laws : public testing::Test {
 protected:
  static constexpr double modulus = 10e3, poisson_ratio = 0.45;
  Lame lame = lame_of(modulus, poisson_ratio);
  Law law{lame.mu, lame.lambda};
  std::mt19937_64 dice{20261123};

  Matrix random(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    Matrix m;
    for (double& entry : m.reshaped()) entry = any(dice);
    return m;
  }
  double psi(const Matrix& h) const { return law.psi(tensor(h)); }
  Matrix stress(const Matrix& h) const { return matrix(law.stress(tensor(h))); }
  Matrix stress_change(const Matrix& h, const Matrix& dh) const {
    return matrix(law.stress_change(tensor(h), tensor(dh)));
  }
};

using All = testing::Types<StableNeoHookean<Scalar<double>>, StVenantKirchhoff<Scalar<double>>>;
TYPED_TEST_SUITE(Laws, All);

TYPED_TEST(Laws, StressIsTheSlopeOfTheEnergy) {
  for (int n = 0; n < 200; ++n) {
    const Matrix h = this->random(0.6), p = this->stress(h);
    constexpr double d = 1e-5;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) {
        Matrix more = h, less = h;
        more(i, j) += d, less(i, j) -= d;
        EXPECT_NEAR((this->psi(more) - this->psi(less)) / (2 * d), p(i, j),
                    1e-6 * (p.norm() + this->modulus));
      }
  }
}

TYPED_TEST(Laws, StressChangesAsItsTangentSays) {
  for (int n = 0; n < 200; ++n) {
    const Matrix h = this->random(0.6), dh = this->random(1);
    constexpr double d = 1e-5;
    const Matrix slope = (this->stress(h + d * dh) - this->stress(h - d * dh)) / (2 * d);
    const Matrix change = this->stress_change(h, dh);
    EXPECT_LT((slope - change).norm(), 1e-6 * (change.norm() + this->modulus));
    // The tangent of an energy is symmetric.
    const Matrix other = this->random(1);
    EXPECT_NEAR(change.cwiseProduct(other).sum(), this->stress_change(h, other).cwiseProduct(dh).sum(),
                1e-11 * change.norm() * other.norm());
  }
}

TYPED_TEST(Laws, AreNoStifferThanTheirBound) {
  double nearest = 0;
  for (int n = 0; n < 2000; ++n) {
    const Matrix h = this->random(n % 2 == 0 ? 0.01 : 1.5), dh = this->random(1);
    const double stiffness = this->law.stiffness(tensor(h));
    const double ratio = this->stress_change(h, dh).norm() / (stiffness * dh.norm());
    EXPECT_LE(ratio, 1);
    nearest = std::max(nearest, ratio);
  }
  EXPECT_GT(nearest, 0.25) << "and not idle";
}

TYPED_TEST(Laws, KnowNothingOfTheObserver) {
  for (int n = 0; n < 200; ++n) {
    const Matrix h = this->random(0.4), f = Matrix::Identity() + h;
    const Matrix q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const Matrix turned = q * f - Matrix::Identity();  // of the observer
    EXPECT_NEAR(this->psi(turned), this->psi(h), 1e-12 * (1 + this->psi(h)) * this->modulus);
    EXPECT_LT((this->stress(turned) - q * this->stress(h)).norm(), 1e-10 * this->modulus);
    // Of the material, which is isotropic.
    EXPECT_NEAR(this->psi(f * q - Matrix::Identity()), this->psi(h),
                1e-12 * (1 + this->psi(h)) * this->modulus);
    // P F^T, the Kirchhoff stress, is symmetric: no torque within.
    const Matrix kirchhoff = this->stress(h) * f.transpose();
    EXPECT_LT((kirchhoff - kirchhoff.transpose()).norm(), 1e-11 * kirchhoff.norm());
  }
}

TYPED_TEST(Laws, AreFreeOfStressAtRestAndTurned) {
  EXPECT_EQ(this->stress(Matrix::Zero()), Matrix::Zero());
  EXPECT_EQ(this->psi(Matrix::Zero()), 0.0);
  for (int n = 0; n < 100; ++n) {
    const Matrix q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    EXPECT_LT(this->stress(q - Matrix::Identity()).norm(), 1e-11 * this->modulus);
    EXPECT_NEAR(this->psi(q - Matrix::Identity()), 0, 1e-12 * this->modulus);
  }
}

TYPED_TEST(Laws, HaveTheStatedModuliAtSmallStrain) {
  // A bar that is pulled and free at its sides: E, and how much thinner it gets: nu.
  constexpr double strain = 1e-7;
  Matrix h = Matrix::Zero();
  h.diagonal() << strain, -this->poisson_ratio * strain, -this->poisson_ratio * strain;
  const Matrix p = this->stress(h);
  EXPECT_NEAR(p(0, 0) / strain, this->modulus, 1e-5 * this->modulus);
  EXPECT_NEAR(p(1, 1) / strain, 0, 1e-5 * this->modulus);
  Matrix shear = Matrix::Zero();
  shear(0, 1) = strain;
  EXPECT_NEAR(this->stress(shear)(0, 1) / strain, this->lame.mu, 1e-5 * this->modulus);
  EXPECT_NEAR(this->stress(shear)(1, 0) / strain, this->lame.mu, 1e-5 * this->modulus);
}

TYPED_TEST(Laws, KeepThreeMoreDigitsInFloatThanStrainHas) {
  // From H and not from F = I + H: a strain of 1e-5 in float keeps its stress within 1e-5 and not only within 1e-2.
  using Single = std::conditional_t<std::is_same_v<TypeParam, StableNeoHookean<Scalar<double>>>,
                                    StableNeoHookean<Scalar<float>>, StVenantKirchhoff<Scalar<float>>>;
  const Single single_law{static_cast<float>(this->lame.mu), static_cast<float>(this->lame.lambda)};
  const Matrix h = this->random(1e-5);
  Tensor<float> single;
  for (std::size_t n = 0; n < 9; ++n)
    single[n / 3][n % 3] =
        static_cast<float>(h(static_cast<Eigen::Index>(n / 3), static_cast<Eigen::Index>(n % 3)));
  const auto p = single_law.stress(single);
  const Matrix exact = this->stress(h);
  for (std::size_t n = 0; n < 9; ++n)
    EXPECT_NEAR(static_cast<double>(p[n / 3][n % 3]),
                exact(static_cast<Eigen::Index>(n / 3), static_cast<Eigen::Index>(n % 3)),
                1e-5 * exact.norm());
}

TEST(StableNeoHookean, ResistsBeingTurnedInsideOut) {
  // Squeezed along x from 1 to -1: the force along x pushes back all the way, where St Venant-Kirchhoff gives up.
  const Lame lame = lame_of(10e3, 0.45);
  const StableNeoHookean<Scalar<double>> law{lame.mu, lame.lambda};
  const StVenantKirchhoff<Scalar<double>> green{lame.mu, lame.lambda};
  double least_green = 0;
  for (double stretch = 0.99; stretch > -1; stretch -= 0.01) {
    Tensor<double> h{};
    h[0][0] = stretch - 1;
    EXPECT_LT(law.stress(h)[0][0], 0) << stretch;
    least_green = std::min(least_green, green.stress(h)[0][0]);
  }
  Tensor<double> flat{};
  flat[0][0] = -1;
  EXPECT_EQ(green.stress(flat)[0][0], 0);
  Tensor<double> softest{};
  softest[0][0] = 1 / std::numbers::sqrt3 - 1;
  EXPECT_NEAR(least_green, green.stress(softest)[0][0], 1e-3 * std::abs(least_green))
      << "from there on it softens";
}

TEST(Lame, AreThoseOfTheBook) {
  const Lame lame = lame_of(10e3, 0.25);
  EXPECT_DOUBLE_EQ(lame.mu, 4e3);
  EXPECT_DOUBLE_EQ(lame.lambda, 4e3);
  EXPECT_DOUBLE_EQ(p_wave_modulus(lame), 12e3);
}

}  // namespace
}  // namespace palpate::physics
