// The damper of one hexahedron: nothing resists a turning body, both momenta stay, what it takes is its force times the motion and
// never negative; over an implicit step it has an energy of its own.

#include "physics_node/step/fem/hex_damper.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <random>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/fem/hex_stiffness.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;
using Points = Eigen::Matrix<double, 3, 8>;
constexpr double beta = 1e-3;

class HexDamper : public testing::TestWithParam<HourglassKind> {
 protected:
  Vec3 edge{0.0025, 0.002, 0.003};
  HexMaterial material{.modulus = 10e3, .poisson_ratio = 0.45, .hourglass = GetParam()};
  HexConstants<double> k = hex_constants<double>(material, edge);
  std::mt19937_64 dice{20261125};

  static Corners<One> corners(const Points& u) {
    Corners<One> w;
    for (std::size_t e = 0; e < 24; ++e)
      w[e % 3][e / 3] = u(static_cast<Eigen::Index>(e % 3), static_cast<Eigen::Index>(e / 3));
    return w;
  }
  static Points points(const Corners<One>& f) {
    Points p;
    for (std::size_t e = 0; e < 24; ++e)
      p(static_cast<Eigen::Index>(e % 3), static_cast<Eigen::Index>(e / 3)) = f[e % 3][e / 3];
    return p;
  }
  Points rest() const {
    Points x;
    for (int a = 0; a < 8; ++a) x.col(a) = edge.cwiseProduct(Vec3(a & 1, a >> 1 & 1, a >> 2)) - 0.5 * edge;
    return x;
  }
  Points random(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    Points u;
    for (double& entry : u.reshaped()) entry = any(dice);
    return u;
  }
  template <class Memory>
  HexForces<One> of(const Points& u, Memory& memory) const {
    HexForces<One> out;
    if (material.hourglass == HourglassKind::physical)
      hex_forces<One, StableNeoHookean, true, true>(k, corners(u), out, memory);
    else
      hex_forces<One, StableNeoHookean, false, true>(k, corners(u), out, memory);
    return out;
  }
  struct Damped {
    Points force, all;
    double power = 0;
  };
  Damped at(const Points& u, const Points& v) const {
    const Corners<One> moves = corners(v);
    Damping<One, double> damping{.beta = beta, .v = &moves};
    const HexForces<One> out = of(u, damping);
    Corners<One> own;
    damping.forces(k, own);
    return {points(own), points(out.f), damping.power};
  }
};

TEST_P(HexDamper, ResistsStrainAndNothingElse) {
  for (int n = 0; n < 100; ++n) {
    const Points u = random(0.0006), v = random(0.1), x = rest() + u;
    const Damped now = at(u, v);
    // Its own part and the whole differ by what acts without it.
    Lasting lasting;
    EXPECT_LT((now.all - points(of(u, lasting).f) - now.force).norm(), 1e-12 * now.all.norm());
    EXPECT_GT(now.power, 0);
    EXPECT_NEAR(now.power, -(now.force.cwiseProduct(v)).sum(), 1e-12 * now.power);
    EXPECT_LT(now.force.rowwise().sum().norm(), 1e-12 * now.force.norm());
    Vec3 torque = Vec3::Zero();
    for (Eigen::Index a = 0; a < 8; ++a) torque += Vec3(x.col(a)).cross(Vec3(now.force.col(a)));
    EXPECT_LT(torque.norm(), 1e-12 * now.force.norm() * edge.norm());
    // A motion of the whole that is added changes nothing.
    const Vec3 drift(0.3, -0.2, 0.5), spin(20, -30, 10);
    Points rigid;
    for (Eigen::Index a = 0; a < 8; ++a) rigid.col(a) = drift + spin.cross(Vec3(x.col(a)));
    EXPECT_LT((at(u, v + rigid).force - now.force).norm(), 1e-11 * now.force.norm());
    const Eigen::Matrix3d q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    EXPECT_LT((at(q * x - rest(), q * v).force - q * now.force).norm(), 1e-11 * now.force.norm());
  }
}

TEST_P(HexDamper, LagsNearRest) {
  // Where the hourglass stiffness is a fit the damper is as if it were not; and what all modes alike have is not damped.
  HexMaterial tissue = material;
  tissue.hourglass = HourglassKind::physical, tissue.every = 0;
  const HexMatrix K = hex_stiffness(tissue, edge);
  const Points v = random(0.1);
  const Eigen::Matrix<double, 24, 1> expected = -beta * (K * v.reshaped());
  EXPECT_LT((at(Points::Zero(), v).force.reshaped() - expected).norm(), 1e-7 * expected.norm());
}

TEST_P(HexDamper, HasAnEnergyOverAStepWhoseSlopeIsItsForce) {
  for (int n = 0; n < 20; ++n) {
    const Points before = random(0.0005), u = before + random(0.0003);
    Lagging<One, double> lag{.share = 0.7, .before = hex_remembered<One>(k, corners(before))};
    const Points f = points(of(u, lag).f);
    constexpr double d = 1e-8;
    for (Eigen::Index e = 0; e < 24; ++e) {
      Points more = u, less = u;
      more.reshaped()[e] += d, less.reshaped()[e] -= d;
      EXPECT_NEAR(-(of(more, lag).energy - of(less, lag).energy) / (2 * d), f.reshaped()[e],
                  1e-6 * (f.norm() + material.modulus * edge.x() * edge.y()));
    }
    // A turn of any angle asks nothing of it.
    const Eigen::Matrix3d q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const Points turned = q * (rest() + before) - rest();
    Lasting lasting;
    EXPECT_NEAR(of(turned, lag).energy, of(turned, lasting).energy, 1e-11 * of(turned, lasting).energy);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, HexDamper,
                         testing::Values(HourglassKind::physical, HourglassKind::isotropic));

}  // namespace
}  // namespace palpate::physics
