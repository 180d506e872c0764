// The step of a body of hexahedra against the eigenvalues of its whole matrix, and against a step that is just too long.

#include "physics_node/step/lattice/hex_spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <map>

#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/fem/hex_stiffness.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

test::Recipe solid(const std::string& shape, const std::string& further) {
  test::Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = shape;
  recipe.spacing_mm = 2.5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.body = "model = \"fem\"\n" + further;
  return recipe;
}

/// Largest w^2 of K x = w^2 M x, assembled cell by cell from the element's matrix.
double largest_of_all(const Body& body) {
  const HexMatrix cell_matrix = hex_stiffness({.modulus = body.solid->modulus,
                                               .poisson_ratio = body.solid->poisson_ratio,
                                               .hourglass = body.solid->hourglass},
                                              body.lattice.step);
  std::map<Index, Eigen::Index> number;
  for (const Index node : body.nodes())
    if (body.inverse_mass[static_cast<std::size_t>(node)] > 0) {
      const auto next = static_cast<Eigen::Index>(number.size());
      number[node] = next;
    }
  const auto n = 3 * static_cast<Eigen::Index>(number.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (const Index cell : body.nodes()) {
    const double stiffness = static_cast<double>(body.solid->stiffness[static_cast<std::size_t>(cell)]);
    if (stiffness <= 0) continue;
    const Vec3i at = body.lattice.grid_of(cell);
    std::array<Index, 8> corner;
    for (int a = 0; a < 8; ++a)
      corner[static_cast<std::size_t>(a)] = body.lattice.cell_of(at + Vec3i(a & 1, a >> 1 & 1, a >> 2));
    for (Eigen::Index p = 0; p < 24; ++p)
      for (Eigen::Index q = 0; q < 24; ++q) {
        const auto row = number.find(corner[static_cast<std::size_t>(p / 3)]);
        const auto column = number.find(corner[static_cast<std::size_t>(q / 3)]);
        if (row == number.end() || column == number.end()) continue;
        const double roots = std::sqrt(body.inverse_mass[static_cast<std::size_t>(row->first)] *
                                       body.inverse_mass[static_cast<std::size_t>(column->first)]);
        K(3 * row->second + p % 3, 3 * column->second + q % 3) += stiffness * roots * cell_matrix(p, q);
      }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

TEST(HexSpectrum, IsThatOfTheWholeMatrix) {
  const std::string hard =
      "regions = [{ material = \"hard\", center_mm = [2.5, 0, 0], radius_mm = 4 }]\n"
      "[material.hard]\ndensity_kg_per_m3 = 2000\nmodulus_kPa = 500\npoisson_ratio = 0.45";
  for (const auto& recipe :
       {solid(test::Recipe::box(15, 12.5, 10), ""), solid(test::Recipe::box(2.5, 2.5, 2.5), ""),
        solid(test::Recipe::box(15, 12.5, 10), "hourglass = \"isotropic\"\nfixed = [\"-z\"]"),
        solid(test::Recipe::sphere(7), ""), solid(test::Recipe::box(15, 12.5, 10), hard)}) {
    const Body body = test::body_of(recipe);
    const double all = largest_of_all(body), found = stiffest_mode_of_hexahedra(body).omega2;
    EXPECT_GE(found, 0.99 * all) << recipe.shape << recipe.body;
    EXPECT_LE(found, 1.03 * all) << recipe.shape << recipe.body;
  }
}

TEST(HexSpectrum, IsThatOfOneCellAloneWhereThereIsOne) {
  const Body body = test::body_of(solid(test::Recipe::box(2.5, 2.5, 2.5), ""));
  const HexMatrix cell = hex_stiffness({.modulus = 10e3, .poisson_ratio = 0.45}, Vec3::Constant(2.5e-3));
  const double of_cell =
      Eigen::SelfAdjointEigenSolver<HexMatrix>(cell).eigenvalues()[23] * 8 / 1000 / std::pow(2.5e-3, 3);
  EXPECT_NEAR(stiffest_mode_of_hexahedra(body).omega2 / of_cell, 1, 1e-6);
  EXPECT_EQ(stiffest_mode_of_hexahedra(body).gamma, 0);
}

/// Small vibrations stay small at 0.99 of the step, and grow without end at 1.03 of it.
TEST(HexSpectrum, BoundsTheStepFromWhichVibrationsGrow) {
  const test::Recipe recipe = solid(test::Recipe::box(20, 20, 20), "");
  const double bound =
      stable_step(stiffest_mode_of_hexahedra(test::body_of(recipe)), Integrator::symplectic_euler);
  EXPECT_NEAR(bound, 0.359e-3, 0.01e-3);
  for (const double share : {0.99, 1.03}) {
    const auto body = make_body_model(test::body_of(recipe), Precision::double_);
    test::Dice dice(3);
    for (const Index node : body->body().nodes()) body->place(node, Vec3::Zero(), dice.within(1e-6));
    for (int n = 0; n < 3000; ++n) body->advance({.dt = share * bound}, {});
    double fastest = 0;
    for (const Index node : body->body().nodes()) fastest = std::max(fastest, body->velocity(node).norm());
    if (share < 1)
      EXPECT_TRUE(body->is_finite() && fastest < 1e-4) << fastest;
    else
      EXPECT_FALSE(body->is_finite() && fastest < 1e-3) << "and it is no looser than it must be: " << fastest;
  }
}

}  // namespace
}  // namespace palpate::physics
