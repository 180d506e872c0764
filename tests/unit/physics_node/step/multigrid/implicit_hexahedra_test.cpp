// Steps of backward_euler and equilibria of finite elements: their laws, their books, their order, their bits.

#include "physics_node/step/multigrid/implicit_hexahedra.h"

#include <gtest/gtest.h>

#include <random>

#include "common/error/error.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/multigrid/equilibrium.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

const Vec3 gravity(0, 0, -9.81);

test::Recipe tissue(const std::string& shape, const std::string& material, const std::string& body) {
  test::Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = shape;
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\n" + material;
  recipe.body = "model = \"fem\"\n" + body;
  return recipe;
}

std::unique_ptr<BodyModel> implicit(const test::Recipe& recipe, Precision precision = Precision::double_) {
  return make_body_model(test::body_of(recipe), precision, Integrator::backward_euler);
}

/// Mean displacement of the masses that are highest at rest.
Vec3 top(const BodyModel& body) {
  double highest = -1e9, n = 0;
  Vec3 sum = Vec3::Zero();
  for (const Index node : body.body().nodes())
    highest = std::max(highest, body.body().rest_position(node).z());
  for (const Index node : body.body().nodes())
    if (body.body().rest_position(node).z() > highest - 1e-6) sum += body.displacement(node), n += 1;
  return sum / n;
}

// A column that does not spread: sigma = - rho g (H - z), u(H) = - rho g H^2 / (2 E), which nodes of linear cells meet exactly.
TEST(Equilibrium, AColumnSinksByItsWeight) {
  const Body body = test::body_of(
      tissue(test::Recipe::box(20, 20, 60), "modulus_kPa = 2000\npoisson_ratio = 0", "fixed = [\"-z\"]"));
  const Equilibrium found = equilibrium(body, gravity);
  EXPECT_TRUE(found.report.converged);
  const double sunk = 1000 * 9.81 * 0.06 * 0.06 / (2 * 2e6);
  double lowest = 0;
  for (const Vec3& d : found.displacement) lowest = std::min(lowest, d.z());
  EXPECT_NEAR(lowest, -sunk, 1e-3 * sunk);
}

// What Newton finds is what damped steps come to.
TEST(Equilibrium, IsWhereDampedStepsEnd) {
  test::Recipe recipe =
      tissue(test::Recipe::box(40, 30, 30), "modulus_kPa = 3\npoisson_ratio = 0.45", "fixed = [\"-x\"]");
  const Equilibrium found = equilibrium(test::body_of(recipe), gravity);
  ASSERT_TRUE(found.report.converged);
  EXPECT_LE(found.report.cycles, 60);
  recipe.material += "\nviscosity_Pa_s = 150";
  const Body stepped = test::body_of(recipe);
  auto body = make_body_model(stepped, Precision::double_, Integrator::symplectic_euler);
  for (int n = 0; n < 8000; ++n) body->advance({.dt = 1.5e-4, .gravity = gravity}, {});
  double far = 0, sag = 0;
  for (std::size_t n = 0; n < found.displacement.size(); ++n) {
    far = std::max(far, (found.displacement[n] - body->displacement(stepped.nodes()[n])).norm());
    sag = std::max(sag, found.displacement[n].norm());
  }
  EXPECT_GT(sag, 0.005);  // far from linear
  EXPECT_LT(far, 2e-3 * sag);
}

TEST(ImplicitHexahedra, KeepsTheBooksOfAFallAndASwing) {
  for (const char* further : {"", "\nviscosity_Pa_s = 20"}) {
    auto body =
        implicit(tissue(test::Recipe::box(40, 20, 20),
                        "modulus_kPa = 10\npoisson_ratio = 0.45" + std::string(further), "fixed = [\"-x\"]"));
    const Energies start = body->energies(gravity);
    for (int n = 0; n < 20; ++n) EXPECT_TRUE(body->advance({.dt = 0.005, .gravity = gravity}, {}).solved);
    const Energies end = body->energies(gravity);
    const Losses lost = body->losses();
    const double fallen = start.gravitational - end.gravitational;
    EXPECT_GT(fallen, 0);
    // What is booked is what each step took; a residual of a thousandth of the forces does work that is not.
    EXPECT_NEAR(fallen, end.kinetic + end.elastic + lost.viscous + lost.numerical, 2e-4 * fallen);
    EXPECT_GT(lost.numerical, 0);
    EXPECT_EQ(lost.viscous > 0, *further != 0);
  }
}

// A step begins where the body would coast to. Where that crushes cells or turns them inside out, a search may give up, or find
// another minimum; it may not end with more energy than there was.
TEST(ImplicitHexahedra, TakesNoEnergyFromASearchThatGoesAstray) {
  int given_up = 0;
  for (const Precision precision : {Precision::single_, Precision::double_})
    for (int n = 0; n < 24; ++n) {
      auto body = implicit(
          tissue(test::Recipe::box(40, 40, 40), "modulus_kPa = 100\npoisson_ratio = 0.47", ""), precision);
      std::mt19937 random(static_cast<unsigned>(n));
      std::uniform_real_distribution<double> cells(-1.5, 1.5);
      constexpr double dt = 0.02, cell = 5e-3;
      for (const Index node : body->body().nodes()) {
        const Vec3 to_middle = -body->body().rest_position(node);
        const Vec3 anywhere(cells(random), cells(random), cells(random));
        body->place(node, Vec3::Zero(), ((1 + 0.2 * n) * to_middle + n % 4 * cell * anywhere) / dt);
      }
      const Energies before = body->energies(Vec3::Zero());
      for (int step = 0; step < 3; ++step) given_up += body->advance({.dt = dt}, {}).solved ? 0 : 1;
      const Energies after = body->energies(Vec3::Zero());
      EXPECT_LE(after.kinetic + after.elastic, 1.001 * (before.kinetic + before.elastic)) << n;
    }
  EXPECT_GT(given_up, 2) << "or nothing was tried";
}

// A force on a body that nothing holds: momentum to the tolerance of the steps, in double and float.
TEST(ImplicitHexahedra, AForceGivesItsImpulse) {
  for (const Precision precision : {Precision::double_, Precision::single_}) {
    auto body = implicit(tissue(test::Recipe::box(30, 30, 30), "modulus_kPa = 30\npoisson_ratio = 0.45", ""),
                         precision);
    const std::vector<NodalForce> push{{body->body().nodes()[3], Vec3(0.01, 0.02, -0.01)}};
    double work = 0;
    for (int n = 0; n < 10; ++n) work += body->advance({.dt = 0.01}, push).work;
    EXPECT_LT((body->momenta().linear - 0.1 * push[0].force).norm(), 2e-3 * 0.1 * push[0].force.norm());
    EXPECT_GT(work, 0);
  }
}

// The swing of a block, against explicit steps: half the step, half the error.
TEST(ImplicitHexahedra, IsOfTheFirstOrder) {
  const test::Recipe recipe =
      tissue(test::Recipe::box(30, 20, 20), "modulus_kPa = 20\npoisson_ratio = 0.4", "fixed = [\"-z\"]");
  constexpr double time = 0.02;
  const auto ended = [&](Integrator integrator, int steps) {
    auto body = make_body_model(test::body_of(recipe), Precision::double_, integrator);
    for (int n = 0; n < steps; ++n) body->advance({.dt = time / steps, .gravity = Vec3(9.81, 0, 0)}, {});
    return top(*body).x();
  };
  const double exact = ended(Integrator::symplectic_euler, 4000);
  const double coarse = ended(Integrator::backward_euler, 100) - exact,
               fine = ended(Integrator::backward_euler, 200) - exact;
  EXPECT_NEAR(coarse / fine, 2, 0.2);
  EXPECT_LT(std::abs(fine), 0.05 * std::abs(exact));
}

// Stiff and slender: the forces of its weight are the last digits of what a place times a stiffness has in float.
TEST(ImplicitHexahedra, SolvesStiffTissueInFloat) {
  auto body = implicit(
      tissue(test::Recipe::box(200, 20, 20), "modulus_kPa = 1000\npoisson_ratio = 0.45", "fixed = [\"-x\"]"),
      Precision::single_);
  for (int n = 0; n < 40; ++n) EXPECT_TRUE(body->advance({.dt = 0.01, .gravity = gravity}, {}).solved) << n;
}

TEST(ImplicitHexahedra, StaysWhereItIsBalancedAtStepsOfAnyLength) {
  const test::Recipe recipe =
      tissue(test::Recipe::box(40, 30, 30), "modulus_kPa = 5\npoisson_ratio = 0.45", "fixed = [\"-z\"]");
  auto body = implicit(recipe);
  const Equilibrium found = equilibrium(body->body(), gravity);
  for (std::size_t n = 0; n < found.displacement.size(); ++n)
    body->place(body->body().nodes()[n], found.displacement[n], Vec3::Zero());
  const Vec3 before = top(*body);
  for (const double dt : {0.001, 0.02, 0.5}) {
    for (int n = 0; n < 3; ++n) body->advance({.dt = dt, .gravity = gravity}, {});
    EXPECT_LT((top(*body) - before).norm(), 2e-3 * before.norm()) << dt;
  }
}

// Begins in balance, is disturbed, and is in balance again when it is reset; without `start` it falls into its weight.
TEST(StartOfABody, IsItsBalanceWhereItAsksForIt) {
  for (const char* integrator : {"symplectic_euler", "backward_euler"}) {
    const auto sunk = [&](const char* start, bool again) {
      test::Recipe recipe = tissue(test::Recipe::box(40, 30, 30), "modulus_kPa = 5\npoisson_ratio = 0.45",
                                   "fixed = [\"-z\"]\nstart = \"" + std::string(start) + "\"");
      recipe.gravity = "[0, 0, -9.81]";
      recipe.physics = "integrator = \"" + std::string(integrator) + "\"";
      World world(test::scene_of(recipe));
      EXPECT_TRUE(world.remarks().empty());
      for (int n = 0; n < 20; ++n) world.frame({});
      EXPECT_LT(world.ledger().balance_error(), 1e-2);
      if (again) {
        world.body(0).kick(std::vector<NodalForce>{{world.body(0).body().nodes().back(), Vec3(1, 0, 0)}},
                           1e-3);
        world.reset();
        for (int n = 0; n < 20; ++n) world.frame({});
      }
      return std::pair(top(world.body(0)).z(), world.body(0).energies(gravity).kinetic);
    };
    const auto [still, energy] = sunk("balanced", false);
    EXPECT_LT(still, -5e-4);
    EXPECT_LT(energy, 1e-12);
    const auto [again, energy_again] = sunk("balanced", true);
    EXPECT_NEAR(again, still, 1e-6);
    EXPECT_LT(energy_again, 1e-12);
    EXPECT_GT(sunk("rest", false).second, 1e-6);
  }
}

TEST(StartOfABody, NeedsSomethingThatHoldsIt) {
  test::Recipe recipe = tissue(test::Recipe::box(20, 20, 20), "modulus_kPa = 5", "start = \"balanced\"");
  recipe.gravity = "[0, 0, -9.81]";
  try {
    World world(test::scene_of(recipe));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing holds body \"body\""), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("test.toml:"), std::string::npos) << error.what();
  }
}

// A hand presses a slab: what steps of 1 ms and of 20 ms come to, its ledger, and what the run counts.
TEST(ImplicitHexahedra, IsPressedAsInExplicitSteps) {
  const auto pressed = [](const std::string& physics, int frames) {
    test::Recipe recipe = test::pressed_slab_recipe();
    recipe.body += "\nmodel = \"fem\"";
    recipe.world.insert(recipe.world.find("radius_mm"),
                        "contact = \"nodes\"\n");  // all that implicit steps know
    recipe.physics = physics;
    World world(test::scene_of(recipe));
    test::run(world, test::steady_hand({0, 0, 1}), frames);
    const EnergyLedger ledger = world.ledger();
    EXPECT_LT(ledger.balance_error(), 1e-3);
    EXPECT_EQ(world.report().unsolved, 0);
    EXPECT_EQ(world.report().cg_iterations > 0, !physics.empty());
    double deepest = 0;
    for (const Index node : world.body(0).body().nodes())
      deepest = std::min(deepest, world.body(0).displacement(node).z());
    return deepest;
  };
  const double explicitly = pressed("", 500);
  EXPECT_LT(explicitly, -1e-4);
  EXPECT_NEAR(pressed("integrator = \"backward_euler\"\nframe_Hz = 50", 40), explicitly,
              0.01 * std::abs(explicitly));
}

// Three frames of a block under its weight, pushed at one corner.
TEST(ImplicitHexahedra, HasTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Team team(threads);
    auto body = implicit(
        tissue(test::Recipe::box(100, 80, 80), "modulus_kPa = 10\npoisson_ratio = 0.45", "fixed = [\"-z\"]"),
        Precision::single_);
    const std::vector<NodalForce> push{{body->body().nodes().back(), Vec3(0.02, 0, -0.05)}};
    for (int n = 0; n < 3; ++n)
      body->advance({.dt = 0.02, .gravity = gravity, .team = &team, .threads = threads}, push);
    if (threads == 1) first = body->hash(0);
    EXPECT_EQ(body->hash(0), first) << threads;
  }
}

// Thrown onto a floor and against a wall that no axis follows.
TEST(ImplicitHexahedra, HasTheSameBitsOnAFloorOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  const std::vector<Plane> planes{{Vec3::UnitZ(), -0.041}, {Vec3(0.6, 0, 0.8), -0.04}};
  for (const int threads : {1, 2, 3, 8}) {
    Team team(threads);
    auto body = implicit(tissue(test::Recipe::box(100, 80, 80), "modulus_kPa = 10\npoisson_ratio = 0.45",
                                "velocity_m_per_s = [-0.3, 0, -0.3]"),
                         Precision::single_);
    StepOutcome last;
    for (int n = 0; n < 3; ++n)
      last = body->advance(
          {.dt = 0.01, .gravity = gravity, .team = &team, .threads = threads, .planes = planes}, {});
    EXPECT_TRUE(last.solved);
    if (threads == 1) first = body->hash(0);
    EXPECT_EQ(body->hash(0), first) << threads;
  }
}

// V-cycles of a step on a floor: as many as of a body that is held there, at any size.
TEST(ImplicitHexahedra, AFloorCostsNoMoreCyclesThanABodyThatIsHeld) {
  const std::vector<Plane> planes{{Vec3::UnitZ(), -0.04}};
  const auto cycles = [&](double spacing, bool held) {
    test::Recipe recipe = tissue(test::Recipe::box(80, 80, 80), "modulus_kPa = 10\npoisson_ratio = 0.45",
                                 held ? "fixed = [\"-z\"]" : "");
    recipe.spacing_mm = spacing;
    auto body = implicit(recipe);
    int sum = 0;
    for (int n = 0; n < 5; ++n)
      sum += body->advance({.dt = 0.02, .gravity = gravity, .planes = planes}, {}).cg_iterations;
    return sum;
  };
  for (const double spacing : {10.0, 5.0, 2.5})
    EXPECT_LE(cycles(spacing, false), 1.5 * cycles(spacing, true) + 3) << spacing;
}

}  // namespace
}  // namespace palpate::physics
