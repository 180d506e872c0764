// The stable step of tetrahedra: just below it holds, above it does not, and the bound of single elements is one.

#include "physics_node/step/fem/tet_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/kinds.h"
#include "physics_node/material/lame.h"
#include "physics_node/step/largest_eigenvalue.h"
#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

using test::model_of;
using test::TetCube;

/// How many times as much energy there is after some steps of a body that moves a little at random.
double growth(const TetModel& model, double dt) {
  Tetrahedra<double> body(model);
  test::stir(body, 0, 1e-6);
  double start = 0, most = 0;
  for (int n = 0; n < 1500; ++n) {
    body.step({.dt = dt, .watch = true});
    const double energy = body.watch().kinetic + body.watch().elastic;
    if (n == 0) start = energy;
    most = std::max(most, energy);
  }
  return most / start;
}

class Steps : public testing::TestWithParam<std::tuple<int, bool, double>> {
 protected:
  TetModel model = model_of({.nodal = std::get<0>(GetParam()) == 1,
                             .jitter = 0.12,
                             .beta = std::get<2>(GetParam()),
                             .held = true,
                             .two_materials = std::get<1>(GetParam()),
                             .second_order = std::get<0>(GetParam()) == 2});
};

TEST_P(Steps, HoldJustBelowTheBoundAndNotWellAbove) {
  const double dt = stable_step(stiffest_mode_of_tetrahedra(model), Integrator::symplectic_euler);
  EXPECT_LT(growth(model, 0.98 * dt), 60) << "near its bound a vibration swings wide and stays";
  EXPECT_GT(growth(model, 1.05 * dt), 1e6);
}

TEST_P(Steps, AreBoundByTheFastestElement) {
  const double found = stiffest_mode_of_tetrahedra(model).omega2, bound = fastest_element(model);
  EXPECT_LE(found, bound);
  EXPECT_GT(found, 0.05 * bound) << "it is of use";
}

// 0: plain, 1: with nodal pressure, 2: of second order
INSTANTIATE_TEST_SUITE_P(Bodies, Steps,
                         testing::Combine(testing::Values(0, 1, 2), testing::Bool(),
                                          testing::Values(0, 1e-4)));

/// y = M^-1/2 K(u) M^-1/2 x of a free body as it is now.
class TangentNow {
 public:
  explicit TangentNow(Tetrahedra<double>& body)
      : body_(body), before_(body.n_nodes()), after_(body.n_nodes()) {
    for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) u_.push_back(body.displacement(n));
    body_.forces(before_);
  }
  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    double longest = 0;
    each([&](Index n, double root) { longest = std::max(longest, root * x.segment<3>(3 * n).norm()); });
    const double small = 1e-9 / longest;  // [m]
    each([&](Index n, double root) {
      body_.place(n, u_[static_cast<std::size_t>(n)] + small * root * x.segment<3>(3 * n), Vec3::Zero());
    });
    body_.forces(after_);
    each([&](Index n, double root) {
      const auto i = static_cast<std::size_t>(n);
      y.segment<3>(3 * n) = root / small * (before_[i] - after_[i]);
    });
  }

 private:
  template <class Visit>
  void each(const Visit& visit) {
    for (Index n = 0; n < static_cast<Index>(u_.size()); ++n) visit(n, std::sqrt(body_.inverse_mass(n)));
  }
  Tetrahedra<double>& body_;
  std::vector<Vec3> u_, before_, after_;
};

/// Strains of up to 0.4 in all, and nodes here and there.
void deform(Tetrahedra<double>& body, std::uint64_t seed) {
  test::Dice dice(seed);
  Eigen::Matrix3d h;
  for (double& entry : h.reshaped()) entry = 0.4 * dice();
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
    body.place(n, h * body.model().mesh.nodes[static_cast<std::size_t>(n)] + 0.0003 * dice.vector(),
               Vec3::Zero());
}

/// However it is deformed: hardly a vibration is faster than at rest by more than `stiffening` says. A ratio of two bounds is none itself; what it
/// misses, steps of 0.8 of the stable one have to spare.
TEST(StableStep, OfADeformedBodyIsShorterByAboutTheRootOfItsStiffeningAtMost) {
  for (const int kind : {0, 1, 2}) {
    const TetModel model = model_of({.nodal = kind == 1, .jitter = 0.12, .second_order = kind == 2});
    const double at_rest = stiffest_mode_of_tetrahedra(model).omega2;
    double most = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Tetrahedra<double> body(model);
      deform(body, seed);
      TangentNow tangent(body);
      const double now = largest_eigenvalue(tangent, 3 * static_cast<Eigen::Index>(body.n_nodes()));
      deform(body, seed);
      const double stiffening = body.step({.dt = 1e-9, .watch = true}).stiffening;
      EXPECT_LT(now, 1.1 * stiffening * at_rest) << kind << " " << seed;
      most = std::max(most, now / at_rest);
    }
    EXPECT_GT(most, 1.2) << "nothing became stiffer";
  }
}

/// y = M^-1/2 C(u) M^-1/2 x of what the damper resists by, of a free body as it is now.
class DamperNow {
 public:
  explicit DamperNow(Tetrahedra<double>& body) : body_(body), forces_(body.n_nodes()) {
    for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) u_.push_back(body.displacement(n));
    body_.forces(forces_);
  }
  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    for (Index n = 0; n < static_cast<Index>(u_.size()); ++n)
      body_.place(n, u_[static_cast<std::size_t>(n)], std::sqrt(body_.inverse_mass(n)) * x.segment<3>(3 * n));
    body_.step({.dt = 1});
    for (Index n = 0; n < static_cast<Index>(u_.size()); ++n) {
      const double w = body_.inverse_mass(n), root = std::sqrt(w);
      const Vec3 of_law = w * forces_[static_cast<std::size_t>(n)];
      y.segment<3>(3 * n) = x.segment<3>(3 * n) - (body_.velocity(n) - of_law) / root;
    }
  }

 private:
  Tetrahedra<double>& body_;
  std::vector<Vec3> u_, forces_;
};

/// The same of its damper, which is all that decides where z is large.
TEST(StableStep, OfADampedBodyIsShorterByAboutItsStiffeningAtMost) {
  for (const int kind : {0, 1, 2}) {
    TetModel model = model_of({.nodal = kind == 1, .jitter = 0.12, .beta = 0.1, .second_order = kind == 2});
    model.fastest_omega2 = stiffest_mode_of_tetrahedra(model).omega2;
    double most = 0;
    for (std::uint64_t seed = 0; seed <= 12; ++seed) {
      Tetrahedra<double> body(model);
      if (seed > 0) deform(body, seed);
      DamperNow damper(body);
      const double now = largest_eigenvalue(damper, 3 * static_cast<Eigen::Index>(body.n_nodes())) /
                         (model.beta * model.fastest_omega2);
      if (seed > 0)
        deform(body, seed);
      else
        for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
          body.place(n, Vec3::Zero(), Vec3::Zero());
      const double stiffening = body.step({.dt = 1e-9, .watch = true}).stiffening;
      EXPECT_LT(now, 1.1 * stiffening) << kind << " " << seed;
      most = std::max(most, now);
    }
    EXPECT_GT(most, 1.2) << "nothing became stiffer";
  }
}

/// An average of volumes is softer than each of them, and so the step is longer.
TEST(StableStep, IsLongerWithNodalPressure) {
  const double nodal = stiffest_mode_of_tetrahedra(model_of({.cells = {8, 8, 8}, .jitter = 0})).omega2;
  const double plain =
      stiffest_mode_of_tetrahedra(model_of({.cells = {8, 8, 8}, .nodal = false, .jitter = 0})).omega2;
  EXPECT_LT(nodal, 0.8 * plain);
  EXPECT_GT(plain, 0.4 * fastest_element(model_of({.cells = {8, 8, 8}, .nodal = false, .jitter = 0})));
}

TEST(StableStep, OfABodyThatIsHeldEverywhereIsInfinite) {
  TetModel model = model_of({.cells = {2, 2, 2}});
  model.held.assign(model.mesh.nodes.size(), true);
  EXPECT_TRUE(std::isinf(stable_step(stiffest_mode_of_tetrahedra(model), Integrator::symplectic_euler)));
}

}  // namespace
}  // namespace palpate::physics
