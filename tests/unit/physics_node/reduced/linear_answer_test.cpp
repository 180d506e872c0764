// The answer of a body to small forces is that of its dense matrices, and what is held does not answer.

#include "physics_node/reduced/linear_answer.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/support/physics/dense_solid.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

TEST(LinearAnswer, IsThatOfTheDenseMatrices) {
  for (const std::string held : {"fixed = [\"-z\"]", ""}) {
    const Body body = test::solid_block({.cells = 6, .held = held});
    const double shift = 1000;
    const test::DenseSolid dense(body, {.modulus = 100e3, .poisson_ratio = 0.45});
    LinearAnswer answer(body, shift);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(3 * answer.n_rows()), x(b.size());
    Eigen::VectorXd own = Eigen::VectorXd::Zero(dense.M.size());
    test::Dice dice(3);
    for (const Index node : body.nodes()) {
      const Vec3 f = dice.within(1e-6);
      const Eigen::Index row = answer.row_of(node), at = dense.at[static_cast<std::size_t>(node)];
      b.segment<3>(3 * row) = f;
      if (at >= 0) own.segment<3>(at) = f;
    }
    EXPECT_TRUE(answer.solve(b, x, 1e-6, {}));
    Eigen::MatrixXd A = dense.K;
    A.diagonal() += shift * dense.M;
    const Eigen::VectorXd truth = A.llt().solve(own);
    double off = 0;
    for (const Index node : body.nodes()) {
      const Eigen::Index at = dense.at[static_cast<std::size_t>(node)];
      const Vec3 found = x.segment<3>(3 * answer.row_of(node));
      off += at >= 0 ? (found - truth.segment<3>(at)).squaredNorm() : 1e6 * found.squaredNorm();
    }
    EXPECT_LT(std::sqrt(off), 1e-4 * truth.norm()) << held;
  }
}

TEST(LinearAnswer, OfNoForceIsNone) {
  const Body body = test::solid_block({.cells = 4});
  LinearAnswer answer(body, 100);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(3 * answer.n_rows());
  EXPECT_TRUE(answer.solve(Eigen::VectorXd::Zero(x.size()), x, 1e-6, {}));
  EXPECT_EQ(x.norm(), 0);
}

}  // namespace
}  // namespace palpate::physics
