// Hexahedra that yield, as laws of one cell: closed forms of bars, an independent integration of shear, and what must stay.
#include "physics_node/step/fem/hex_plastic.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include "tests/unit/physics_node/step/fem/plastic_cell.h"

namespace palpate::physics::test {
namespace {

/// Kirchhoff's stress over mu of a bar whose elastic stretch is l: l^2 - J / l, see hex_tension.h.
double bar_stress(double l) {
  const Lame lame = lame_of(E, nu);
  return l * l - (1 + (1 - 1 / l) * lame.mu / (lame.lambda + lame.mu)) / l;
}
/// ln l of the bar with that stress, by bisection.
double elastic_log(double stress) {
  double lo = 0.1, hi = 10;
  for (int n = 0; n < 200; ++n) (bar_stress(0.5 * (lo + hi)) < stress ? lo : hi) = 0.5 * (lo + hi);
  return std::log(0.5 * (lo + hi));
}

struct Bar {
  double stress, alpha, width;
};
Bar pulled_to(const Yielding& yielding, double stretch, int steps) {
  PlasticCell<double> cell(yielding);
  double t = 1;
  for (int n = 1; n <= steps; ++n) t = lead_bar(cell, std::exp(std::log(stretch) * n / steps));
  return {cell.stress()(0, 0) * stretch, cell.alpha(), t};
}

TEST(Plastic, BarsFollowTheirClosedForm) {
  for (const Yielding yielding : {Yielding{1.05, 0}, Yielding{1.05, 0.3}, Yielding{1.3, 0.1}})
    for (const double stretch : {2.0, 0.4}) {
      const YieldLimit limit = yield_limit(yielding, lame_of(E, nu).mu, lame_of(E, nu).lambda);
      EXPECT_NEAR(limit.stress, bar_stress(yielding.ratio), 1e-12);
      // |ln l| = |elastic| + alpha, |stress| = Y + K alpha
      const double sign = stretch > 1 ? 1 : -1;
      double lo = 0, hi = 2;
      for (int n = 0; n < 100; ++n) {
        const double alpha = 0.5 * (lo + hi);
        const double log_l = elastic_log(sign * (limit.stress + limit.hardening * alpha)) + sign * alpha;
        (sign * log_l < sign * std::log(stretch) ? lo : hi) = alpha;
      }
      const Bar bar = pulled_to(yielding, stretch, 400);
      const double stress = sign * (limit.stress + limit.hardening * lo);
      EXPECT_NEAR(bar.alpha, lo, 1e-4 * lo) << stretch;
      EXPECT_NEAR(bar.stress, stress, (yielding.hardening == 0 ? 1e-9 : 1e-4) * std::abs(stress));
    }
}

/// Where a bar yields, its stress goes on with the slope that was asked for.
TEST(Plastic, BarsHardenWithTheirSlope) {
  const Yielding yielding{1.001, 0.25};
  const double a = pulled_to(yielding, 1.002, 20).stress, b = pulled_to(yielding, 1.004, 40).stress;
  EXPECT_NEAR((b - a) * lame_of(E, nu).mu / 0.002, 0.25 * E, 0.01 * 0.25 * E);
}

TEST(Plastic, UnloadedBarsKeepTheSetOfTheClosedForm) {
  PlasticCell<double> cell({1.05, 0});
  for (int n = 1; n <= 200; ++n) lead_bar(cell, 1 + 0.005 * n);
  const double alpha = cell.alpha();
  EXPECT_NEAR(alpha, std::log(2.0) - std::log(1.05), 2e-4);
  const Vec3 rest(std::exp(alpha), std::exp(-alpha / 2), std::exp(-alpha / 2));
  const HexFlow<Scalar<double>> back = cell.lead_to(Matrix3d(rest.asDiagonal()));
  EXPECT_EQ(back.share, 0);
  EXPECT_LT(cell.stress().norm(), 2e-3) << "of " << bar_stress(1.05);
}

double order(const std::function<double(int)>& error, int coarse) {
  return std::log2(error(coarse) / error(2 * coarse));
}

TEST(Plastic, ErrorOfABarIsOfTheFirstOrderAtLeast) {
  const Yielding yielding{1.2, 0.2};
  const double exact = pulled_to(yielding, 1.8, 1600).alpha;
  EXPECT_GT(order([&](int n) { return std::abs(pulled_to(yielding, 1.8, n).alpha - exact); }, 25), 0.9);
}

/// Simple shear, in the current frame and by Runge's and Kutta's method: b' = l b + b l^T + p I - r dev b, where r keeps |dev b| and p
/// keeps det b. @return b_e at the end
Matrix3d sheared(double limit, double shear, int steps) {
  Matrix3d l = Matrix3d::Zero();
  l(0, 1) = 1;
  const auto dev = [](const Matrix3d& m) { return Matrix3d(m - Matrix3d::Identity() * m.trace() / 3); };
  const auto rate = [&](const Matrix3d& b) {
    const Matrix3d moved = l * b + b * l.transpose(), B = dev(b);
    const double s = std::sqrt(1.5) * B.norm();
    const double r =
        s < limit * (1 - 1e-9) ? 0 : std::max(0.0, dev(moved).cwiseProduct(B).sum() / B.squaredNorm());
    const Matrix3d inverse = b.inverse();
    // tr(b^-1 (p I - r B)) = 0
    const double p = r * inverse.cwiseProduct(B).sum() / inverse.trace();
    return Matrix3d(moved + p * Matrix3d::Identity() - r * B);
  };
  // Elastic until 3/2 (2 g^2 + 2/3 g^4) = limit^2.
  const double g = std::sqrt((-3 + std::sqrt(9 + 4 * limit * limit)) / 2);
  Matrix3d F = Matrix3d::Identity();
  F(0, 1) = g;
  Matrix3d b = F * F.transpose();
  const double d = (shear - g) / steps;
  for (int n = 0; n < steps; ++n) {
    const Matrix3d k1 = rate(b), k2 = rate(b + d / 2 * k1), k3 = rate(b + d / 2 * k2), k4 = rate(b + d * k3);
    b += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return b;
}

TEST(Plastic, ShearsAsInTheCurrentFrame) {
  const double limit = yield_limit({1.15, 0}, lame_of(E, nu).mu, lame_of(E, nu).lambda).stress;
  const Matrix3d exact = sheared(limit, 2.0, 20000);
  EXPECT_NEAR(exact.determinant(), 1, 1e-6);
  const auto error = [&](int steps) {
    PlasticCell<double> cell({1.15, 0});
    Matrix3d F = Matrix3d::Identity();
    for (int n = 1; n <= steps; ++n) {
      F(0, 1) = 2.0 * n / steps;
      cell.lead_to(F);
    }
    const Matrix3d tau = cell.stress() * F.transpose();
    const Matrix3d difference = tau - exact;
    return (difference - Matrix3d::Identity() * difference.trace() / 3).norm();
  };
  EXPECT_LT(error(4000), 1e-3 * limit);
  EXPECT_GT(order(error, 100), 0.9);
  EXPECT_LT(order(error, 100), 1.2);
}

Matrix3d some_shape(std::mt19937_64& dice, double size) {
  std::normal_distribution<double> some(0, size);
  Matrix3d F = Matrix3d::Identity();
  for (int n = 0; n < 9; ++n) F(n / 3, n % 3) += some(dice);
  return F;
}

/// In random paths that load, unload and bend: volume stays, nothing heals, energy is lost and never made.
TEST(Plastic, KeepsVolumeAndLosesEnergyOnAnyPath) {
  std::mt19937_64 dice(5);
  std::normal_distribution<double> some(0, 0.2e-3);
  for (const Yielding yielding : {Yielding{1.02, 0}, Yielding{1.2, 0.02}}) {
    PlasticCell<double> cell(yielding);
    int flows = 0;
    for (int n = 0; n < 5000; ++n) {
      const Matrix3d F = some_shape(dice, 0.25);
      if (F.determinant() < 0.15) continue;
      const double alpha = cell.alpha();
      const auto flow = cell.lead_to(F, Vec3(some(dice), some(dice), some(dice)));
      EXPECT_GE(cell.alpha(), alpha);
      EXPECT_GE(flow.lost, 0);
      EXPECT_GE(flow.share, 0);
      EXPECT_LT(flow.share, 1);
      flows += flow.share > 0 ? 1 : 0;
      EXPECT_NEAR(cell.det_plastic(), 1, 1e-4) << "far jumps, too";
      EXPECT_LT(cell.load(), 1.02);
    }
    EXPECT_GT(flows, 300);
    // As steps do: small ones.
    Matrix3d F = Matrix3d::Identity();
    for (int n = 0; n < 20000; ++n) {
      F(0, 1) = std::sin(0.001 * n), F(2, 2) = 1 + 0.3 * std::sin(0.0007 * n);
      cell.lead_to(F);
      EXPECT_LE(cell.load(), 1 + 1e-9);
    }
    EXPECT_NEAR(cell.det_plastic(), 1, 1e-12);
  }
}

TEST(Plastic, InSinglePrecisionVolumeDoesNotStray) {
  PlasticCell<float> cell({1.02, 0.1});
  Matrix3d F = Matrix3d::Identity();
  for (int n = 0; n < 200000; ++n) {
    F(0, 1) = std::sin(0.001 * n), F(1, 2) = 0.3 * std::sin(0.0007 * n);
    cell.lead_to(F);
  }
  EXPECT_NEAR(cell.det_plastic(), 1, 1e-5);
  EXPECT_GT(cell.alpha(), 5.0F);
}

/// What is bent beyond its limit flows, too: the mean square of its stress is what counts, and its modes come back less.
TEST(Plastic, CellsYieldByBending) {
  PlasticCell<double> cell({1.05, 0});
  double bent = 0;
  while (cell.alpha() == 0 && bent < 5e-3) cell.lead_to(Matrix3d::Identity(), Vec3(bent += 1e-6, 0, 0));
  // W = m G / 2, distortion S^2 mu / 6 by volume.
  const HexConstants<double>& k = cell.constants();
  const double by_hand = std::sqrt(3 * bent * k.bend[0][0] * bent / (k.mu * k.volume));
  const double limit = yield_limit({1.05, 0}, lame_of(E, nu).mu, lame_of(E, nu).lambda).stress;
  EXPECT_NEAR(by_hand, limit, 2e-3 * limit);
  for (int n = 0; n < 1000; ++n) cell.lead_to(Matrix3d::Identity(), Vec3(bent += 3e-6, 0, 0));
  EXPECT_NEAR(cell.load(), 1, 1e-9);
  EXPECT_NEAR(cell.plastic()[9], 3e-3, 2e-5) << "all bending beyond its limit stays";
}

TEST(Plastic, TurnsWithTheCell) {
  std::mt19937_64 dice(11);
  for (int n = 0; n < 50; ++n) {
    const Matrix3d R = Eigen::AngleAxisd(0.1 * n, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    PlasticCell<double> still({1.05, 0.1}), turned({1.05, 0.1});
    std::mt19937_64 path(static_cast<std::uint64_t>(n));
    for (int step = 0; step < 20; ++step) {
      const Matrix3d F = some_shape(path, 0.15);
      still.lead_to(F);
      turned.lead_to(R * F);
    }
    EXPECT_GT(still.alpha(), 0.1);
    EXPECT_LT((R * still.stress() - turned.stress()).norm(), 1e-11 * still.stress().norm());
  }
  // At rest in its plastic shape it does not resist being turned at all.
  PlasticCell<double> cell({1.05, 0});
  for (int n = 1; n <= 100; ++n) lead_bar(cell, 1 + 0.01 * n);
  const Matrix3d cp_inverse = Matrix3d::Identity() + matrix_of(plastic_strain(cell.plastic()));
  const Matrix3d rest = Eigen::SelfAdjointEigenSolver<Matrix3d>(cp_inverse).operatorInverseSqrt();
  for (int n = 0; n < 20; ++n) {
    const Matrix3d R = Eigen::AngleAxisd(0.5 * n, Vec3(3, 1, 2).normalized()).toRotationMatrix();
    EXPECT_EQ(cell.lead_to(R * rest).share, 0);
    EXPECT_LT(cell.stress().norm(), 1e-12);
  }
}

/// Forces are the gradient of the energy, and neither push nor turn the cell as a whole.
TEST(Plastic, ForcesAreTheGradientOfTheEnergy) {
  std::mt19937_64 dice(3);
  std::normal_distribution<double> some(0, 0.3e-3);
  for (int n = 0; n < 10; ++n) {
    PlasticCell<double> cell({1.02, 0.1});
    Corners<Scalar<double>> w{};
    for (int step = 0; step < 10; ++step) {
      for (auto& axis : w)
        for (double& one : axis) one = some(dice);
      cell.lead_corners(w);
    }
    ASSERT_GT(cell.alpha(), 0.1);
    Corners<Scalar<double>> f{}, unused{};
    cell.energy(w, f);
    Vec3 sum = Vec3::Zero(), turn = Vec3::Zero();
    double size = 0;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vec3 force(f[0][a], f[1][a], f[2][a]);
      const Vec3 sign((a & 1) != 0 ? 1 : -1, (a >> 1 & 1) != 0 ? 1 : -1, (a >> 2) != 0 ? 1 : -1);
      sum += force;
      turn += Vec3(0.5 * sign.cwiseProduct(edge) + Vec3(w[0][a], w[1][a], w[2][a])).cross(force);
      size += force.norm();
      for (std::size_t c = 0; c < 3; ++c) {
        const double d = 1e-9, here = w[c][a];
        w[c][a] = here + d;
        const double more = cell.energy(w, unused);
        w[c][a] = here - d;
        const double less = cell.energy(w, unused);
        w[c][a] = here;
        EXPECT_NEAR(f[c][a], -(more - less) / (2 * d), 1e-6 * size + 1e-7);
      }
    }
    EXPECT_LT(sum.norm(), 1e-13 * size);
    EXPECT_LT(turn.norm(), 1e-13 * size * edge.norm());
  }
}

/// Round a closed cycle work is what is booked as plastic: the area of the hysteresis.
TEST(Plastic, HysteresisIsWhatIsLost) {
  for (const Yielding yielding : {Yielding{1.05, 0}, Yielding{1.1, 0.2}}) {
    const auto off = [&](int steps) {
      PlasticCell<double> cell(yielding);
      Corners<Scalar<double>> f{}, before{};
      cell.energy(cell.corners(), before);
      double work = 0, booked = 0, stored = 0;
      Corners<Scalar<double>> w = cell.corners();
      for (int n = 1; n <= steps; ++n) {
        const double turn = 4 * M_PI * n / steps;
        Matrix3d F = Matrix3d::Identity();
        F(0, 1) = 0.5 * std::sin(turn), F(2, 2) = 1 + 0.2 * std::sin(2 * turn);
        cell.lead_to(F, Vec3(1e-3 * std::sin(turn), 0, 0));
        stored = cell.energy(cell.corners(), f);
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t a = 0; a < 8; ++a)
            work -= 0.5 * (f[c][a] + before[c][a]) * (cell.corners()[c][a] - w[c][a]);
        w = cell.corners();
        before = f;
        booked = cell.plastic_work();
      }
      EXPECT_GT(booked, 0.1 * cell.mu_v() * std::pow(yielding.ratio - 1, 2));
      return std::abs(work - stored - booked) / booked;
    };
    EXPECT_LT(off(2000), 2e-3);
    EXPECT_LT(off(8000), 0.35 * off(2000));
  }
}

/// A bar that has yielded breaks at its ratio, though its stress is lower than that of one that has not.
TEST(Plastic, BarsBreakAtTheirRatioAfterYielding) {
  const Lame lame = lame_of(E, nu);
  for (const Yielding yielding : {Yielding{1.05, 0}, Yielding{1.05, 0.2}}) {
    const TensionLimit<double> limit = break_limit(1.5, yielding, lame.mu, lame.lambda);
    const double of_volume = (lame.lambda + lame.mu) / lame.mu;
    PlasticCell<double> cell(yielding);
    for (int n = 1; n <= 60; ++n) {
      const double stretch = 1 + 0.01 * n;
      const double t = lead_bar(cell, stretch);
      const Tensor<double> h = tensor_of<double>(Matrix3d(Vec3(stretch - 1, t - 1, t - 1).asDiagonal()));
      if (n != 50)
        EXPECT_EQ(is_pulled_plastic(h, cell.plastic(), limit, of_volume), n > 50) << stretch;
      else
        EXPECT_NEAR(cell.stress()(0, 0) * stretch, 2 * limit.tension, 2e-3 * limit.tension);
    }
    // Let go it stays long, but nothing pulls.
    const double stretch = 1.005 * std::exp(cell.alpha()), t = lead_bar(cell, stretch);
    const Tensor<double> h = tensor_of<double>(Matrix3d(Vec3(stretch - 1, t - 1, t - 1).asDiagonal()));
    EXPECT_TRUE(stretch > 1.5 || yielding.hardening > 0);
    EXPECT_FALSE(is_pulled_plastic(h, cell.plastic(), limit, of_volume));
  }
}

}  // namespace
}  // namespace palpate::physics::test
