// The damper of tetrahedra: what its forces take is the power that is booked, turning is free, momentum stays, and a small vibration
// dies at the rate of the closed form.

#include "physics_node/step/fem/tet_damper.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "physics_node/step/fem/tet_stiffness.h"
#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

using test::expect_momenta_kept;
using test::model_of;
using test::stir;
using test::TetCube;

struct Damped : testing::TestWithParam<int> {
  static TetCube cube(TetCube of) {
    of.nodal = GetParam() == 1;
    of.second_order = GetParam() == 2;
    return of;
  }
};
std::string element_of(const testing::TestParamInfo<int>& info) {
  const std::array<const char*, 3> names{"Plain", "Nodal", "SecondOrder"};
  return names[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(All, Damped, testing::Values(0, 1, 2), element_of);

/// Forces of the damper on all nodes, from what a step of a second makes of the velocities; leaves the body as it was [N].
std::vector<Vec3> damper_forces(Tetrahedra<double>& body) {
  std::vector<Vec3> f(body.n_nodes()), u, v;
  body.forces(f);
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
    u.push_back(body.displacement(n)), v.push_back(body.velocity(n));
  body.step({.dt = 1});
  for (std::size_t n = 0; n < f.size(); ++n) {
    const auto node = static_cast<Index>(n);
    f[n] = (body.velocity(node) - v[n]) / body.inverse_mass(node) - f[n];
    body.place(node, u[n], v[n]);
  }
  return f;
}

TEST_P(Damped, ItsForcesTakeThePowerThatIsBooked) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Tetrahedra<double> body(model_of(cube({.beta = 0.5, .two_materials = true})));
    stir(body, 0.0006, 0.3, seed);
    const auto f = damper_forces(body);
    double power = 0;
    for (std::size_t n = 0; n < f.size(); ++n) power -= f[n].dot(body.velocity(static_cast<Index>(n)));
    EXPECT_GT(power, 0);
    EXPECT_NEAR(body.damper_power(), power, 1e-11 * power);
  }
}

TEST_P(Damped, NothingResistsABodyThatTurns) {
  Tetrahedra<double> body(model_of(cube({.beta = 0.5, .two_materials = true})));
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 spin(20, -30, 10), drift(0.3, -0.2, 0.5);
  double force = 0, scale = 0;
  for (const bool sheared : {true, false}) {  // the one for scale
    for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) {
      const Vec3 x = body.model().mesh.nodes[static_cast<std::size_t>(n)];
      const Vec3 v = spin.cross(Vec3(R * x));
      body.place(n, R * x - x, drift + (sheared ? Vec3(v.x(), 0, 0) : v));
    }
    double& most = sheared ? scale : force;
    for (const Vec3& f : damper_forces(body)) most = std::max(most, f.norm());
  }
  EXPECT_GT(scale, 0);
  EXPECT_LT(force, 1e-12 * scale);
  EXPECT_LT(body.damper_power(), 1e-20);
}

TEST_P(Damped, KeepsBothMomenta) {
  Tetrahedra<double> body(model_of(cube({.beta = 2e-4, .two_materials = true})));
  stir(body, 0.0004, 0.2);
  expect_momenta_kept(body, [&] {
    for (int n = 0; n < 300; ++n) body.step({.dt = 2e-6, .struck = n % 3 == 0});
  });
}

/// E(t) = E(0) exp(-beta omega^2 t) of the lowest mode, over whole periods; of the stiffness at rest, nearly incompressible.
TEST_P(Damped, AModeDiesAtTheClosedFormRate) {
  TetModel model = model_of(cube({.cells = {2, 2, 2}, .held = true, .poisson_ratio = 0.49}));
  const auto masses = masses_of(model);
  std::vector<Index> free;
  for (std::size_t n = 0; n < masses.size(); ++n)
    if (!model.held[n]) free.push_back(static_cast<Index>(n));
  const Eigen::MatrixXd K = tet_stiffness(model).toDense();
  const auto size = 3 * static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd scaled(size, size);
  const auto mass = [&](Eigen::Index i) {
    return masses[static_cast<std::size_t>(free[static_cast<std::size_t>(i / 3)])];
  };
  const auto row = [&](Eigen::Index i) { return 3 * free[static_cast<std::size_t>(i / 3)] + i % 3; };
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j) scaled(i, j) = K(row(i), row(j)) / std::sqrt(mass(i) * mass(j));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(scaled);
  const double omega = std::sqrt(modes.eigenvalues()[0]), fastest = std::sqrt(modes.eigenvalues()[size - 1]);
  model.beta = 0.04 / omega;
  Tetrahedra<double> body(model);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto at = 3 * static_cast<Eigen::Index>(i);
    body.place(free[i], 1e-8 / std::sqrt(mass(at)) * modes.eigenvectors().col(0).segment<3>(at) * 1e-3,
               Vec3::Zero());
  }
  const double start = body.energies({}).elastic, z = 0.5 * model.beta * fastest;
  const double period = 2 * std::acos(-1.0) / (omega * std::sqrt(1 - 0.02 * 0.02));
  const auto steps = static_cast<int>(std::ceil(4 * period * fastest * (std::sqrt(1 + z * z) + z) / 0.1));
  for (int n = 0; n < steps; ++n) body.step({.dt = 4 * period / steps});
  const Energies end = body.energies({});
  const double rate = std::log(start / (end.elastic + end.kinetic)) / (4 * period);
  EXPECT_NEAR(rate, model.beta * omega * omega, 0.01 * model.beta * omega * omega);
}

/// By power or by forces: what there is and what was lost are what there was, and nothing comes back.
TEST_P(Damped, BooksTheSameWhetherStruckOrNot) {
  std::array<double, 2> lost{};
  for (const bool struck : {false, true}) {
    Tetrahedra<double> body(model_of(cube({.beta = 1e-4, .held = true})));
    stir(body, 1e-6, 0);
    const double start = body.energies({}).elastic;
    double before = 0;
    for (int n = 0; n < 500; ++n) {
      body.step({.dt = 2e-6, .watch = true, .struck = struck});
      const double there = body.watch().between + body.watch().elastic, viscous = body.losses().viscous;
      EXPECT_NEAR(there + viscous + body.losses().numerical, start, (struck ? 1e-6 : 2e-3) * start);
      EXPECT_GE(viscous, before);
      before = viscous;
    }
    lost[struck ? 1 : 0] = before / start;
  }
  EXPECT_GT(lost[1], 0.5);
  EXPECT_NEAR(lost[0], lost[1], 2e-3);
}

TEST(DampedStiffening, IsThatOfTheLawAndNoLessThanTheRatioOfTheStableSteps) {
  EXPECT_DOUBLE_EQ(damped_stiffening(3, 7, 0), 3);
  EXPECT_DOUBLE_EQ(damped_stiffening(1, 1, 2), 1);
  EXPECT_NEAR(damped_stiffening(3, 7, 1e4), 7, 1e-6);
  EXPECT_DOUBLE_EQ(damped_stiffening(3, 2.5, 1e4), 3);
}

}  // namespace
}  // namespace palpate::physics
