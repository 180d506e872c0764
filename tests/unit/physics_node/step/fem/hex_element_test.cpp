// One hexahedron: its forces are the slope of its energy, it knows nothing of turning, is exact where strain is uniform, bends
// as a beam does, and keeps momentum.

#include "physics_node/step/fem/hex_element.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <random>

#include "physics_node/material/lame.h"
#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_constants.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;
using Points = Eigen::Matrix<double, 3, 8>;
constexpr double modulus = 10e3, poisson_ratio = 0.45;

template <template <class> class Law_, bool physical_>
struct Kind {
  template <class P>
  using Law = Law_<P>;
  static constexpr bool physical = physical_;
};

template <class K>
class Hex : public testing::Test {
 protected:
  Vec3 edge{0.0025, 0.002, 0.003};
  HexConstants<double> k =
      hex_constants<double>({.modulus = modulus,
                             .poisson_ratio = poisson_ratio,
                             .hourglass = K::physical ? HourglassKind::physical : HourglassKind::isotropic},
                            edge);
  Points rest = [this] {
    Points x;
    for (int a = 0; a < 8; ++a) x.col(a) = edge.cwiseProduct(Vec3(a & 1, a >> 1 & 1, a >> 2)) - 0.5 * edge;
    return x;
  }();
  std::mt19937_64 dice{20261124};

  HexForces<One> of(const Points& u) const {
    Corners<One> w;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 8; ++a)
        w[i][a] = u(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
    HexForces<One> out;
    hex_forces<One, K::template Law, K::physical, true>(k, w, out);
    return out;
  }
  Points forces(const Points& u) const {
    const auto out = of(u);
    Points f;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 8; ++a)
        f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) = out.f[i][a];
    return f;
  }
  double energy(const Points& u) const { return of(u).energy; }
  Points random(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    Points u;
    for (double& entry : u.reshaped()) entry = any(dice);
    return u;
  }
  double scale() const { return modulus * edge.x() * edge.y(); }  // of a force [N]
};

using Kinds = testing::Types<Kind<StableNeoHookean, true>, Kind<StableNeoHookean, false>,
                             Kind<StVenantKirchhoff, true>, Kind<StVenantKirchhoff, false>>;
TYPED_TEST_SUITE(Hex, Kinds);

TYPED_TEST(Hex, ForceIsTheSlopeOfTheEnergy) {
  for (int n = 0; n < 50; ++n) {
    const Points u = this->random(0.0006), f = this->forces(u);
    constexpr double d = 1e-8;
    for (Eigen::Index e = 0; e < 24; ++e) {
      Points more = u, less = u;
      more.reshaped()[e] += d, less.reshaped()[e] -= d;
      EXPECT_NEAR(-(this->energy(more) - this->energy(less)) / (2 * d), f.reshaped()[e],
                  1e-6 * (f.norm() + this->scale()));
    }
  }
}

TYPED_TEST(Hex, KeepsMomentumAndTurnsWithTheBody) {
  for (int n = 0; n < 50; ++n) {
    const Points u = this->random(0.0006), f = this->forces(u);
    EXPECT_LT(f.rowwise().sum().norm(), 1e-12 * f.norm());
    Vec3 torque = Vec3::Zero();
    for (Eigen::Index a = 0; a < 8; ++a) torque += Vec3(this->rest.col(a) + u.col(a)).cross(Vec3(f.col(a)));
    EXPECT_LT(torque.norm(), 1e-12 * f.norm() * this->edge.norm());
    const Eigen::Matrix3d q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const Points turned = q * (this->rest + u) - this->rest;
    EXPECT_NEAR(this->energy(turned), this->energy(u), 1e-11 * this->energy(u));
    EXPECT_LT((this->forces(turned) - q * f).norm(), 1e-10 * f.norm());
  }
}

TYPED_TEST(Hex, IsExactWhereStrainIsUniform) {
  for (int n = 0; n < 50; ++n) {
    Eigen::Matrix3d h;
    for (double& entry : h.reshaped()) entry = std::uniform_real_distribution<double>(-0.3, 0.3)(this->dice);
    Tensor<double> t;
    for (std::size_t e = 0; e < 9; ++e)
      t[e / 3][e % 3] = h(static_cast<Eigen::Index>(e / 3), static_cast<Eigen::Index>(e % 3));
    const Lame lame = lame_of(modulus, poisson_ratio);
    const typename TypeParam::template Law<One> law{lame.mu, lame.lambda};
    EXPECT_NEAR(this->energy(h * this->rest), this->edge.prod() * law.psi(t),
                1e-12 * this->edge.prod() * law.psi(t));
    // Each corner carries a quarter of the stress on the three faces that meet there.
    const auto p = law.stress(t);
    const Points f = this->forces(h * this->rest);
    for (Eigen::Index a = 0; a < 8; ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        double expected = 0;
        for (std::size_t j = 0; j < 3; ++j)
          expected -= p[i][j] * this->edge.prod() / this->edge[static_cast<Eigen::Index>(j)] / 4 *
                      ((a >> j & 1) != 0 ? 1 : -1);
        EXPECT_NEAR(f(static_cast<Eigen::Index>(i), a), expected, 1e-12 * f.norm());
      }
  }
}

TYPED_TEST(Hex, LetsNothingMoveForFree) {
  // Of its 24 ways to move only the six of a rigid body cost nothing.
  Eigen::Matrix<double, 24, 24> stiffness;
  constexpr double d = 1e-9;
  for (Eigen::Index e = 0; e < 24; ++e) {
    Points more = Points::Zero(), less = Points::Zero();
    more.reshaped()[e] = d, less.reshaped()[e] = -d;
    stiffness.col(e) = -(this->forces(more) - this->forces(less)).reshaped() / (2 * d);
  }
  EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-6 * stiffness.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>> solved(stiffness);
  const auto& values = solved.eigenvalues();
  EXPECT_LT(std::abs(values[5]), 1e-6 * values[23]);
  EXPECT_GT(values[6], 1e-3 * values[23]);
}

TEST(LeastCornerChange, IsThatOfTheVolumeWhereStrainIsUniform) {
  const Vec3 edge(0.0025, 0.002, 0.003);
  const auto k = hex_constants<double>({.modulus = modulus, .poisson_ratio = poisson_ratio}, edge);
  std::mt19937_64 dice(5);
  for (int n = 0; n < 50; ++n) {
    Eigen::Matrix3d h;
    for (double& entry : h.reshaped()) entry = std::uniform_real_distribution<double>(-0.9, 0.5)(dice);
    Corners<One> w;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vec3 u =
          h * edge.cwiseProduct(Eigen::Matrix<std::size_t, 3, 1>(a & 1, a >> 1 & 1, a >> 2).cast<double>());
      for (std::size_t i = 0; i < 3; ++i) w[i][a] = u[static_cast<Eigen::Index>(i)];
    }
    const double change = (Eigen::Matrix3d::Identity() + h).determinant() - 1;
    EXPECT_NEAR(least_corner_change<One>(k, w), std::min(change, 1.0), 1e-12) << "1 is the most it says";
  }
}

/// One corner is pushed along the cell's diagonal, beyond the plane of its three neighbours.
TEST(LeastCornerChange, SeesAFoldedCornerThatTheCentreDoesNot) {
  const Vec3 edge(0.0025, 0.002, 0.003);
  const auto k = hex_constants<double>({.modulus = modulus, .poisson_ratio = poisson_ratio}, edge);
  for (const double t : {0.2, 0.6, 0.9}) {
    Corners<One> w{};
    for (std::size_t i = 0; i < 3; ++i) w[i][7] = -t * edge[static_cast<Eigen::Index>(i)];
    // The corner itself has three edges along the axes, each a diagonal now: F = I - t (1 1 1)^T (1 1 1), J = 1 - 3 t.
    EXPECT_NEAR(least_corner_change<One>(k, w), -3 * t, 1e-12);
    Tensor<double> centre{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) centre[i][j] = w[i][7] * k.per_4h[j];
    EXPECT_GT(1 + StableNeoHookean<One>::volume_change(centre, cofactor<One>(centre)), 0.3);
  }
}

Points this_rest(const Vec3& edge) {
  Points x;
  for (int a = 0; a < 8; ++a) x.col(a) = edge.cwiseProduct(Vec3(a & 1, a >> 1 & 1, a >> 2));
  return x;
}

Corners<One> corners_of_points(const Points& u) {
  Corners<One> w;
  for (std::size_t e = 0; e < 24; ++e)
    w[e % 3][e / 3] = u(static_cast<Eigen::Index>(e % 3), static_cast<Eigen::Index>(e / 3));
  return w;
}

TEST(HexCorners, AreHeldExactlyWhereTheyHaveLessThanTheirShare) {
  const Vec3 edge(0.0025, 0.002, 0.003);
  const auto k = hex_constants<double>({.modulus = modulus, .poisson_ratio = poisson_ratio}, edge);
  std::mt19937_64 dice(11);
  int held = 0, spared = 0;
  for (int n = 0; n < 20000; ++n) {
    std::uniform_real_distribution<double> any(-1, 1);
    const double strain = 0.3 * (n % 5), size = 0.05 * (n % 7) * edge.x();
    Eigen::Matrix3d h;
    for (double& entry : h.reshaped()) entry = strain * any(dice);
    Points u;
    for (Eigen::Index a = 0; a < 8; ++a) {
      u.col(a) = h * (this_rest(edge).col(a));
      for (Eigen::Index i = 0; i < 3; ++i) u(i, a) += size * any(dice);
    }
    const Corners<One> w = corners_of_points(u);
    double least = 1e9, J = 0;
    {
      Tensor<double> f;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto m = modes_of(w[i]);
        f[i] = {m.x * k.per_4h[0], m.y * k.per_4h[1], m.z * k.per_4h[2]};
      }
      J = 1 + StableNeoHookean<One>::volume_change(f, cofactor<One>(f));
    }
    for (std::size_t a = 0; a < 8; ++a) least = std::min(least, hex_corner<One>(k, w, a).J);
    HexForces<One> whole, centre;
    Lasting lasting;
    hex_forces<One, StableNeoHookean, true, true>(k, w, whole);
    hex_centre_forces<One, StableNeoHookean, true, true>(k, w, centre, lasting);
    CornerForces<One> corner;
    corner_forces<One>(k, w, corner);
    if (least < corner_share * J - 1e-9) {
      ++held;
      EXPECT_GT(centre.fold, 0) << "a corner that folds is never passed over";
      EXPECT_GT(corner.energy, 0);
      EXPECT_EQ(whole.energy, centre.energy + corner.energy);
      EXPECT_GT(whole.stiffness, centre.stiffness);
    } else {
      if (centre.fold <= 0) ++spared;
      EXPECT_LT(corner.energy, 1e-20);
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(spared, 1000);
}

/// By differences of the force: no direction is stiffer than what the step is told.
TEST(HexCorners, AreNowhereStifferThanTheirBound) {
  const double h = 0.0025;
  const auto k = hex_constants<double>({.modulus = modulus, .poisson_ratio = poisson_ratio}, Vec3(h, h, h));
  std::mt19937_64 dice(12);
  std::uniform_real_distribution<double> any(-1, 1);
  double nearest = 0;
  for (int n = 0; n < 300; ++n) {
    Points u;
    for (double& entry : u.reshaped()) entry = 0.3 * h * any(dice);
    Eigen::Matrix<double, 24, 24> stiffness;
    CornerForces<One> at, out;
    corner_forces<One>(k, corners_of_points(u), at);
    constexpr double d = 1e-8;
    for (Eigen::Index e = 0; e < 24; ++e)
      for (const int sign : {1, -1}) {
        Points moved = u;
        moved.reshaped()[e] += sign * d;
        corner_forces<One>(k, corners_of_points(moved), out);
        for (std::size_t r = 0; r < 24; ++r) {
          double& entry = stiffness(static_cast<Eigen::Index>(r), e);
          entry = (sign == 1 ? 0 : entry) - sign * out.f[r % 3][r / 3] / (2 * d);
        }
      }
    stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>> solved(stiffness);
    // A law of the modulus C has at most V C / (2 h^2).
    const double bound = at.stiffness * h / 2, most = solved.eigenvalues().cwiseAbs().maxCoeff();
    if (at.stiffness == 0) continue;
    EXPECT_LT(most, 1.1 * bound) << "1.1: what the volume of the centre adds";
    nearest = std::max(nearest, most / bound);
  }
  EXPECT_GT(nearest, 0.3) << "a bound that is no use";
}

TEST(PhysicalHex, BendsAsABeamDoes) {
  // Pure bending of one cell about y: u_x = c x z, u_z = -c x^2 / 2 - nu c z^2 / 2, free along y. A beam of E holds E I c^2 L / 2; in plane
  // stress across y as across z the corners alone, which cannot follow the parabola, are stiffer by 1 / (1 - nu^2).
  const Vec3 edge(0.0025, 0.002, 0.003);
  const auto k =
      hex_constants<double>({.modulus = modulus, .poisson_ratio = poisson_ratio, .every = 0}, edge);
  Corners<One> w{};
  constexpr double c = 1e-3;  // [1/m]
  for (std::size_t a = 0; a < 8; ++a) {
    const double x = ((a & 1) != 0 ? 0.5 : -0.5) * edge.x(), z = (a >> 2 != 0 ? 0.5 : -0.5) * edge.z();
    w[0][a] = c * x * z;
  }
  HexForces<One> out;
  hex_forces<One, StableNeoHookean, true, true>(k, w, out);
  const double inertia = edge.y() * std::pow(edge.z(), 3) / 12;
  EXPECT_NEAR(out.energy, 0.5 * modulus / (1 - poisson_ratio * poisson_ratio) * inertia * c * c * edge.x(),
              1e-6 * out.energy);
}

}  // namespace
}  // namespace palpate::physics
