// One hexahedron that relaxes: its stress fades as the closed form says, its force is the slope of what it holds, it knows nothing
// of turning, and it loses what it lost.

#include "physics_node/step/fem/hex_relaxation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <random>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_constants.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;
using Points = Eigen::Matrix<double, 3, 8>;
const Vec3 edge(0.0025, 0.002, 0.003);
const HexConstants<double> k =
    hex_constants<double>({.modulus = 10e3, .poisson_ratio = 0.45, .every = 0}, edge);

Points rest() {
  Points x;
  for (int a = 0; a < 8; ++a) x.col(a) = edge.cwiseProduct(Vec3(a & 1, a >> 1 & 1, a >> 2)) - 0.5 * edge;
  return x;
}

/// A cell with two terms that steps through what it is shown.
class Cell {
 public:
  struct Now {
    Points f;
    double energy, lost_before, lost_after;
  };
  Now at(const Points& u, double dt_before, double dt_after) {
    for (std::size_t n = 0; n < 2; ++n) {
      terms_[n].kept_before = std::exp(-0.5 * dt_before / times[n]);
      terms_[n].kept_after = std::exp(-0.5 * dt_after / times[n]);
    }
    Corners<One> w;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 8; ++a)
        w[i][a] = u(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
    HexForces<One> out;
    Relaxing<One, double> memory{terms_, remembered};
    hex_forces<One, StableNeoHookean, true, true>(k, w, out, memory);
    Now now{
        .f = {}, .energy = out.energy, .lost_before = memory.lost_before, .lost_after = memory.lost_after};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 8; ++a)
        now.f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) = out.f[i][a];
    return now;
  }
  static constexpr std::array<double, 2> shares{0.3, 0.4}, times{0.05, 0.8};
  std::array<Remembered<double>, 2> remembered{};

 private:
  std::array<RelaxationTerm<double>, 2> terms_{{{.share = shares[0]}, {.share = shares[1]}}};
};

class HexRelaxation : public testing::Test {
 protected:
  Points random(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    Points u;
    for (double& entry : u.reshaped()) entry = any(dice_);
    return u;
  }
  std::mt19937_64 dice_{7};
};

TEST_F(HexRelaxation, FadesAsTheSeriesSaysHoweverLongTheSteps) {
  for (const double dt : {1e-4, 0.01, 0.3}) {
    const Points u = random(1e-8);  // small: the law is linear, bending included
    Cell cell;
    const Points first = cell.at(u, 0, dt).f;
    for (int n = 1; n * dt < 3; ++n) {
      const Points f = cell.at(u, dt, dt).f;
      double left = 1;
      for (std::size_t s = 0; s < 2; ++s) left -= Cell::shares[s] * (1 - std::exp(-n * dt / Cell::times[s]));
      EXPECT_LT((f - left * first).norm(), 1e-5 * first.norm()) << n * dt;
    }
  }
}

TEST_F(HexRelaxation, PullsAtOnceAsItsLawWould) {
  const Points u = random(1e-8);
  Cell cell;
  HexForces<One> out;
  Corners<One> w;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 8; ++a)
      w[i][a] = u(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
  hex_forces<One, StableNeoHookean, true, true>(k, w, out);
  const Points f = cell.at(u, 0, 1e-3).f;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 8; ++a)
      EXPECT_NEAR(f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)), out.f[i][a],
                  1e-5 * f.norm());
}

TEST_F(HexRelaxation, ForceIsTheSlopeOfWhatItHolds) {
  for (int n = 0; n < 20; ++n) {
    Cell cell;
    cell.at(random(6e-4), 0, 0.05);
    const auto before = cell.remembered;
    const Points u = random(6e-4);
    const auto look = [&](const Points& at) {
      cell.remembered = before;
      return cell.at(at, 0, 0);
    };
    const Points f = look(u).f;
    constexpr double d = 1e-8;
    for (Eigen::Index e = 0; e < 24; ++e) {
      Points more = u, less = u;
      more.reshaped()[e] += d, less.reshaped()[e] -= d;
      EXPECT_NEAR(-(look(more).energy - look(less).energy) / (2 * d), f.reshaped()[e],
                  2e-6 * (f.norm() + 0.05));
    }
  }
}

TEST_F(HexRelaxation, KeepsMomentumAndForgetsNothingByTurning) {
  for (int n = 0; n < 20; ++n) {
    const Points first = random(6e-4), second = random(6e-4);
    Cell straight, turned;
    straight.at(first, 0, 0.02), turned.at(first, 0, 0.02);
    const Points f = straight.at(second, 0.02, 0.02).f;
    EXPECT_LT(f.rowwise().sum().norm(), 1e-12 * f.norm());
    Vec3 torque = Vec3::Zero();
    for (Eigen::Index a = 0; a < 8; ++a) torque += Vec3(rest().col(a) + second.col(a)).cross(Vec3(f.col(a)));
    EXPECT_LT(torque.norm(), 1e-12 * f.norm() * edge.norm());
    const Eigen::Matrix3d q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    EXPECT_LT((turned.at(q * (rest() + second) - rest(), 0.02, 0.02).f - q * f).norm(), 1e-10 * f.norm());
  }
}

/// Led along a path and back: the work done on it is what it holds and what it lost, by the trapezoidal rule of the leapfrog.
TEST_F(HexRelaxation, LosesTheWorkThatItDoesNotHold) {
  const Points u = random(2e-4), other = random(2e-4);
  std::array<double, 2> missing{};
  for (std::size_t fine = 0; fine < 2; ++fine) {
    const int steps = fine == 0 ? 200 : 400;
    const double dt = 0.4 / steps;
    Cell cell;
    double work = 0, lost = 0;
    Cell::Now before = cell.at(Points::Zero(), 0, dt);
    Points at = Points::Zero();
    for (int n = 1; n <= steps; ++n) {
      const double s = std::sin(6.0 * n / steps), c = std::sin(2.5 * n / steps);
      const Points next = s * u + c * other;
      const Cell::Now now = cell.at(next, dt, dt);
      EXPECT_GE(now.lost_before, 0);
      EXPECT_GE(now.lost_after, 0);
      lost += before.lost_after + now.lost_before;
      work -= 0.5 * (before.f + now.f).cwiseProduct(next - at).sum();
      before = now, at = next;
    }
    EXPECT_GT(lost, 0.05 * work);
    missing[fine] = std::abs(work - before.energy - lost) / work;
  }
  EXPECT_LT(missing[0], 1e-3);
  EXPECT_LT(missing[1], 0.3 * missing[0]) << "of second order";
}

}  // namespace
}  // namespace palpate::physics
