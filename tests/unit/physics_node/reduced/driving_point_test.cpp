// What a contact feels of a body: at rest all of it, swinging what the exact matrices say, and what the product's own steps do.

#include "physics_node/reduced/driving_point.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "physics_node/step/body_model.h"
#include "physics_node/step/lattice/stable_step.h"
#include "tests/support/physics/dense_solid.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

using test::DenseSolid;
using test::solid_block;

constexpr double shift = 100;  // [1/s^2]
constexpr HexMaterial tissue{.modulus = 100e3, .poisson_ratio = 0.45};
constexpr double beta = 1e-3;  // [s]

/// Nine nodes of the upper face round a place, by shares that fall with their distance.
std::vector<MassShare> patch(const Body& body, double x, double y) {
  std::vector<MassShare> found;
  double top = -1e9, sum = 0;
  for (const Index node : body.nodes()) top = std::max(top, body.rest_position(node).z());
  for (const Index node : body.nodes()) {
    const Vec3 p = body.rest_position(node);
    const double away = std::max(std::abs(p.x() - x), std::abs(p.y() - y)) / body.lattice.step.x();
    if (p.z() < top - 1e-6 || away > 1.4) continue;
    found.push_back({node, 1 / (1 + away)});
    sum += found.back().share;
  }
  for (MassShare& one : found) one.share /= sum;
  return found;
}

Eigen::Matrix3cd exact(const DenseSolid& dense, std::span<const MassShare> contact, double w) {
  Eigen::MatrixXcd A = dense.K.cast<std::complex<double>>() * std::complex<double>(1, w * beta);
  A.diagonal() -= (w * w * dense.M).cast<std::complex<double>>();
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(A.rows(), 3);
  for (const MassShare& one : contact)
    B.middleRows<3>(dense.at[static_cast<std::size_t>(one.cell)]) += one.share * Eigen::Matrix3d::Identity();
  return B.transpose() * A.partialPivLu().solve(B.cast<std::complex<double>>());
}

double error(const Eigen::Matrix3cd& found, const Eigen::Matrix3cd& truth) {
  return (found - truth).norm() / truth.norm();
}

struct Reduced {
  explicit Reduced(const Body& of, int n = 9) : answer(of, shift), modes(lowest_modes(answer, {.n = n})) {}
  LinearAnswer answer;
  VibrationModes modes;
};

/// The first n modes alone.
DrivingPoint bodys(const DrivingPoint& point, Eigen::Index n) {
  DrivingPoint first;
  first.psi = point.psi.leftCols(n);
  first.omega2 = point.omega2.head(n);
  return first;
}

/// What the others answer to a steady force.
Eigen::Matrix3d steady(const DrivingPoint& point, Eigen::Index n) {
  const Eigen::Index others = point.omega2.size() - n;
  const Eigen::Matrix3Xd psi = point.psi.rightCols(others);
  return psi * point.omega2.tail(others).cwiseInverse().asDiagonal() * psi.transpose();
}

TEST(DrivingPoint, AnswersSteadyForcesAsTheWholeBody) {
  const Body body = solid_block({.cells = 6});
  const DenseSolid dense(body, tissue);
  Reduced reduced(body);
  for (const double x : {0.0, 0.0025, 0.005}) {
    const auto contact = patch(body, x, 0.0025);
    const DrivingPoint point = driving_point(reduced.answer, reduced.modes, contact);
    EXPECT_TRUE(point.converged);
    EXPECT_LT(error(point.compliance(beta, 0), exact(dense, contact, 0)), 1e-3);
  }
}

TEST(DrivingPoint, SwingsAsTheWholeBody) {
  const Body body = solid_block({.cells = 6});
  const DenseSolid dense(body, tissue);
  Reduced reduced(body);
  const auto contact = patch(body, 0, 0);
  DrivingPoint point = driving_point(reduced.answer, reduced.modes, contact);
  const double slowest = std::sqrt(reduced.modes.omega2[0]) / (2 * std::numbers::pi);
  for (const double part : {0.25, 0.5, 0.8}) {
    const double w = part * 2 * std::numbers::pi * slowest;
    const Eigen::Matrix3cd truth = exact(dense, contact, w);
    const Eigen::Matrix3cd told = point.compliance(beta, w);
    const Eigen::Matrix3cd of_body = bodys(point, 9).compliance(beta, w);
    const Eigen::Matrix3cd at_once = of_body + steady(point, 9).cast<std::complex<double>>();
    std::printf(
        "at %.2f of the slowest mode, %.0f Hz: %.4f %% off; %.3f %% with what is left as a compliance, %.0f "
        "%% without\n",
        part, part * slowest, 100 * error(told, truth), 100 * error(at_once, truth),
        100 * error(of_body, truth));
    EXPECT_LT(error(told, truth), 1e-3);
    EXPECT_GT(error(at_once, truth), 5 * error(told, truth));
    EXPECT_GT(error(of_body, truth), 0.1);  // the lowest modes do not tell all that a small contact gives
  }
}

/// What nothing holds is carried along, and gives way besides.
TEST(DrivingPoint, OfAFreeBodySwingsAsTheWholeBody) {
  const Body body = solid_block({.cells = 6, .held = ""});
  const DenseSolid dense(body, tissue);
  Reduced reduced(body);
  const auto contact = patch(body, 0.0025, 0);
  const DrivingPoint point = driving_point(reduced.answer, reduced.modes, contact);
  for (const double f : {5.0, 20.0, 60.0}) {
    const double w = f * 2 * std::numbers::pi;
    const double off = error(point.compliance(beta, w), exact(dense, contact, w));
    std::printf("free, at %.0f Hz: %.3f %% off\n", f, 100 * off);
    EXPECT_LT(off, 2e-3);
  }
}

/// What comes to the body's modes is M-orthonormal to them and slower than nothing, on lumps and at corners too.
TEST(DrivingPoint, AddsModesLikeTheOthers) {
  const Body body = solid_block({.cells = 7}, [](int i, int, int) { return i > 3 ? 30.0 : 1.0; });
  Reduced reduced(body);
  const Eigen::VectorXd& mass = reduced.answer.mass();
  for (const double x : {-0.008, 0.0, 0.008}) {
    const DrivingPoint point = driving_point(reduced.answer, reduced.modes, patch(body, x, -0.008));
    ASSERT_EQ(point.added.cols(), 3);
    Eigen::MatrixXd all(mass.size(), 12);
    all << reduced.modes.shape, point.added;
    const Eigen::MatrixXd product = all.transpose() * (mass.asDiagonal() * all);
    EXPECT_LT((product - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_GT(point.omega2.tail(3).minCoeff(), reduced.modes.omega2[8]);
  }
}

TEST(DrivingPoint, OfWhatIsHeldGivesNothing) {
  const Body body = solid_block({.cells = 4});
  Reduced reduced(body, 3);
  std::vector<MassShare> contact;
  for (const Index node : body.nodes())
    if (body.inverse_mass[static_cast<std::size_t>(node)] == 0) contact.push_back({node, 0.04});
  ASSERT_FALSE(contact.empty());
  const DrivingPoint point = driving_point(reduced.answer, reduced.modes, contact);
  EXPECT_TRUE(point.converged);
  EXPECT_EQ(point.added.cols(), 0);
  EXPECT_EQ(point.compliance(beta, 0).norm(), 0);
}

/// A force that swings on the product's own body, in its own explicit steps.
TEST(DrivingPoint, TellsWhatTheSteppedBodyDoes) {
  test::Recipe recipe;
  recipe.lattice = "voxel";
  recipe.spacing_mm = 2.5;
  recipe.shape = test::Recipe::box(20, 20, 20);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 100\npoisson_ratio = 0.45\nviscosity_Pa_s = 100";
  recipe.body = "model = \"fem\"\nfixed = [\"-z\"]";
  const Body body = test::body_of(recipe);
  ASSERT_NEAR(damper_time(body), beta, 1e-9);
  Reduced reduced(body);
  const auto contact = patch(body, 0, 0);
  const DrivingPoint point = driving_point(reduced.answer, reduced.modes, contact);
  auto model = make_body_model(test::body_of(recipe), Precision::double_, Integrator::symplectic_euler);
  const double f = 20, w = 2 * std::numbers::pi * f, F = 1e-3;  // [Hz], [N]
  const int steps_a_turn = static_cast<int>(
      std::ceil(1 / f / (0.5 * stable_step(stiffest_mode(body), Integrator::symplectic_euler))));
  const double dt = 1 / f / steps_a_turn;
  std::vector<NodalForce> push;
  for (const MassShare& one : contact) push.push_back({one.cell, Vec3::Zero()});
  std::complex<double> answered = 0;
  constexpr int turns = 6;
  for (int n = 0; n < turns * steps_a_turn; ++n) {
    const double t = n * dt;
    for (std::size_t k = 0; k < contact.size(); ++k)
      push[k].force = Vec3(0, 0, F * contact[k].share * std::cos(w * t));
    model->advance({.dt = dt}, push);
    if (n < (turns - 1) * steps_a_turn) continue;
    double z = 0;
    for (const MassShare& one : contact) z += one.share * model->displacement(one.cell).z();
    answered += 2.0 / steps_a_turn * z * std::exp(std::complex<double>(0, -w * (t + dt)));
  }
  const std::complex<double> told = F * point.compliance(beta, w)(2, 2);
  std::printf("at 20 Hz: told over done %.4f, %.2f degrees\n", std::abs(told / answered),
              std::arg(told / answered) * 180 / std::numbers::pi);
  EXPECT_NEAR(std::abs(told / answered), 1, 0.01);
  EXPECT_NEAR(std::arg(told / answered), 0, 0.01);
}

}  // namespace
}  // namespace palpate::physics
