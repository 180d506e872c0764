// Laws of a body of finite elements: what the kernel makes of a whole body is what one element promises.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "bench/problems/hex_beam.h"
#include "common/scene/scene.h"
#include "physics_node/report/run_warnings.h"
#include "physics_node/world.h"
#include "tests/support/physics/recorded_hand.h"
#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

using bench::HexBeam;

constexpr double modulus = 10e3, density = 1000;

void shake(World& world, double speed, std::uint64_t seed) {
  Dice dice(seed);
  for (const Index node : world.body(0).body().nodes())
    world.body(0).place(node, dice.within(1e-4), dice.within(speed));
  world.restart_ledger();
}
struct Hourglassed {
  const char* hourglass;
  const char* precision;
};
void PrintTo(const Hourglassed& c, std::ostream* out) { *out << c.hourglass << " " << c.precision; }

class SolidBody : public testing::TestWithParam<Hourglassed> {
 protected:
  Recipe box(double x_mm, double y_mm, double z_mm, double spacing_mm) const {
    Recipe recipe = solid_box(x_mm, y_mm, z_mm, spacing_mm);
    recipe.body += std::string("\nhourglass = \"") + GetParam().hourglass + "\"";
    recipe.precision = GetParam().precision;
    return recipe;
  }
  bool is_double() const { return GetParam().precision == std::string("double"); }
};

TEST_P(SolidBody, LeavesTheInsideAloneWhereStrainIsUniform) {
  World world(scene_of(box(50, 40, 30, 5)));
  BodyModel& body = world.body(0);
  Eigen::Matrix3d h;
  h << 0.1, -0.05, 0.2, 0.03, -0.15, 0.08, -0.12, 0.07, 0.05;
  for (const Index node : body.body().nodes())
    body.place(node, h * body.body().rest_position(node), Vec3::Zero());
  body.advance({.dt = 1e-6}, {});
  double inside = 0, outside = 0;
  for (const Index node : body.body().nodes()) {
    const Vec3 x = body.body().rest_position(node);
    const bool is_inside = std::abs(x.x()) < 0.0249 && std::abs(x.y()) < 0.0199 && std::abs(x.z()) < 0.0149;
    (is_inside ? inside : outside) = std::max(is_inside ? inside : outside, body.velocity(node).norm());
  }
  EXPECT_GT(outside, 1e-6);
  EXPECT_LT(inside, (is_double() ? 1e-12 : 1e-5) * outside);
}

TEST_P(SolidBody, KeepsMomentumAngularMomentumAndEnergy) {
  World world(scene_of(box(50, 40, 30, 5)));
  shake(world, 0.5, 3);
  const Momenta before = world.body(0).momenta();
  const double start = world.ledger().start;
  run(world, 0.5);
  const MomentumBalance balance = world.body(0).momentum_balance();
  EXPECT_LT(balance.missing.linear.norm(), (is_double() ? 1e-12 : 1e-4) * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), (is_double() ? 1e-12 : 1e-4) * balance.angular);
  EXPECT_LT((world.body(0).momenta().linear - before.linear).norm(),
            (is_double() ? 1e-12 : 1e-4) * balance.linear);
  EXPECT_GT(start, 0);
  EXPECT_LT(world.ledger().balance_error(), 8e-3)
      << "cells shaken one against the other, by 5 % of their edges";
}

TEST_P(SolidBody, KeepsTheEnergyOfShakenCellsToSecondOrder) {
  std::array<double, 2> error{};
  for (std::size_t n = 0; n < error.size(); ++n) {
    Recipe recipe = box(50, 40, 30, 5);
    recipe.physics = n == 0 ? "safety = 0.8" : "safety = 0.2";
    World world(scene_of(recipe));
    shake(world, 0.5, 3);
    run(world, 0.5);
    error[n] = world.ledger().balance_error();
  }
  EXPECT_LT(error[1], error[0] / 12) << error[0] << " at four times the step";
}

TEST_P(SolidBody, KeepsTheEnergyOfASmoothMotion) {
  Recipe recipe = box(40, 40, 40, 5);
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.gravity = "[3, 0, -9.81]";
  World world(scene_of(recipe));
  run(world, 2);
  EXPECT_GT(world.ledger().kinetic + world.ledger().elastic, 1e-4);
  EXPECT_LT(world.ledger().balance_error(), 1e-4);
}

/// A dent 5 mm wide, let go: how far the books are off after ten seconds.
double dent_error(Recipe recipe, double depth, const char* physics) {
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.physics = physics;
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  for (const Index node : body.body().nodes()) {
    const Vec3 x = body.body().rest_position(node);
    const double across = (x.x() * x.x() + x.y() * x.y()) / (2 * 0.005 * 0.005),
                 down = (0.010 - x.z()) / 0.008;
    body.place(node, Vec3(0, 0, -depth * std::exp(-across - down)), Vec3::Zero());
  }
  world.restart_ledger();
  run(world, 10);
  EXPECT_GT(world.ledger().kinetic, 1e-3 * world.ledger().start) << "it goes on swinging";
  return world.ledger().balance_error();
}

TEST_P(SolidBody, OwesWhatItLosesOfADentToItsStep) {
  const Recipe block = box(20, 20, 20, 2.5);
  const double by_itself = dent_error(block, 0.3e-3, "safety = 0.8"),
               fine = dent_error(block, 0.3e-3, "step_ms = 0.05");
  EXPECT_LT(by_itself, 1e-2) << "of ten seconds, where nothing is lost to a damper";
  EXPECT_LT(fine, 1e-4);
}

TEST_P(SolidBody, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = box(60, 50, 70, 5);
    recipe.material += "\nviscosity_Pa_s = 1";
    recipe.body +=
        "\nvelocity_m_per_s = [0.3, 0.1, -1]\nregions = [{ material = \"stiff\", center_mm = [0, 0, 10], "
        "radius_mm = 12 }]\n"
        "[[body.cavity]]\ncenter_mm = [10, 5, -10]\nradius_mm = 13\n"
        "[material.stiff]\ndensity_kg_per_m3 = 1200\nmodulus_kPa = 40\npoisson_ratio = 0.45\nviscosity_Pa_s "
        "= 4";
    recipe.world = floor_at(-37);
    recipe.gravity = "[0, 0, -9.81]";
    recipe.physics = "threads = " + std::to_string(threads);
    World world(scene_of(recipe));
    run(world, 0.05);
    EXPECT_EQ(world.report().restored, 0);
    if (threads == 1) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads << " threads";
  }
}

TEST_P(SolidBody, LosesToItsDamperWhatItsBooksSay) {
  Recipe recipe = box(40, 40, 40, 5);
  recipe.material += "\nviscosity_Pa_s = 2";
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.gravity = "[3, 0, -9.81]";
  World world(scene_of(recipe));
  double dissipated = 0;
  for (int n = 0; n < 600; ++n) {
    world.frame({});
    const EnergyLedger ledger = world.ledger();
    EXPECT_GE(ledger.dissipated, dissipated * (1 - 1e-6)) << "what is lost stays lost; frame " << n;
    dissipated = ledger.dissipated;
  }
  EXPECT_GT(dissipated, 0);
  EXPECT_LT(world.ledger().balance_error(), is_double() ? 1e-3 : 2e-3);
}

TEST_P(SolidBody, WeighsWhatItsCellsWeigh) {
  Recipe recipe = box(50, 40, 30, 5);
  recipe.body +=
      "\nregions = [{ material = \"heavy\", box_min_mm = [-25, -20, -15], box_max_mm = [0, 20, 15] }]\n"
      "[material.heavy]\ndensity_kg_per_m3 = 3000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.gravity = "[0, 0, -10]";
  World world(scene_of(recipe));
  double mass = 0;
  for (const Index node : world.body(0).body().nodes()) mass += node_mass(world.body(0).body(), node);
  EXPECT_NEAR(mass, 0.05 * 0.04 * 0.03 * (0.5 * 1000 + 0.5 * 3000), 1e-12);
  run(world, 0.1);  // and falls as a whole
  EXPECT_NEAR(world.body(0).momenta().linear.z(), -mass * 10 * 0.1, 1e-5 * mass);
}

TEST_P(SolidBody, TakesNoMoreStepsWhereItFliesThanWhereItRests) {
  // A round body has gaps in its rows of cells: what lies in a gap is not squeezed, however far the body has gone.
  const auto steps = [this](const char* velocity) {
    Recipe recipe = box(60, 60, 60, 5);
    recipe.shape = Recipe::sphere(30);
    recipe.body += std::string("\nvelocity_m_per_s = ") + velocity;
    World world(scene_of(recipe));
    run(world, 0.5);
    return world.report().steps;
  };
  EXPECT_EQ(steps("[0.3, 0.5, -1]"), steps("[0, 0, 0]"));
}

TEST_P(SolidBody, SurvivesAFallFasterThanItsWaves) {
  // Waves of shear run at 1.9 m/s: the lowest cells are flat before the highest have heard of the floor. The step follows.
  Recipe recipe = box(20, 20, 20, 2.5);
  recipe.body += "\nvelocity_m_per_s = [1, 0.5, -3]";
  recipe.world = floor_at(-12);
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  run(world, 0.1);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_GT(world.report().steps, 2 * 100 * 5) << "more steps than at rest";
  EXPECT_GT(world.body(0).momenta().linear.z(), 0) << "it has bounced";
  EXPECT_LT(world.ledger().balance_error(), is_double() ? 0.01 : 0.02);
}

TEST_P(SolidBody, ComesBackFromHalfItsHeight) {
  Recipe recipe = box(30, 30, 30, 5);
  recipe.material += "\nviscosity_Pa_s = 20";
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  Dice dice(7);
  for (const Index node : body.body().nodes()) {
    const Vec3 x = body.body().rest_position(node);
    body.place(node, Vec3(0.2 * x.x(), 0.2 * x.y(), -0.5 * x.z()) + dice.within(2e-4), Vec3::Zero());
  }
  world.restart_ledger();
  EXPECT_GT(world.body(0).counts().shape_rms, 4e-3);
  run(world, 1);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.body(0).counts().shape_rms, 1e-5);
  EXPECT_LT(world.ledger().balance_error(), 0.02);
}

TEST_P(SolidBody, SaysHowFarItsCornersWereSqueezedAndWhenTheyFold) {
  Recipe recipe = box(20, 20, 20, 5);
  recipe.material += "\nviscosity_Pa_s = 20";
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  ASSERT_TRUE(body.counts().least_corner_J.has_value());
  EXPECT_EQ(*body.counts().least_corner_J, 1);
  for (const Index node : body.body().nodes())
    body.place(node, -0.3 * Vec3::UnitZ() * body.body().rest_position(node).z(), Vec3::Zero());
  body.advance({.dt = 1e-7, .watch = true}, {});
  EXPECT_NEAR(*body.counts().least_corner_J, 0.7, 1e-4);
  const auto says_so = [&world] {
    const std::vector<std::string> warnings = all_warnings(world);
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
      return text.find("turned inside out at a corner") != std::string::npos;
    });
  };
  EXPECT_FALSE(says_so());

  // Beyond the plane of its three neighbours; it springs back within the frame that follows.
  body.place(body.body().nodes().front(), Vec3::Constant(0.003), Vec3::Zero());
  body.advance({.dt = 1e-7, .watch = true}, {});
  run(world, 0.02);
  EXPECT_LT(*body.counts().least_corner_J, 0);
  EXPECT_TRUE(body.is_finite());
  EXPECT_TRUE(says_so());
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolidBody,
                         testing::Values(Hourglassed{"physical", "double"},
                                         Hourglassed{"isotropic", "double"},
                                         Hourglassed{"physical", "single"},
                                         Hourglassed{"isotropic", "single"}));

/// A thin tip goes through a wall and turns its cells inside out: a frame has as many steps as these and their dampers ask for, however
/// long it is.
TEST(ThinTip, KeepsTheBooksInLongFrames) {
  Recipe recipe = solid_box(12, 8, 28, 2);
  recipe.physics = "frame_Hz = 20";
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.material += "\nviscosity_Pa_s = 2";
  recipe.world =
      "[[tool]]\nname = \"tip\"\nshape = \"point\"\nradius_mm = 2\ndevice = \"hand\"\nstiffness_N_per_m = "
      "4000\n"
      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]\n";
  World world(scene_of(recipe));
  const auto path = [](double t) {
    return Vec3(0.0003, std::clamp(0.008 - 0.6 * (t - 0.06), -0.010, 0.008), -0.006);
  };
  for (std::uint64_t n = 1; n <= 4; ++n) {
    std::optional<ToolState> hand = recorded_hand(path, 50 * n);
    hand->stiffness = 4000;
    world.frame(std::span(&hand, 1));
  }
  EXPECT_GT(world.report().tool_work, 1e-4);
  EXPECT_LT(world.ledger().balance_error(), 0.002);
}

TEST(Cantilever, BendsAsQuadraticBricksDoFromTwoCellsOn) {
  const std::map<int, double> within = {{2, 0.05}, {4, 0.02}, {8, 0.005}};
  for (const double nu : {0.3, 0.45, 0.49})
    for (const auto& [cells, bound] : within) {
      if (cells == 8 && nu != 0.45) continue;  // takes seconds
      const HexBeam beam({.cells = cells, .poisson_ratio = nu});
      std::printf("nu %.2f, %d cells: %.4f of the reference, %.4f of Timoshenko's\n", nu, cells,
                  beam.tip() / beam.calculix(), beam.tip() / beam.timoshenko());
      EXPECT_NEAR(beam.tip() / beam.calculix(), 1, bound) << "nu " << nu << ", " << cells << " cells";
    }
  // The fit of the isotropic stiffness is what its key says: too soft in thin parts.
  const HexBeam thin({.cells = 2, .hourglass = HourglassKind::isotropic}),
      thick({.cells = 4, .hourglass = HourglassKind::isotropic});
  EXPECT_NEAR(thin.tip() / thin.calculix(), 1.10, 0.02);
  EXPECT_NEAR(thick.tip() / thick.calculix(), 1.02, 0.01);
}

TEST(Cantilever, IsAtRestInTheBodyWhereItsElementsSaySo) {
  for (const auto hourglass : {HourglassKind::physical, HourglassKind::isotropic}) {
    const HexBeam beam({.cells = 4, .hourglass = hourglass});
    Recipe recipe = solid_box(160, 20, 20, 1e3 * beam.edge());
    recipe.body += "\nfixed = [\"-x\"]\nat_mm = [80, 0, 0]";
    if (hourglass == HourglassKind::isotropic) recipe.body += "\nhourglass = \"isotropic\"";
    World world(scene_of(recipe));
    BodyModel& body = world.body(0);
    constexpr double small = 1e-6;  // so that it is linear
    for (const Index node : body.body().nodes())
      body.place(node, small * beam.displacement(body.body().rest_position(node)), Vec3::Zero());
    constexpr double dt = 1e-6;
    body.advance({.dt = dt, .gravity = Vec3(0, 0, -small * HexBeam::gravity)}, {});
    double worst = 0;
    for (const Index node : body.body().nodes()) worst = std::max(worst, body.velocity(node).norm() / dt);
    EXPECT_LT(worst, 1e-3 * small * HexBeam::gravity) << "large deflection is not quite linear";
  }
}

}  // namespace
}  // namespace palpate::physics::test
