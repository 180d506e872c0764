// The slowest modes of a body: those of its dense matrices, all of them where some are alike, rigid motions where nothing holds it, and
// the same bits on any number of threads.

#include "physics_node/reduced/lowest_modes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/physics/dense_solid.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

using test::DenseSolid;
using test::solid_block;

constexpr double shift = 100;  // [1/s^2]
constexpr HexMaterial tissue{.modulus = 100e3, .poisson_ratio = 0.45};

Eigen::VectorXd exact(const Body& body) {
  const DenseSolid dense(body, tissue);
  const Eigen::VectorXd root = dense.M.cwiseSqrt().cwiseInverse();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(root.asDiagonal() * dense.K * root.asDiagonal(),
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues();
}

TEST(LowestModes, AreThoseOfTheDenseMatrices) {
  for (const bool lump : {false, true}) {
    const Body body = solid_block({.cells = 6}, [&](int i, int j, int k) {
      if (i > 3 && k > 3) return 0.0;  // a step in it
      return lump && j > 3 ? 20.0 : 1.0;
    });
    LinearAnswer answer(body, shift);
    const VibrationModes modes = lowest_modes(answer);
    const Eigen::VectorXd truth = exact(body).head(9);
    EXPECT_TRUE(modes.converged);
    std::printf("%d solves, residual %.1e; first %.2f Hz, ninth %.2f Hz\n", modes.solves, modes.residual,
                std::sqrt(modes.omega2[0]) / (2 * std::numbers::pi),
                std::sqrt(modes.omega2[8]) / (2 * std::numbers::pi));
    for (Eigen::Index i = 0; i < 9; ++i) EXPECT_NEAR(modes.omega2[i] / truth[i], 1, 1e-4) << "mode " << i;
  }
}

/// A square block bends alike in two directions: both are found.
TEST(LowestModes, FindsWhatThereIsTwice) {
  const Body body = solid_block({.cells = 6});
  LinearAnswer answer(body, shift);
  const VibrationModes modes = lowest_modes(answer, {.n = 2});
  EXPECT_TRUE(modes.converged);
  EXPECT_NEAR(modes.omega2[1] / modes.omega2[0], 1, 1e-4);
  EXPECT_NEAR(modes.omega2[0] / exact(body)[0], 1, 1e-4);
}

TEST(LowestModes, AreOrthonormalInTheMasses) {
  const Body body = solid_block({.cells = 5});
  LinearAnswer answer(body, shift);
  const VibrationModes modes = lowest_modes(answer);
  const Eigen::VectorXd& mass = answer.mass();
  const Eigen::MatrixXd product = modes.shape.transpose() * (mass.asDiagonal() * modes.shape);
  EXPECT_LT((product - Eigen::MatrixXd::Identity(9, 9)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LowestModes, OfAFreeBodyAreItsRigidMotions) {
  const Body body = solid_block({.cells = 5, .held = ""});
  LinearAnswer answer(body, shift);
  const VibrationModes modes = lowest_modes(answer);
  EXPECT_TRUE(modes.converged);
  ASSERT_EQ(modes.omega2.size(), 9);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_LT(std::abs(modes.omega2[i]), 1e-4 * modes.omega2[6]) << i;
  EXPECT_NEAR(modes.omega2[6] / exact(body)[6], 1, 1e-4);
}

/// One cell whose lower face is held has twelve ways to move, and no more.
TEST(LowestModes, AreAsManyAsThereAreWaysToMove) {
  const Body body = solid_block({.cells = 1});
  LinearAnswer answer(body, shift);
  const VibrationModes modes = lowest_modes(answer, {.n = 20});
  EXPECT_TRUE(modes.converged);
  EXPECT_EQ(modes.omega2.size(), 12);
}

TEST(LowestModes, SayWhenTheyAreNotFoundYet) {
  const Body body = solid_block({.cells = 6});
  LinearAnswer answer(body, shift);
  const VibrationModes modes = lowest_modes(answer, {.n = 9, .tolerance = 1e-3, .most_solves = 12});
  EXPECT_FALSE(modes.converged);
  EXPECT_GT(modes.residual, 1e-3);
  EXPECT_EQ(modes.solves, 12);
}

TEST(LowestModes, HasTheSameBitsOnAnyNumberOfThreads) {
  const Body body = solid_block({.cells = 9});
  Eigen::MatrixXd first;
  for (const int threads : {1, 2, 3, 8}) {
    Team team(threads);
    const Crew crew{&team, threads};
    LinearAnswer answer(body, shift, crew);
    const VibrationModes modes = lowest_modes(answer, {.n = 5}, crew);
    if (threads == 1) first = modes.shape;
    EXPECT_TRUE(first == modes.shape) << threads;
  }
}

}  // namespace
}  // namespace palpate::physics
