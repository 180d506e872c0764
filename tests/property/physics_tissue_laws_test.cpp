// What tissue of finite elements does beside its usual law: it forgets, or follows Green's strain.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

constexpr double modulus = 10e3;

/// A block that hangs from the world by its lower face and sags at once by E, later by what is left of it:
///   u(t) = u_0 E J(t),   E J(t) = 1/(1 - g) - g/(1 - g) exp(-(1 - g) t / tau),
/// since all of its stiffness fades alike. What it swings at first, a viscosity takes.
TEST(RelaxingBody, CreepsAsTheClosedFormSays) {
  for (const char* precision : {"double", "single"}) {
    Recipe recipe = solid_box(20, 20, 20, 5);
    recipe.precision = precision;
    recipe.material += "\nviscosity_Pa_s = 10";
    recipe.body += "\nfixed = [\"-z\"]";
    recipe.gravity = "[0, 0, -1]";
    const auto sag = [](World& world) {
      double sum = 0;
      for (const Index node : world.body(0).body().nodes())
        sum -= (world.body(0).position(node) - world.body(0).body().rest_position(node)).z();
      return sum;
    };
    World elastic(scene_of(recipe));
    run(elastic, 1);
    const double u_0 = sag(elastic);
    constexpr double g = 0.6, tau = 1;
    recipe.material += "\nrelaxation = [[0.6, 1]]";
    World world(scene_of(recipe));
    for (const double until : {0.3, 0.6, 1.0, 2.0, 4.0, 8.0}) {
      run(world, until - world.t());
      const double expected = 1 / (1 - g) - g / (1 - g) * std::exp(-(1 - g) * world.t() / tau);
      EXPECT_NEAR(sag(world) / u_0, expected, 0.01 * expected) << precision << " at " << until << " s";
    }
    EXPECT_LT(world.ledger().balance_error(), 0.01);
  }
}

/// What swings loses to its memory what the books say, and never gets it back; on any number of threads.
TEST(RelaxingBody, LosesWhatItsBooksSayOnAnyNumberOfThreads) {
  for (const bool damped : {false, true}) {
    Recipe recipe = solid_box(40, 40, 40, 5);
    recipe.material += "\nrelaxation = [[0.3, 0.01], [0.4, 0.2]]";
    if (damped) recipe.material += "\nviscosity_Pa_s = 1";
    recipe.body += "\nfixed = [\"-z\"]";
    recipe.gravity = "[3, 0, -9.81]";
    std::uint64_t hash = 0;
    for (const int threads : {1, 3}) {
      recipe.physics = "threads = " + std::to_string(threads);
      World world(scene_of(recipe));
      double dissipated = 0;
      for (int n = 0; n < 400; ++n) {
        world.frame({});
        const EnergyLedger ledger = world.ledger();
        EXPECT_GE(ledger.dissipated, dissipated * (1 - 1e-6)) << "frame " << n;
        dissipated = ledger.dissipated;
      }
      EXPECT_GT(dissipated, 0.1 * world.ledger().exchanged);
      EXPECT_LT(world.ledger().balance_error(), 2e-3);
      if (threads > 1) {
        EXPECT_EQ(world.body(0).hash(0), hash);
      }
      hash = world.body(0).hash(0);
    }
  }
}

TEST(RelaxingBody, IsAtRestAsOneThatForgotEverything) {
  // Turned as a whole it remembers nothing.
  Recipe recipe = solid_box(20, 20, 20, 5);
  recipe.material += "\nrelaxation = [[0.5, 0.1]]";
  World world(scene_of(recipe));
  const Eigen::Matrix3d q = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const Index node : world.body(0).body().nodes()) {
    const Vec3 x = world.body(0).body().rest_position(node);
    world.body(0).place(node, q * x - x, Vec3::Zero());
  }
  run(world, 0.5);
  for (const Index node : world.body(0).body().nodes()) EXPECT_LT(world.body(0).velocity(node).norm(), 1e-9);
}

/// A bar of Green's strain, stretched by what gravity does to it, and let go: its energy is that of the law.
TEST(GreenBody, HoldsTheEnergyOfItsLawAndKeepsItsBooks) {
  for (const char* hourglass : {"physical", "isotropic"}) {
    Recipe recipe = solid_box(40, 30, 20, 5);
    recipe.material += "\nlaw = \"green\"";
    recipe.physics = "safety = 0.1";
    recipe.body += std::string("\nhourglass = \"") + hourglass + "\"";
    World world(scene_of(recipe));
    BodyModel& body = world.body(0);
    Eigen::Matrix3d h;
    h << 0.12, -0.05, 0.1, 0.03, -0.08, 0.08, -0.12, 0.07, 0.05;
    for (const Index node : body.body().nodes())
      body.place(node, h * body.body().rest_position(node), Vec3::Zero());
    world.restart_ledger();
    const Eigen::Matrix3d e = 0.5 * (h + h.transpose() + h.transpose() * h);
    const double mu = modulus / (2 * 1.45), lambda = modulus * 0.45 / (1.45 * 0.1);
    const double volume = 0.04 * 0.03 * 0.02;
    const double expected = volume * (0.5 * lambda * e.trace() * e.trace() + mu * e.squaredNorm());
    EXPECT_NEAR(body.energies({}).elastic, expected, 1e-9 * expected);
    run(world, 0.3);
    EXPECT_LT(world.ledger().balance_error(), 2e-3);
    EXPECT_EQ(world.report().restored, 0);
    const MomentumBalance balance = body.momentum_balance();
    EXPECT_LT(balance.missing.angular.norm(), 1e-10 * std::max(balance.angular, 1e-9));
  }
}

/// St Venant-Kirchhoff gives way where the default law does not: squeezed along one axis it is softest at 1/sqrt(3).
TEST(GreenBody, GivesWayUnderStrongCompression) {
  const auto force_at = [](const char* law, double stretch) {
    Recipe recipe = solid_box(20, 20, 20, 5);
    recipe.material += law;
    World world(scene_of(recipe));
    BodyModel& body = world.body(0);
    const auto energy = [&](double l) {
      for (const Index node : body.body().nodes())
        body.place(node, Vec3(0, 0, (l - 1) * body.body().rest_position(node).z()), Vec3::Zero());
      return body.energies({}).elastic;
    };
    return (energy(stretch + 1e-5) - energy(stretch - 1e-5)) / 2e-5;
  };
  const char* green = "\nlaw = \"green\"";
  EXPECT_LT(force_at(green, 0.58), force_at(green, 0.7)) << "pushes back more at 0.58";
  EXPECT_GT(force_at(green, 0.4), force_at(green, 0.58)) << "and less at 0.4";
  EXPECT_LT(force_at("", 0.4), force_at("", 0.58)) << "the default never does";
}

}  // namespace
}  // namespace palpate::physics::test
