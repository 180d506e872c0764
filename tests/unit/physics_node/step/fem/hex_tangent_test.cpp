// The tangent of a hexahedron: the slope of the force where nothing is cut off, positive everywhere, its blocks those of its columns.

#include "physics_node/step/fem/hex_tangent.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_stiffness.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;
using Points = Eigen::Matrix<double, 3, 8>;

Corners<One> corners(const Points& u) {
  Corners<One> w;
  for (std::size_t e = 0; e < 24; ++e)
    w[e % 3][e / 3] = u(static_cast<Eigen::Index>(e % 3), static_cast<Eigen::Index>(e / 3));
  return w;
}

struct Cell {
  HexMaterial material;
  Vec3 edge{0.0025, 0.002, 0.003};
  HexConstants<double> k = hex_constants<double>(material, edge);
  Points rest = [this] {
    Points x;
    for (int a = 0; a < 8; ++a) x.col(a) = edge.cwiseProduct(Vec3(a & 1, a >> 1 & 1, a >> 2)) - 0.5 * edge;
    return x;
  }();

  bool physical() const { return material.hourglass == HourglassKind::physical; }
  Eigen::Map<const Eigen::Matrix<double, 24, 1>> flat(const Points& p) const {
    return Eigen::Map<const Eigen::Matrix<double, 24, 1>>(p.data());
  }
  Points force(const Points& u) const {
    HexForces<One> out;
    if (physical())
      hex_forces<One, StableNeoHookean, true, false>(k, corners(u), out);
    else
      hex_forces<One, StableNeoHookean, false, false>(k, corners(u), out);
    Points f;
    for (std::size_t e = 0; e < 24; ++e) f.reshaped()[static_cast<Eigen::Index>(e)] = out.f[e % 3][e / 3];
    return f;
  }
  HexMatrix tangent(const Points& u) const {
    const HexTangent<double> at = hex_tangent_at<One>(k, corners(u));
    HexMatrix K;
    for (Eigen::Index c = 0; c < 24; ++c) {
      Points d = Points::Zero();
      d.reshaped()[c] = 1;
      Corners<One> out;
      if (physical())
        hex_tangent_times<One, true>(k, at, corners(d), out);
      else
        hex_tangent_times<One, false>(k, at, corners(d), out);
      for (std::size_t r = 0; r < 24; ++r) K(static_cast<Eigen::Index>(r), c) = out[r % 3][r / 3];
    }
    return K;
  }
  std::array<Symmetric<double>, 4> blocks(const Points& u) const {
    const HexTangent<double> at = hex_tangent_at<One>(k, corners(u));
    return physical() ? hex_tangent_blocks<One, true>(k, at) : hex_tangent_blocks<One, false>(k, at);
  }
};

std::vector<Cell> cells() {
  std::vector<Cell> all;
  for (const auto hourglass : {HourglassKind::physical, HourglassKind::isotropic})
    for (const double nu : {0.0, 0.3, 0.45, 0.49})
      all.push_back(Cell{.material = {.modulus = 10e3, .poisson_ratio = nu, .hourglass = hourglass}});
  return all;
}

class Dice {
 public:
  Points points(double size) {
    Points u;
    for (double& entry : u.reshaped()) entry = size * any_(engine_);
    return u;
  }
  Eigen::Matrix3d matrix(double size) {
    Eigen::Matrix3d m;
    for (double& entry : m.reshaped()) entry = size * any_(engine_);
    return m;
  }

 private:
  std::mt19937_64 engine_{20261123};
  std::uniform_real_distribution<double> any_{-1, 1};
};

TEST(HexTangent, AtRestIsTheStiffnessOfTheCell) {
  for (const Cell& cell : cells()) {
    const HexMatrix K = hex_stiffness(cell.material, cell.edge);
    EXPECT_LT((cell.tangent(Points::Zero()) - K).norm(), 1e-8 * K.norm());
  }
}

// Where strain is uniform and q~ is q the tangent leaves nothing out, however far from rest. |q| < mu / s there: J - 1 between
// mu (1 - 1/s) and mu (1 + 1/s) over lambda + mu.
TEST(HexTangent, IsTheSlopeOfTheForceWhereNothingIsCutOff) {
  Dice dice;
  for (const Cell& cell : cells()) {
    if (cell.k.lambda == 0) continue;
    for (int n = 0; n < 40; ++n) {
      Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + dice.matrix(0.4);
      if (f.determinant() < 0.2) continue;
      const double wanted = 1 + cell.k.mu / (cell.k.lambda + cell.k.mu);  // q = 0
      f *= std::cbrt(wanted / f.determinant());
      const Points u = f * cell.rest - cell.rest, d = dice.points(1);
      const HexMatrix K = cell.tangent(u);
      constexpr double step = 1e-7;
      const Points slope = (cell.force(u - step * d) - cell.force(u + step * d)) / (2 * step);
      const Eigen::Matrix<double, 24, 1> product = K * cell.flat(d);
      EXPECT_LT((product - cell.flat(slope)).norm(), 1e-8 * K.norm() * d.norm());
    }
  }
}

TEST(HexTangent, IsSymmetricAndNeverNegative) {
  Dice dice;
  for (const Cell& cell : cells()) {
    if (cell.material.poisson_ratio < 0.3) continue;
    double least = 1;
    for (int n = 0; n < 400; ++n) {
      const double size = n % 4 == 0 ? 2.0 : 0.5;  // folded and turned inside out, too
      const HexMatrix K =
          cell.tangent(dice.matrix(size) * cell.rest + dice.points(size * 0.3 * cell.edge.x()));
      EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
      const double low = Eigen::SelfAdjointEigenSolver<HexMatrix>(K, Eigen::EigenvaluesOnly).eigenvalues()[0];
      least = std::min(least, low / K.norm());
    }
    EXPECT_GT(least, -1e-10) << cell.material.poisson_ratio;
  }
}

TEST(HexTangent, BlocksAreThoseOfTheColumns) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  Dice dice;
  for (const Cell& cell : cells())
    for (int n = 0; n < 20; ++n) {
      const Points u = dice.points(0.4 * cell.edge.x());
      const HexMatrix K = cell.tangent(u);
      const auto blocks = cell.blocks(u);
      for (int a = 0; a < 8; ++a)
        for (std::size_t e = 0; e < 6; ++e)
          EXPECT_NEAR(blocks[static_cast<std::size_t>(a < 4 ? a : 7 - a)][e],
                      K(3 * a + row[e], 3 * a + column[e]), 1e-14 * K.norm());
    }
}

}  // namespace
}  // namespace palpate::physics
