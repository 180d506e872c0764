// The damper of finite elements: it resists strain and nothing else, takes what its books say, and behind a small strain it lags by
// viscosity over modulus.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

constexpr double modulus = 10e3, density = 1000;

struct Kind {
  const char* hourglass;
  const char* more;  // of the material
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.hourglass << kind.more; }

class DampedBody : public testing::TestWithParam<Kind> {
 protected:
  /// @param lag  viscosity over modulus [s]
  Recipe box(double x_mm, double y_mm, double z_mm, double spacing_mm, double lag) const {
    Recipe recipe = solid_box(x_mm, y_mm, z_mm, spacing_mm);
    recipe.body += std::string("\nhourglass = \"") + GetParam().hourglass + "\"";
    recipe.material += "\nviscosity_Pa_s = " + std::to_string(lag * modulus) + GetParam().more;
    recipe.precision = "double";
    return recipe;
  }
};

TEST_P(DampedBody, KeepsBothMomentaWhenStruckOffItsCentre) {
  World world(scene_of(box(30, 20, 20, 5, 0.5e-3)));
  BodyModel& body = world.body(0);
  for (const Index node : body.body().nodes()) {
    const Vec3 x = body.body().rest_position(node);
    if (x.x() > 0.009 && x.y() > 0) body.place(node, Vec3::Zero(), Vec3(0.1, -0.3, 0.8));
  }
  world.restart_ledger();
  body.restart_momentum();
  const double start = world.ledger().start;
  run(world, 3);
  const MomentumBalance balance = body.momentum_balance();
  EXPECT_GT(world.ledger().dissipated, 0.1 * start) << "it did damp";
  EXPECT_GT(balance.angular, 0);
  EXPECT_LT(balance.missing.linear.norm(), 1e-12 * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), 1e-12 * balance.angular);
}

TEST_P(DampedBody, KeepsItsBooksWhereItBounces) {
  for (const double lag : {0.5e-3, 1e-3, 2e-3, 10e-3}) {
    Recipe recipe = box(20, 20, 20, 5, lag);
    recipe.body += "\nvelocity_m_per_s = [0.2, 0.1, -1]";
    recipe.world = floor_at(-12);
    recipe.gravity = "[0, 0, -9.81]";
    World world(scene_of(recipe));
    double dissipated = 0;
    for (int n = 0; n < 200; ++n) {
      world.frame({});
      const EnergyLedger ledger = world.ledger();
      // Less by a hair than before where what is left of the motion turns round at every step.
      EXPECT_GE(ledger.dissipated, dissipated * (1 - 1e-6)) << "what is lost stays lost; frame " << n;
      dissipated = ledger.dissipated;
    }
    EXPECT_EQ(world.report().restored, 0);
    EXPECT_GT(dissipated, 0.05 * world.ledger().start);
    EXPECT_LT(world.ledger().balance_error(), 1.5e-3) << lag;
  }
}

TEST_P(DampedBody, SurvivesAFallWithALongLag) {
  Recipe recipe = box(20, 20, 20, 5, 10e-3);
  recipe.body += "\nvelocity_m_per_s = [0, 0, -3]";
  recipe.world = floor_at(-12);
  World world(scene_of(recipe));
  run(world, 0.1);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.ledger().balance_error(), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DampedBody,
                         testing::Values(Kind{"physical", ""}, Kind{"isotropic", ""},
                                         Kind{"physical", "\nrelaxation = [[0.3, 0.05]]"}));

/// A bar held at one end that swings along itself, in its lowest mode: E(t) = E(0) exp(-beta omega^2 t), omega from its own period.
TEST(Damper, LetsASmallWaveDecayAtTheClosedFormRate) {
  constexpr double beta = 1e-3, length = 0.08;
  Recipe recipe = solid_box(80, 10, 10, 5);
  recipe.material += "\nviscosity_Pa_s = " + std::to_string(beta * modulus);
  recipe.precision = "double";
  recipe.body += "\nfixed = [\"-x\"]";
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  Index tip = 0;
  for (const Index node : body.body().nodes()) {
    const double x = body.body().rest_position(node).x() + length / 2;
    if (x > length - 1e-6) tip = node;
    body.place(node, Vec3::Zero(), 1e-3 * std::sin(0.5 * std::numbers::pi * x / length) * Vec3::UnitX());
  }
  world.restart_ledger();
  int crossings = 0;
  double first = 0, last = 0, before = 0;
  std::vector<double> energy, time;
  for (int n = 1; n <= 900; ++n) {
    world.frame({});
    const double now = body.displacement(tip).x();
    const EnergyLedger ledger = world.ledger();
    energy.push_back(ledger.kinetic + ledger.elastic), time.push_back(1e-3 * n);
    if (before > 0 && now <= 0) {
      last = 1e-3 * (n - 1 + before / (before - now));
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  const double omega = 2 * std::numbers::pi * (crossings - 1) / (last - first);
  EXPECT_NEAR(omega, 0.5 * std::numbers::pi / length * std::sqrt(modulus / density), 0.03 * omega);
  // Over whole periods: the loss of one is not even in time.
  const double period = 2 * std::numbers::pi / omega;
  const auto from = static_cast<std::size_t>(0.1 / 1e-3);
  const std::size_t to = from + static_cast<std::size_t>(std::lround(6 * period / 1e-3));
  ASSERT_LT(to, energy.size());
  const double rate = std::log(energy[from] / energy[to]) / (time[to] - time[from]);
  EXPECT_NEAR(rate, beta * omega * omega, 0.03 * beta * omega * omega);
}

}  // namespace
}  // namespace palpate::physics::test
