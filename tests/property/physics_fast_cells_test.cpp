// A hard lump in soft tissue whose cells take small steps of their own: it rests, rings, is pressed and keeps its books as with small
// steps for all.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

struct Lump {
  double contrast = 100, radius_mm = 9, lag = 2e-4;
  std::string centre = "[2, 0, 0]", more = "";
};

/// Viscosity over modulus is `lag` in both. @param all  false: small steps for all
Recipe tissue(const Lump& lump, bool subcycle = true) {
  Recipe recipe = solid_box(40, 40, 40, 4);
  recipe.precision = "double";
  recipe.material += fmt::format("\nviscosity_Pa_s = {}", 10e3 * lump.lag);
  recipe.body += fmt::format("\nregions = [{{ material = \"hard\", center_mm = {}, radius_mm = {} }}]\n{}",
                             lump.centre, lump.radius_mm, lump.more);
  recipe.world = fmt::format(
      "[material.hard]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = {}\npoisson_ratio = 0.45\nviscosity_Pa_s = "
      "{}\n",
      10 * lump.contrast, 10e3 * lump.contrast * lump.lag);
  recipe.physics = fmt::format("subcycle = {}", subcycle);
  return recipe;
}

bool has_fast_cells(const World& world) { return !world.body(0).body().solid->fast.cells.empty(); }

/// Of two worlds, the second as it will be when it has gone on by half of what its step is shorter: a symplectic Euler begins half
/// a step ahead.
double farthest(const World& a, const World& b) {
  const double ahead = 0.5 * (a.step_seconds() - b.step_seconds());
  double most = 0;
  for (const Index node : a.body(0).body().nodes())
    most = std::max(
        most, (a.body(0).displacement(node) - b.body(0).displacement(node) - ahead * b.body(0).velocity(node))
                  .norm());
  return most;
}
double largest(const World& a) {
  double most = 0;
  for (const Index node : a.body(0).body().nodes())
    most = std::max(most, a.body(0).displacement(node).norm());
  return most;
}

/// Puts all nodes to place(rest position), which go on with move(rest position).
template <class Place, class Move>
void set(World& world, const Place& place, const Move& move) {
  const Body& body = world.body(0).body();
  for (const Index node : body.nodes()) {
    const Vec3 x = body.rest_position(node);
    world.body(0).place(node, place(x), move(x));
  }
  world.restart_ledger();
}

TEST(FastCells, SaveSteps) {
  const World with(scene_of(tissue({}))), without(scene_of(tissue({}, false)));
  ASSERT_TRUE(has_fast_cells(with));
  EXPECT_FALSE(has_fast_cells(without));
  EXPECT_LT(without.step_seconds(), 0.1 * with.step_seconds());
  EXPECT_THAT(with.remarks(), testing::Contains(testing::HasSubstr("stiff cells")));
  EXPECT_THAT(without.remarks(), testing::Not(testing::Contains(testing::HasSubstr("stiff cells"))));
}

TEST(FastCells, RestWhereTheyWouldWithSmallSteps) {
  Recipe recipe = tissue({.more = "fixed = [\"-z\"]\nstart = \"balanced\""});
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe)), start(scene_of(recipe));
  ASSERT_TRUE(has_fast_cells(world));
  run(world, 0.2);
  EXPECT_GT(largest(start), 1e-4);
  EXPECT_LT(farthest(world, start), 2e-5 * largest(start));  // what the solve for the balance leaves
  EXPECT_LT(world.ledger().dissipated, 1e-6 * world.ledger().exchanged);
}

TEST(FastCells, RingAsWithSmallSteps) {
  for (const double contrast : {10.0, 100.0}) {
    const Lump lump{.contrast = contrast, .lag = 1e-4, .more = "fixed = [\"-z\"]"};
    Recipe own = tissue(lump), small = tissue(lump, false);
    for (Recipe* each : {&own, &small})
      each->physics += "\nsafety = 0.4";  // of both the error grows as its square
    World with(scene_of(own)), without(scene_of(small));
    ASSERT_TRUE(has_fast_cells(with));
    const auto sheared = [](const Vec3& x) { return Vec3(2e-3 * std::pow((x.z() + 0.02) / 0.04, 2), 0, 0); };
    const auto still = [](const Vec3&) { return Vec3(0, 0, 0); };
    set(with, sheared, still);
    set(without, sheared, still);
    double most = 0;
    for (int n = 0; n < 200; ++n) {
      with.frame({});
      without.frame({});
      most = std::max(most, farthest(with, without));
    }
    EXPECT_GT(largest(without), 2e-4);
    EXPECT_LT(most, 0.02 * 2e-3) << contrast;
    EXPECT_LT(farthest(with, without), 0.01 * 2e-3) << contrast;
    EXPECT_LT(with.ledger().balance_error(), 0.01);
    EXPECT_NEAR(with.ledger().dissipated / without.ledger().dissipated, 1, 0.02);
  }
}

TEST(FastCells, KeepBothMomenta) {
  World world(scene_of(tissue({})));
  ASSERT_TRUE(has_fast_cells(world));
  set(
      world, [](const Vec3& x) { return Vec3(0.05 * x.y(), 0.02 * x.z(), -0.05 * x.x()); },
      [](const Vec3& x) { return Vec3(Vec3(3, 10, 5).cross(x) + Vec3(0.3 + 20 * x.z(), 0.1, -0.2)); });
  run(world, 0.3);
  const MomentumBalance balance = world.body(0).momentum_balance();
  EXPECT_GT(balance.linear, 1e-3);
  EXPECT_LT(balance.missing.linear.norm(), 1e-12 * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), 1e-12 * balance.angular);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
}

TEST(FastCells, FallAsAllDo) {
  Recipe recipe = tissue({});
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  ASSERT_TRUE(has_fast_cells(world));
  run(world, 0.1);
  const double fallen = world.body(0).displacement(world.body(0).body().nodes()[0]).z();
  for (const Index node : world.body(0).body().nodes())
    EXPECT_NEAR(world.body(0).displacement(node).z(), fallen, 1e-12);
  EXPECT_NEAR(fallen, -0.5 * 9.81 * 0.01, 1e-3 * 0.049 * 5);
}

std::optional<ToolState> hand(double z, double force) {
  ToolState state;
  state.tick = 9;
  state.p_WT = {0.0005, 0.0005, z - 0.002};
  state.proxy = {0.0005, 0.0005, z};
  state.force_on_hand = {0, 0, force};
  state.engaged = 1;
  return state;
}

void press(World& world, int frames, double force) {
  const std::optional<ToolState> state = hand(0.020, force);
  for (int n = 0; n < frames; ++n) world.frame({&state, 1});
}

/// Displacements in the mean of some frames of pressing.
std::vector<Vec3> mean_pressed(World& world, int frames, double force) {
  const std::span<const Index> nodes = world.body(0).body().nodes();
  std::vector<Vec3> mean(nodes.size(), Vec3::Zero());
  for (int n = 0; n < frames; ++n) {
    press(world, 1, force);
    for (std::size_t i = 0; i < nodes.size(); ++i) mean[i] += world.body(0).displacement(nodes[i]) / frames;
  }
  return mean;
}

TEST(FastCells, ArePressedAsWithSmallSteps) {
  const Lump lump{.radius_mm = 8, .centre = "[2, 0, 8]", .more = "fixed = [\"-z\"]"};
  Recipe own = tissue(lump), small = tissue(lump, false);
  for (Recipe* each : {&own, &small}) each->world += point_tool(6);
  World with(scene_of(own)), without(scene_of(small));
  ASSERT_TRUE(has_fast_cells(with));
  const std::vector<Vec3> a = mean_pressed(with, 300, 0.3), b = mean_pressed(without, 300, 0.3);
  double off = 0, most = 0;
  // At the surface the tip presses x + dt^2 f / m, which differs by 0.1 mm.
  const Body& body = with.body(0).body();
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (body.rest_position(body.nodes()[n]).z() < 0.019) off = std::max(off, (a[n] - b[n]).norm());
    most = std::max(most, b[n].norm());
  }
  EXPECT_GT(most, 5e-4);
  EXPECT_LT(off, 0.02 * most);
  EXPECT_LT(with.ledger().balance_error(), 0.001);
  press(with, 100, 0);
  EXPECT_LT(with.ledger().balance_error(), 0.001);
  EXPECT_EQ(with.report().restored, 0);
}

/// Displacements in the mean of 0.3 s of steady forces.
std::vector<Vec3> mean_pushed(World& world, const std::vector<NodalForce>& forces) {
  const std::span<const Index> nodes = world.body(0).body().nodes();
  std::vector<Vec3> mean(nodes.size(), Vec3::Zero());
  const auto steps = static_cast<int>(std::lround(0.3 / world.step_seconds()));
  for (int n = 0; n < steps; ++n) {
    world.body(0).advance({.dt = world.step_seconds(), .watch = true}, forces);
    for (std::size_t i = 0; i < nodes.size(); ++i) mean[i] += world.body(0).displacement(nodes[i]) / steps;
  }
  return mean;
}

TEST(FastCells, GiveWayToTissueThatIsPushedAsWithSmallSteps) {
  const Lump lump{.radius_mm = 8, .centre = "[2, 0, 8]", .more = "fixed = [\"-z\"]"};
  World with(scene_of(tissue(lump))), without(scene_of(tissue(lump, false)));
  ASSERT_TRUE(has_fast_cells(with));
  std::vector<NodalForce> forces;
  for (const Index node : with.body(0).body().nodes())
    if (const Vec3 x = with.body(0).body().rest_position(node); x.z() > 0.0199 && x.head<2>().norm() < 0.009)
      forces.push_back({node, Vec3(0.003, 0, -0.02)});
  const std::vector<Vec3> a = mean_pushed(with, forces), b = mean_pushed(without, forces);
  double off = 0, most = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    off = std::max(off, (a[n] - b[n]).norm());
    most = std::max(most, b[n].norm());
  }
  EXPECT_GT(most, 5e-4);
  EXPECT_LT(off, 0.005 * most);
}

/// Forces on their very nodes are known after a step only; the next goes on with them.
TEST(FastCells, BearForcesOfTheirOwn) {
  const Lump lump{.more = "fixed = [\"-z\"]"};
  World with(scene_of(tissue(lump))), without(scene_of(tissue(lump, false)));
  ASSERT_TRUE(has_fast_cells(with));
  std::vector<NodalForce> forces;
  for (const Index cell : with.body(0).body().solid->fast.cells)
    forces.push_back({cell, Vec3(0.004, 0, -0.008)});
  for (World* world : {&with, &without})
    for (double t = 0; t < 0.3; t += world->step_seconds())
      world->body(0).advance({.dt = world->step_seconds(), .watch = true}, forces);
  EXPECT_GT(largest(without), 2e-4);
  EXPECT_LT(farthest(with, without), 0.02 * largest(without));
}

TEST(FastCells, MayNotBeTouchedAtTheSurface) {
  Recipe recipe = tissue({.centre = "[0, 0, 18]"});
  recipe.world += floor_at(-30);
  const World world(scene_of(recipe));
  EXPECT_FALSE(has_fast_cells(world));
  EXPECT_THAT(world.remarks(), testing::Contains(testing::HasSubstr("may touch")));
}

TEST(FastCells, FallOntoAFloorWithinTissue) {
  Recipe recipe = tissue({.more = "velocity_m_per_s = [0.1, 0, -1]"});
  recipe.world += floor_at(-22);
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  ASSERT_TRUE(has_fast_cells(world));
  while (world.t() < 0.3) {
    world.frame({});
    ASSERT_LT(world.watched_ledger().balance_error(), 0.01) << world.t();
  }
  EXPECT_GT(world.report().contact_lost + world.ledger().exchanged, 0);
  EXPECT_EQ(world.report().restored, 0);
}

/// The body and all of its steps are the same on any number of threads, and again after a reset.
TEST(FastCells, GiveTheSameBits) {
  for (const char* precision : {"single", "double"}) {
    std::uint64_t first = 0;
    for (const int threads : {1, 2, 3, 8}) {
      Recipe recipe = tissue({.radius_mm = 13, .more = "fixed = [\"-z\"]"});
      recipe.spacing_mm = 2;  // enough of them for a team
      recipe.precision = precision;
      recipe.physics += "\nthreads = " + std::to_string(threads);
      recipe.world += point_tool(6);
      World world(scene_of(recipe));
      ASSERT_TRUE(has_fast_cells(world));
      press(world, 20, 0.5);
      if (threads == 1) first = world.state_hash();
      EXPECT_EQ(world.state_hash(), first) << threads;
      if (threads != 2) continue;
      world.reset();
      press(world, 20, 0.5);
      EXPECT_EQ(world.state_hash(), first);
    }
  }
}

TEST(FastCells, GoOnFromARestoredState) {
  Recipe recipe = tissue({.more = "fixed = [\"-z\"]"});
  recipe.world += point_tool(6);
  World world(scene_of(recipe));
  press(world, 120, 0.5);
  world.body(0).restore();
  press(world, 30, 0.5);
  const std::uint64_t once = world.state_hash();
  EXPECT_TRUE(world.body(0).is_finite());
  World other(scene_of(recipe));
  press(other, 120, 0.5);
  other.body(0).restore();
  press(other, 30, 0.5);
  EXPECT_EQ(other.state_hash(), once);
  EXPECT_GT(largest(other), 1e-4);
}

TEST(FastCells, SleepAndWake) {
  Recipe recipe = tissue({.contrast = 20, .lag = 2e-3, .more = "fixed = [\"-z\"]"});
  recipe.spacing_mm = 5;
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  ASSERT_TRUE(has_fast_cells(world));
  run(world, 2.5);
  ASSERT_EQ(world.body(0).sleeping_fraction(), 1);
  EXPECT_LT(world.ledger().balance_error(), 0.01);
  const double sag = largest(world);
  const Body& body = world.body(0).body();
  const NodalForce force{body.nodes().back(), Vec3(0.05, 0, 0)};
  for (int n = 0; n < 20; ++n) {
    world.body(0).kick({&force, 1}, 1e-4);
    world.frame({});
  }
  EXPECT_LT(world.body(0).sleeping_fraction(), 1);
  run(world, 2.5);
  EXPECT_EQ(world.body(0).sleeping_fraction(), 1);
  EXPECT_NEAR(largest(world), sag, 0.01 * sag);
}

}  // namespace
}  // namespace palpate::physics::test
