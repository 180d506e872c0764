// Where tetrahedra come to rest: what a direct solver finds under a small weight, balance of forces under a large one, and far
// fewer applications with two levels than with the diagonal.

#include "physics_node/step/fem/tet_statics.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "physics_node/step/fem/tet_stiffness.h"
#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

using test::model_of;

class Rest : public testing::TestWithParam<int> {  // 0: plain, 1: with nodal pressure, 2: of second order
 protected:
  TetModel model(std::array<int, 3> cells, double poisson_ratio = 0.45) const {
    return model_of({.cells = cells,
                     .nodal = GetParam() == 1,
                     .held = true,
                     .second_order = GetParam() == 2,
                     .poisson_ratio = poisson_ratio});
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, Rest, testing::Values(0, 1, 2));

TEST_P(Rest, UnderASmallWeightIsThatOfTheStiffness) {
  const TetModel body = model({4, 4, 6});
  const Vec3 gravity(0.001, 0, -0.002);
  const StaticRest rest = find_rest(body, {.gravity = gravity, .tolerance = 1e-8});
  ASSERT_TRUE(rest.solved) << rest.residual;
  // Held nodes: a stiffness beyond all others.
  Eigen::SparseMatrix<double> stiffness = tet_stiffness(body);
  const auto masses = masses_of(body);
  Eigen::VectorXd weight(stiffness.rows());
  const double hold = 1e9 * stiffness.diagonal().maxCoeff();
  for (Index n = 0; n < static_cast<Index>(masses.size()); ++n) {
    weight.segment<3>(3 * n) = masses[static_cast<std::size_t>(n)] * gravity;
    if (body.held[static_cast<std::size_t>(n)])
      for (Index a = 0; a < 3; ++a) stiffness.coeffRef(3 * n + a, 3 * n + a) += hold;
  }
  const Eigen::VectorXd u = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness).solve(weight);
  for (Index n = 0; n < static_cast<Index>(masses.size()); ++n)
    EXPECT_LT((rest.displacement[static_cast<std::size_t>(n)] - u.segment<3>(3 * n)).norm(),
              1e-4 * u.lpNorm<Eigen::Infinity>());
}

TEST_P(Rest, UnderALargeWeightBalancesAllForces) {
  const TetModel body = model({4, 4, 12});
  const Vec3 gravity(20, 0, -60);
  const StaticRest rest = find_rest(body, {.gravity = gravity});
  ASSERT_TRUE(rest.solved) << rest.residual;
  double sunk = 0;
  Tetrahedra<double> there(body);
  for (Index n = 0; n < static_cast<Index>(rest.displacement.size()); ++n) {
    there.place(n, rest.displacement[static_cast<std::size_t>(n)], Vec3::Zero());
    sunk = std::max(sunk, rest.displacement[static_cast<std::size_t>(n)].norm());
  }
  EXPECT_GT(sunk, 0.004) << "far beyond what is linear";
  std::vector<Vec3> f(there.n_nodes());
  there.forces(f);
  double left = 0, weights = 0;
  for (Index n = 0; n < static_cast<Index>(f.size()); ++n) {
    if (there.inverse_mass(n) == 0) continue;
    const Vec3 weight = gravity / there.inverse_mass(n);
    left += (f[static_cast<std::size_t>(n)] + weight).squaredNorm();
    weights += weight.squaredNorm();
  }
  EXPECT_LT(std::sqrt(left / weights), 2e-6);
}

TEST_P(Rest, TakesFewApplicationsWithTwoLevels) {
  for (const double nu : {0.45, 0.49}) {
    const TetModel body = model({12, 12, 12}, nu);
    StaticLoad load{.gravity = Vec3(0, 0, -0.01)};
    const StaticRest two = find_rest(body, load);
    load.preconditioner = TetPreconditioner::diagonal;
    const StaticRest one = find_rest(body, load);
    EXPECT_TRUE(two.solved && one.solved);
    EXPECT_LT(two.applications, 0.5 * one.applications);
    RecordProperty(nu < 0.47 ? "applications_45" : "applications_49",
                   std::to_string(two.applications) + " " + std::to_string(one.applications));
  }
}

TEST(RestOfTetrahedra, OfABodyWithoutWeightIsWhereItIs) {
  const StaticRest rest = find_rest(model_of({.held = true}), {});
  EXPECT_TRUE(rest.solved);
  EXPECT_EQ(rest.applications, 0);
}

}  // namespace
}  // namespace palpate::physics
