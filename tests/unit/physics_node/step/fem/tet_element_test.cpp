// One tetrahedron: its forces are the slope of its energy, it knows nothing of turning, is exact where strain is uniform, and
// keeps momentum. With a pressure from outside its stress is the law's under that pressure.

#include "physics_node/step/fem/tet_element.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <random>

#include "physics_node/body/tet_model.h"
#include "physics_node/material/lame.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;
using Points = Eigen::Matrix<double, 3, 4>;

class Tet : public testing::Test {
 protected:
  TetMesh mesh{.nodes = {{0, 0, 0}, {0.0021, 0.0002, 0}, {0.0003, 0.0024, 0.0001}, {0.0005, 0.0004, 0.0019}},
               .tets = {{0, 1, 2, 3}},
               .region = {0}};
  Lame lame = lame_of(10e3, 0.45);
  TetConstants<double> k{.mu = lame.mu, .lambda = lame.lambda};
  double volume = signed_volume(mesh, mesh.tets[0]);
  std::mt19937_64 dice{20261123};

  Points rest() const {
    Points x;
    for (int a = 0; a < 4; ++a) x.col(a) = mesh.nodes[static_cast<std::size_t>(a)];
    return x;
  }
  TetSlopes<double> slopes() const {
    const auto b = slopes_of(mesh, mesh.tets[0]);
    TetSlopes<double> out;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < 3; ++j) out[c][j] = b[c][static_cast<Eigen::Index>(j)];
    return out;
  }
  static std::array<Column<double>, 4> corners(const Points& u) {
    std::array<Column<double>, 4> out;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t i = 0; i < 3; ++i)
        out[a][i] = u(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
    return out;
  }
  template <bool nodal>
  TetForces<One> of(const Points& u, double mean = 0) const {
    TetForces<One> out;
    Undamped none;
    tet_forces<One, nodal, true>(k, slopes(), volume, corners(u), mean, none, out);
    return out;
  }
  Points forces(const Points& u) const {
    const auto out = of<false>(u);
    Points f;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t i = 0; i < 3; ++i)
        f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) = out.f[a][i];
    return f;
  }
  double energy(const Points& u) const { return of<false>(u).energy; }
  Points random(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    Points u;
    for (double& entry : u.reshaped()) entry = any(dice);
    return u;
  }
};

TEST_F(Tet, ForceIsTheSlopeOfTheEnergy) {
  for (int n = 0; n < 50; ++n) {
    const Points u = random(0.0006), f = forces(u);
    for (Eigen::Index e = 0; e < 12; ++e) {
      // Differences of fourth order, so that 1e-8 is within what double can tell.
      const auto at = [&](double d) {
        Points moved = u;
        moved.reshaped()[e] += d;
        return energy(moved);
      };
      constexpr double d = 4e-6;
      const double slope = (8 * (at(d) - at(-d)) - (at(2 * d) - at(-2 * d))) / (12 * d);
      EXPECT_NEAR(-slope, f.reshaped()[e], 1e-8 * f.norm());
    }
  }
}

TEST_F(Tet, KeepsMomentumAndTurnsWithTheBody) {
  for (int n = 0; n < 50; ++n) {
    const Points u = random(0.0006), f = forces(u);
    EXPECT_LT(f.rowwise().sum().norm(), 1e-12 * f.norm());
    Vec3 torque = Vec3::Zero();
    for (Eigen::Index a = 0; a < 4; ++a) torque += Vec3(rest().col(a) + u.col(a)).cross(Vec3(f.col(a)));
    EXPECT_LT(torque.norm(), 1e-12 * f.norm() * 0.0025);
    const Eigen::Matrix3d q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const Points turned = q * (rest() + u) - rest();
    EXPECT_NEAR(energy(turned), energy(u), 1e-11 * energy(u));
    EXPECT_LT((forces(turned) - q * f).norm(), 1e-10 * f.norm());
  }
}

TEST_F(Tet, HasTheStressOfItsLaw) {
  for (int n = 0; n < 50; ++n) {
    Eigen::Matrix3d h;
    for (double& entry : h.reshaped()) entry = std::uniform_real_distribution<double>(-0.4, 0.4)(dice);
    Tensor<double> t;
    for (std::size_t e = 0; e < 9; ++e)
      t[e / 3][e % 3] = h(static_cast<Eigen::Index>(e / 3), static_cast<Eigen::Index>(e % 3));
    const StableNeoHookean<One> law{lame.mu, lame.lambda};
    EXPECT_NEAR(energy(h * rest()), volume * law.psi(t), 1e-12 * volume * law.psi(t));
    EXPECT_NEAR(of<false>(h * rest()).change, (Eigen::Matrix3d::Identity() + h).determinant() - 1, 1e-12);
    const auto p = law.stress(t);
    const auto b = slopes_of(mesh, mesh.tets[0]);
    const Points f = forces(h * rest());
    for (Eigen::Index a = 1; a < 4; ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 row(p[i][0], p[i][1], p[i][2]);
        EXPECT_NEAR(f(static_cast<Eigen::Index>(i), a), -volume * row.dot(b[static_cast<std::size_t>(a - 1)]),
                    1e-12 * f.norm());
      }
  }
}

/// With its own change of volume as that of its nodes it is the plain element.
TEST_F(Tet, IsPlainUnderItsOwnVolume) {
  for (int n = 0; n < 20; ++n) {
    const Points u = random(0.0006);
    const auto plain = of<false>(u), nodal = of<true>(u, plain.change);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(nodal.f[a][i], plain.f[a][i], 1e-12 * forces(u).norm());
    EXPECT_NEAR(nodal.energy + volume * lame.lambda / 2 * plain.change * plain.change, plain.energy,
                1e-12 * plain.energy);
  }
}

TEST_F(Tet, StaysFiniteInsideOut) {
  for (const double size : {-1.0, -2.0, -10.0, 100.0}) {
    const auto out = of<false>(size * rest());
    for (const auto& corner : out.f)
      for (const double f : corner) EXPECT_TRUE(std::isfinite(f));
    EXPECT_GT(out.energy, 0);
  }
}

}  // namespace
}  // namespace palpate::physics
