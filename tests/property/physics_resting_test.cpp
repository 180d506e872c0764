// What lies on a floor, in a groove, against a wall or on another body under backward_euler: it rests there, as in explicit steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double g = 9.81;

struct Kind {
  const char *name, *lattice, *body, *material;
};
const Kind solid{"fem", "voxel", "model = \"fem\"\n",
                 "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0\nviscosity_Pa_s = 20"};
const Kind voxel_springs{"voxel", "voxel", "",
                         "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 20"};
const Kind fcc_springs{"fcc", "fcc", "", "density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = 20"};

/// A block of 30 mm whose lowest masses rest at z = 0, over a floor there.
Recipe block(const Kind& kind, const std::string& physics) {
  Recipe recipe;
  recipe.lattice = kind.lattice;
  recipe.spacing_mm = 5;
  recipe.shape = Recipe::box(30, 30, 30);
  recipe.material = kind.material;
  recipe.gravity = "[0, 0, -9.81]";
  recipe.physics = physics;
  recipe.body = std::string(kind.body) + "at_mm = [0, 0, 15]";
  const Body body = body_of(recipe);
  double lowest = 1;
  for (const Index node : body.nodes()) lowest = std::min(lowest, body.rest_position(node).z());
  recipe.world = floor_at(1e3 * lowest);
  return recipe;
}
std::string implicitly(double frame_Hz) {
  return fmt::format("integrator = \"backward_euler\"\nframe_Hz = {}", frame_Hz);
}

void run_for(World& world, double seconds) {
  const auto frames = std::lround(seconds / world.frame_seconds());
  for (long n = 0; n < frames; ++n) world.frame({});
}

/// Least and mean height over the floor of what is lowest, and mean height of what is highest at rest. [m]
struct Heights {
  double lowest = 1, bottom = 0, top = 0;
};
Heights heights(const World& world, std::size_t b = 0, const Vec3& up = Vec3::UnitZ()) {
  const BodyModel& body = world.body(b);
  double lo = 1e9, hi = -1e9;
  for (const Index node : body.body().nodes()) {
    lo = std::min(lo, up.dot(body.body().rest_position(node)));
    hi = std::max(hi, up.dot(body.body().rest_position(node)));
  }
  Heights sum;
  double n_lo = 0, n_hi = 0;
  for (const Index node : body.body().nodes()) {
    const double at = up.dot(body.body().rest_position(node)), moved = up.dot(body.displacement(node));
    sum.lowest = std::min(sum.lowest, at - lo + moved);
    if (at < lo + 1e-6) sum.bottom += moved, n_lo += 1;
    if (at > hi - 1e-6) sum.top += moved, n_hi += 1;
  }
  sum.bottom /= n_lo, sum.top /= n_hi;
  return sum;
}

double mass_of(const BodyModel& body) {
  double mass = 0;
  for (const Index node : body.body().nodes()) mass += node_mass(body.body(), node);
  return mass;
}

struct Lying {
  Kind kind;
  double frame_Hz;
  const char* precision;
};
void PrintTo(const Lying& c, std::ostream* out) {
  *out << c.kind.name << " " << c.frame_Hz << " Hz " << c.precision;
}
class ImplicitRest : public testing::TestWithParam<Lying> {};

// Ten seconds on the floor: what is compressed by its weight is compressed as in explicit steps, and nothing sinks.
TEST_P(ImplicitRest, OnTheFloorNothingSinks) {
  const Lying& c = GetParam();
  Recipe recipe = block(c.kind, implicitly(c.frame_Hz));
  recipe.precision = c.precision;
  World world(scene_of(recipe));
  run_for(world, 5);
  const double midway = heights(world).top;
  run_for(world, 5);
  const Heights end = heights(world);
  EXPECT_GT(end.lowest, -1e-8);
  EXPECT_LT(end.bottom, 1e-5);
  EXPECT_NEAR(end.top, midway, 1e-6) << "it still moves";
  Recipe steps = block(c.kind, "");
  World explicitly(scene_of(steps));
  run_for(explicitly, 2);
  EXPECT_NEAR(end.top - end.bottom, heights(explicitly).top - heights(explicitly).bottom, 1e-5);
  if (c.kind.name == std::string("fem")) {
    const double sunk = 1000 * g * 0.03 * 0.03 / (2 * 1e4);  // rho g H^2 / (2 E)
    EXPECT_NEAR(end.top, -sunk, 0.03 * sunk);
  }
  EXPECT_EQ(world.report().unsolved, 0);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
  // What the floor gave is what gravity took: to a thousandth of the weight.
  const MomentumBalance momentum = world.body(0).momentum_balance();
  const double weight = g * mass_of(world.body(0));
  EXPECT_LT(momentum.missing.linear.norm(), 1e-3 * weight * 10);
  EXPECT_LT(world.body(0).momenta().linear.norm(), 1e-5 * weight * 10);
}
INSTANTIATE_TEST_SUITE_P(
    Kinds, ImplicitRest,
    testing::Values(Lying{solid, 1000, "double"}, Lying{solid, 1000, "single"}, Lying{solid, 100, "double"},
                    Lying{solid, 100, "single"}, Lying{voxel_springs, 1000, "double"},
                    Lying{voxel_springs, 100, "single"}, Lying{fcc_springs, 1000, "single"},
                    Lying{fcc_springs, 100, "double"}),
    [](const auto& test) {
      return fmt::format("{}_{}_{}", test.param.kind.name, test.param.frame_Hz, test.param.precision);
    });

// A block turned with the slope that it lies on, gravity square to it.
TEST(ImplicitContact, OnASlopeNothingSinks) {
  const Vec3 n(0.6, 0, 0.8);
  Recipe recipe = block(fcc_springs, implicitly(1000));
  recipe.gravity = fmt::format("[{}, 0, {}]", -g * n.x(), -g * n.z());
  recipe.body = "theta_deg = [0, 36.86989764584402, 0]";
  recipe.world = "";
  const Body body = body_of(recipe);
  double lowest = 1;
  for (const Index node : body.nodes()) lowest = std::min(lowest, n.dot(body.rest_position(node)));
  recipe.world = fmt::format("[[wall]]\npoint_mm = [{0}, 0, {1}]\nnormal = [0.6, 0, 0.8]\n",
                             1e3 * lowest * n.x(), 1e3 * lowest * n.z());
  World world(scene_of(recipe));
  run_for(world, 3);
  const Heights end = heights(world, 0, n);
  EXPECT_GT(end.lowest, -1e-8);
  EXPECT_LT(end.bottom, 1e-4);
  EXPECT_LT(end.top, -1e-4);
  EXPECT_GT(end.top, -2e-3);
  const double weight = g * mass_of(world.body(0));
  EXPECT_LT(world.body(0).momentum_balance().missing.linear.norm(), 1e-3 * weight * 3);
}

// A block of elements in a groove, on two edges: two walls, neither along an axis.
TEST(ImplicitContact, InAGrooveItRestsOnBothWalls) {
  Recipe recipe = block(solid, implicitly(200));
  recipe.world =
      "[[wall]]\npoint_mm = [0, 0, -15]\nnormal = [1, 0, 1]\n[[wall]]\npoint_mm = [0, 0, -15]\nnormal = [-1, "
      "0, 1]\n";
  World world(scene_of(recipe));
  run_for(world, 3);
  double deepest = 1;
  const BodyModel& body = world.body(0);
  for (const Index node : body.body().nodes())
    for (const double side : {1.0, -1.0})
      deepest = std::min(deepest,
                         (side * body.position(node).x() + body.position(node).z() + 0.015) / std::sqrt(2));
  EXPECT_NEAR(deepest, 0, 1e-8);
  const double weight = g * mass_of(body);
  EXPECT_LT(body.momentum_balance().missing.linear.norm(), 1e-3 * weight * 3);
  EXPECT_LT(body.energies(Vec3::Zero()).kinetic, 1e-8);
  EXPECT_EQ(world.report().unsolved, 0);
}

/// Highest that the middle of a block gets after it fell by 10 mm, and its ledger. [m]
double bounces_to(const Kind& kind, const std::string& physics, double restitution) {
  Recipe recipe = block(kind, physics);
  recipe.world += fmt::format("[contact]\nrestitution = {}\n", restitution);
  recipe.body += "\nvelocity_m_per_s = [0, 0, -0.5]";
  World world(scene_of(recipe));
  double highest = -1, low = 1;
  while (world.t() < 0.25) {
    world.frame({});
    const Heights now = heights(world);
    EXPECT_GT(now.lowest, physics.find("backward") != std::string::npos ? -1e-7 : -1e-3);
    low = std::min(low, now.lowest);
    if (world.t() > 0.03) highest = std::max(highest, now.bottom);
    EXPECT_LT(world.watched_ledger().balance_error(), 0.02) << world.t();
  }
  EXPECT_EQ(world.report().unsolved, 0) << physics;
  EXPECT_GE(world.ledger().contact, -1e-6 * world.ledger().exchanged);
  return highest;
}

/// Dropped, at steps in which it would fall far deeper than it is high over the floor: it lands flat, and rests there. Heights are those
/// from which it once stayed in the air.
TEST(ImplicitContact, WhatFallsOntoTheFloorInLongStepsLands) {
  for (const double frame_Hz : {20.0, 33.0, 50.0, 100.0})
    for (const double height_mm : {0.5, 2.0, 7.0, 10.0}) {
      SCOPED_TRACE(fmt::format("{} mm, {} Hz", height_mm, frame_Hz));
      Recipe recipe = block(solid, implicitly(frame_Hz));
      recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 100\npoisson_ratio = 0.45";
      recipe.world += "[contact]\nrestitution = 0\n";
      recipe.body = std::string(solid.body) + fmt::format("at_mm = [0, 0, {}]", 15 + height_mm);
      World world(scene_of(recipe));
      run_for(world, 1.5);
      EXPECT_EQ(world.report().unsolved, 0);
      const Heights now = heights(world);
      EXPECT_GT(now.lowest + 1e-3 * height_mm, -1e-8);
      EXPECT_LT(now.bottom + 1e-3 * height_mm, 20e-6);  // a bottom that bulges stands on its rim
      EXPECT_LT(std::abs(world.ledger().missing()), 0.02 * world.ledger().exchanged);
    }
}

// A thrown block bounces as in explicit steps where steps are short, and the error falls with the step.
TEST(ImplicitContact, ABlockBouncesAsInShortExplicitSteps) {
  for (const Kind& kind : {solid, voxel_springs}) {
    const double exact = bounces_to(kind, "", 0);
    EXPECT_GT(exact, 1e-3);
    const auto off = [&](double step_ms) {
      return std::abs(bounces_to(kind, implicitly(1000) + fmt::format("\nstep_ms = {}", step_ms), 0) - exact);
    };
    const double coarse = off(0.2), fine = off(0.05);
    EXPECT_LT(fine, 0.1 * exact) << kind.name;
    EXPECT_LT(fine, 0.5 * coarse) << kind.name;
  }
}

// A single layer that restitution throws back: a tile, nearly rigid.
TEST(ImplicitContact, RestitutionIsThatOfTheScene) {
  for (const double e : {0.0, 0.5, 1.0}) {
    Recipe recipe = pair_of_masses("mass_g = 1\nk1_N_per_m = 1000");
    recipe.gravity = "[0, 0, 0]";
    recipe.physics = implicitly(1000);
    recipe.body = "velocity_m_per_s = [0, 0, -1]\nat_mm = [0, 0, 0]";
    recipe.world = floor_at(-10.5) + fmt::format("[contact]\nrestitution = {}\n", e);
    World world(scene_of(recipe));
    run_for(world, 0.1);
    EXPECT_NEAR(world.body(0).velocity(world.body(0).body().nodes().front()).z(), e, 1e-9);
    const EnergyLedger ledger = world.ledger();
    EXPECT_NEAR(ledger.contact, (1 - e * e) * ledger.start, 1e-9 * ledger.start);
    EXPECT_NEAR(ledger.numerical, 0, 1e-9 * ledger.start);
    EXPECT_LT(ledger.balance_error(), 1e-9);
  }
}

// What nothing but a floor holds is balanced there: where a run comes to rest, and it stays, whatever the integrator.
TEST(ImplicitContact, ABalanceStandsOnTheFloor) {
  Recipe recipe = block(solid, implicitly(100));
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 3\npoisson_ratio = 0.4\nviscosity_Pa_s = 20";
  World run(scene_of(recipe));
  run_for(run, 5);
  for (const char* physics : {"integrator = \"backward_euler\"\nframe_Hz = 100", ""}) {
    recipe.physics = physics;
    Recipe balanced = recipe;
    balanced.body += "\nstart = \"balanced\"";
    World world(scene_of(balanced));
    EXPECT_TRUE(world.remarks().empty()) << world.remarks().front();
    EXPECT_NEAR(heights(world).top, heights(run).top, 2e-6);
    EXPECT_GT(heights(world).lowest, -1e-9);
    const double began = heights(world).top;
    run_for(world, 0.3);
    // Explicit steps let masses hover over a floor by what their last bounce was worth.
    EXPECT_NEAR(heights(world).top, began, *physics == 0 ? 1e-5 : 2e-6);
    EXPECT_LT(world.ledger().kinetic, 1e-9);
  }
}

// It is let down to the floor; a floor takes what sags into it; without one nothing holds it.
TEST(ImplicitContact, ABalanceSeesTheFloor) {
  Recipe recipe = block(solid, implicitly(100));
  recipe.body = "model = \"fem\"\nat_mm = [0, 0, 25]\nstart = \"balanced\"";
  World let_down(scene_of(recipe));
  EXPECT_NEAR(heights(let_down).bottom, -0.010, 1e-6);
  recipe.shape = Recipe::box(80, 20, 10);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.4";
  recipe.body = "model = \"fem\"\nfixed = [\"-x\"]\nat_mm = [0, 0, 10]\nstart = \"balanced\"";
  recipe.world = floor_at(0);
  World hanging(scene_of(recipe));
  double lowest = 1;
  for (const Index node : hanging.body(0).body().nodes())
    lowest = std::min(lowest, hanging.body(0).position(node).z());
  EXPECT_NEAR(lowest, 0, 1e-8);
  EXPECT_TRUE(hanging.remarks().empty());
}

/// A smaller block of the same on a block that a floor carries.
Recipe stack(const Kind& kind, const std::string& physics, const char* distance) {
  Recipe recipe = block(kind, physics);
  recipe.world += fmt::format(
      "[contact]\nrestitution = 0\ndistance = \"{}\"\n[[body]]\nname = \"upper\"\nlattice = "
      "\"{}\"\nspacing_mm = 5\n"
      "{}shape = \"box\"\nsize_mm = [20, 20, 20]\nat_mm = [0, 0, 44]\nmaterial = \"m\"\n",
      distance, kind.lattice, kind.body);
  // Nothing but a shaft keeps what lies on a face without friction from sliding off.
  recipe.world.replace(recipe.world.find("[20, 20, 20]"), 12, "[30, 30, 20]");
  for (const auto& [point, normal] : {std::pair("[16, 0, 0]", "[-1, 0, 0]"),
                                      {"[-16, 0, 0]", "[1, 0, 0]"},
                                      {"[0, 16, 0]", "[0, -1, 0]"},
                                      {"[0, -16, 0]", "[0, 1, 0]"}})
    recipe.world += fmt::format("[[wall]]\npoint_mm = {}\nnormal = {}\n", point, normal);
  return recipe;
}

/// Height of what lies lowest of the upper block over where it was at rest. [m]
struct Stacked {
  double lower = 0, upper = 0;  // top of the lower, bottom of the upper
};
Stacked stacked(const World& world) { return {heights(world, 0).top, heights(world, 1).bottom}; }

// A block on a block: it comes to rest at the contact distance, no deeper than in explicit steps, at 1 kHz and at 100 Hz, and stays.
TEST(ImplicitContact, ABlockRestsOnABlock) {
  for (const Kind& kind : {solid, voxel_springs}) {
    World explicitly(scene_of(stack(kind, "", "swept")));
    run_for(explicitly, 0.6);
    const Stacked exact = stacked(explicitly);
    for (const double frame_Hz : {1000.0, 100.0}) {
      World world(scene_of(stack(kind, implicitly(frame_Hz), "swept")));
      run_for(world, 0.4);
      const Stacked midway = stacked(world);
      run_for(world, 0.2);
      const Stacked end = stacked(world);
      SCOPED_TRACE(fmt::format("{} {} Hz", kind.name, frame_Hz));
      EXPECT_GT(end.upper - end.lower, exact.upper - exact.lower - 5e-5);
      EXPECT_NEAR(4e-3 + end.upper - end.lower, 5e-3 / std::sqrt(3), 0.1 * 5e-3 / std::sqrt(3));
      EXPECT_NEAR(end.upper, midway.upper, 1e-4) << "it sinks";
      EXPECT_EQ(world.report().restored, 0);
      EXPECT_LT(world.ledger().balance_error(), 0.02);
      Vec3 missing = Vec3::Zero();
      for (std::size_t b = 0; b < 2; ++b) missing += world.body(b).momentum_balance().missing.linear;
      EXPECT_LT(missing.norm(), 1e-3 * g * mass_of(world.body(0)) * 0.6);
    }
  }
}

// What begins nearer to another body than they touch at is not thrown: it stays where it is.
TEST(ImplicitContact, BodiesThatBeginNearEachOtherStay) {
  for (const Kind& kind : {solid, voxel_springs}) {
    Recipe recipe = stack(kind, implicitly(1000), "swept");
    recipe.gravity = "[0, 0, 0]";
    recipe.world.replace(recipe.world.find("[0, 0, 44]"), 10, "[0, 0, 42]");  // 2 mm apart, of 2.9 mm
    World world(scene_of(recipe));
    run_for(world, 0.1);
    EXPECT_EQ(world.report().restored, 0) << kind.name;
    EXPECT_FALSE(world.has_stopped()) << kind.name;
    EXPECT_LT(world.ledger().kinetic, 1e-12) << kind.name;
    EXPECT_NEAR(stacked(world).upper, 0, 1e-6) << kind.name;
  }
}

// What has fallen onto the floor lies there, though it hovers by a rounding: every step finds the floor, and is solved.
TEST(ImplicitContact, WhatHasFallenIsHeldInEveryStep) {
  Recipe recipe = block(solid, implicitly(100));
  recipe.precision = "single";
  recipe.spacing_mm = 2.5;
  recipe.shape = Recipe::box(20, 20, 20);
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.body = "model = \"fem\"\nat_mm = [0, 0, 12]";
  recipe.world = floor_at(0);
  World world(scene_of(recipe));
  run_for(world, 2);
  EXPECT_EQ(world.report().unsolved, 0);
  EXPECT_NEAR(world.body(0).momentum_balance().missing.linear.z(), 0, 1e-3 * g * mass_of(world.body(0)) * 2);
}

// Two blocks that meet in flight: momentum is kept, and neither runs into the other.
TEST(ImplicitContact, BlocksThatCollideKeepTheirMomentum) {
  for (const Kind& kind : {solid, voxel_springs}) {
    Recipe recipe = stack(kind, implicitly(1000), "swept");
    recipe.gravity = "[0, 0, 0]";
    recipe.body += "\nvelocity_m_per_s = [0, 0, 0.5]";
    World world(scene_of(recipe));
    const double before = world.body(0).momenta().linear.z();
    double nearest = 1;
    while (world.t() < 0.1) {
      world.frame({});
      const Stacked now = stacked(world);
      nearest = std::min(nearest, 0.004 + now.upper - now.lower);
      EXPECT_LT(world.watched_ledger().balance_error(), 0.01);
    }
    const double one = world.body(0).momenta().linear.z(), other = world.body(1).momenta().linear.z();
    EXPECT_GT(other, 0.2 * before) << "they have met";
    EXPECT_NEAR((one + other) / before, 1, 1e-3);
    EXPECT_GT(nearest, 0.5 * 5e-3 / std::sqrt(3)) << kind.name;
    EXPECT_GT(world.ledger().contact, -1e-3 * world.ledger().start);
  }
}

}  // namespace
}  // namespace palpate::physics::test
