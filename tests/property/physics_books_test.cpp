// The books of energy and momentum close where bodies rest, fall, ring, break and meet: at every frame, whatever the law.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/load_scene.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// What the worst frame of a run said.
struct Books {
  double error = 0;                // of the balance of energy
  double falls = 0;                // of `dissipated`, over what was exchanged
  double linear = 0, angular = 0;  // of momentum, at the end
  EnergyLedger last;
};

Books keep(World& world, double seconds, double from = 0.02) {
  Books books;
  double most = 0;
  while (world.t() < seconds) {
    world.frame({});
    const EnergyLedger seen = world.watched_ledger();
    books.falls =
        std::max(books.falls, (most - seen.dissipated) / std::max(seen.exchanged, EnergyLedger::negligible));
    most = std::max(most, seen.dissipated);
    if (world.t() > from) books.error = std::max(books.error, seen.balance_error());
  }
  books.last = world.ledger();
  books.error = std::max(books.error, books.last.balance_error());
  MomentumBalance sum;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const MomentumBalance one = world.body(b).momentum_balance();
    sum.missing.linear += one.missing.linear;
    sum.missing.angular += one.missing.angular;
    sum.linear += one.linear;
    sum.angular += one.angular;
  }
  books.linear = sum.missing.linear.norm() / std::max(sum.linear, 1e-12);
  books.angular = sum.missing.angular.norm() / std::max(sum.angular, 1e-12);
  EXPECT_EQ(world.report().restored, 0);
  return books;
}

// --- a cube of gel that rests on the floor ---

struct Rest {
  const char *integrator, *lattice, *precision;
  double restitution, viscosity_Pa_s;
};
void PrintTo(const Rest& c, std::ostream* out) {
  *out << c.integrator << " " << c.lattice << " " << c.precision << " e " << c.restitution << " "
       << c.viscosity_Pa_s << " Pa s";
}

class OnTheFloor : public testing::TestWithParam<Rest> {};

TEST_P(OnTheFloor, ACubeOfGelKeepsItsBooks) {
  const Rest& c = GetParam();
  Recipe recipe;
  recipe.lattice = c.lattice;
  recipe.precision = c.precision;
  recipe.shape = Recipe::box(40, 40, 40);
  recipe.material =
      fmt::format("density_kg_per_m3 = 1000\nmodulus_kPa = 10\nviscosity_Pa_s = {}", c.viscosity_Pa_s);
  recipe.gravity = "[0, 0, -9.81]";
  recipe.physics = fmt::format("integrator = \"{}\"", c.integrator);
  recipe.body = "at_mm = [0, 0, 20.2]";
  recipe.world = fmt::format("[contact]\nrestitution = {}\n{}", c.restitution, floor_at(0));
  World world(scene_of(recipe));
  const Books books = keep(world, c.integrator == std::string("backward_euler") ? 0.3 : 1.0);
  const bool single = c.precision == std::string("single");
  EXPECT_LT(books.error, 5e-3);
  EXPECT_EQ(books.falls, 0);
  EXPECT_GT(books.last.exchanged, 1e-6);
  EXPECT_GT(books.last.dissipated, 0);
  EXPECT_GE(books.last.contact, c.restitution < 1 ? 0 : -1e-9 * books.last.exchanged);
  EXPECT_LT(books.linear, single ? 1e-6 : 1e-10);
}

std::vector<Rest> rests() {
  std::vector<Rest> all;
  for (const char* integrator : {"symplectic_euler", "velocity_verlet", "backward_euler"})
    for (const char* lattice : {"fcc", "voxel"})
      for (const char* precision : {"double", "single"})
        for (const double e : {0.0, 0.5, 1.0})
          for (const double viscosity : {2.0, 20.0})
            all.push_back({integrator, lattice, precision, e, viscosity});
  return all;
}
INSTANTIATE_TEST_SUITE_P(Resting, OnTheFloor, testing::ValuesIn(rests()), [](const auto& test) {
  const Rest& c = test.param;
  return fmt::format("{}_{}_{}_e{}_{}Pas", c.integrator, c.lattice, c.precision,
                     static_cast<int>(10 * c.restitution), static_cast<int>(c.viscosity_Pa_s));
});

// --- a column that falls over ---

TEST(OnTheFloor, AColumnThatFallsOverKeepsItsBooks) {
  for (const char* integrator : {"symplectic_euler", "velocity_verlet"}) {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(20, 20, 80);
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 60\nviscosity_Pa_s = 5";
    recipe.gravity = "[0, 0, -9.81]";
    recipe.physics = fmt::format("integrator = \"{}\"", integrator);
    recipe.body = "at_mm = [0, 0, 40.5]";
    recipe.world = "[contact]\nrestitution = 0.3\n" + floor_at(0);
    World world(scene_of(recipe));
    for (const Index cell : world.body(0).body().lattice.masses)  // pushed over: it turns about its foot
      world.body(0).place(cell, Vec3::Zero(), {12 * world.body(0).position(cell).z(), 0, 0});
    world.restart_ledger();
    const Books books = keep(world, 1.5);
    double top = 0;
    for (const Index cell : world.body(0).body().lattice.masses)
      top = std::max(top, world.body(0).position(cell).z());
    EXPECT_LT(top, 0.04) << "it stands";
    EXPECT_LT(books.error, 2e-3) << integrator;
    EXPECT_EQ(books.falls, 0) << integrator;
    EXPECT_LT(books.linear, 1e-10) << integrator;
    EXPECT_LT(books.angular, 1e-10) << integrator;
  }
}

// --- ringing without loss ---

TEST(Ringing, ABlockHeldAtOneEndKeepsItsEnergy) {
  for (const char* integrator : {"symplectic_euler", "velocity_verlet"})
    for (const char* lattice : {"fcc", "voxel"})
      for (const double safety : {0.9, 0.3}) {
        Recipe recipe;
        recipe.lattice = lattice;
        recipe.shape = Recipe::box(80, 40, 40);
        recipe.material = "mass_g = 1\nk1_N_per_m = 4000";
        recipe.gravity = "[0, 0, -9.81]";
        recipe.physics = fmt::format("integrator = \"{}\"\nsafety = {}", integrator, safety);
        recipe.body = "fixed = [\"-x\"]";
        World world(scene_of(recipe));
        const Books books = keep(world, 2, 0.005);
        EXPECT_LT(books.error, 1e-4) << integrator << " " << lattice << " " << safety;
        EXPECT_EQ(books.last.dissipated, 0);
        EXPECT_LT(std::abs(books.last.numerical), 0.01 * books.last.exchanged);
      }
}

TEST(Ringing, ALinearSpringKeepsItsEnergyToRounding) {
  for (const char* integrator : {"symplectic_euler", "velocity_verlet"}) {
    Recipe recipe = pair_of_masses("mass_g = 1\nk1_N_per_m = 200");
    recipe.physics = fmt::format("integrator = \"{}\"\nsafety = 0.9", integrator);
    World world(scene_of(recipe));
    const auto& masses = world.body(0).body().lattice.masses;
    ASSERT_EQ(masses.size(), 2U);
    const Vec3 along = (world.body(0).position(masses[1]) - world.body(0).position(masses[0])).normalized();
    world.body(0).place(masses[0], -0.01 * along, Vec3::Zero());
    world.body(0).place(masses[1], 0.01 * along, 0.3 * along);
    world.restart_ledger();
    const Books books = keep(world, 1, 0);
    EXPECT_LT(books.error, 1e-11) << integrator;
  }
}

// --- whatever meets ---

/// Two bodies of random stuff that fall, meet each other and the floor, yield and break.
Recipe meeting(int seed, const char* integrator) {
  Dice dice(static_cast<std::uint64_t>(seed) + 1);
  Recipe recipe;
  recipe.lattice = seed % 2 == 0 ? "voxel" : "fcc";
  recipe.precision = seed % 5 == 4 ? "single" : "double";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.shape = Recipe::box(40, 40, 40);
  recipe.material = fmt::format("mass_g = 1\nk1_N_per_m = {}", dice.between(100, 1000));
  if (seed % 4 != 3) recipe.material += fmt::format("\nviscosity_N_s_per_m = {}", dice.between(0.01, 0.5));
  if (seed % 3 == 2)
    recipe.material += fmt::format("\nk2_ratio = 0.3\nyield_ratio = {}\nbreak_ratio = {}",
                                   dice.between(1.02, 1.1), dice.between(1.15, 1.4));
  recipe.body = fmt::format("at_mm = [0, 0, {}]\nvelocity_m_per_s = [{}, {}, {}]", dice.between(21, 40),
                            dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(-1.5, 0));
  recipe.world = fmt::format(
      "[contact]\nrestitution = {}\ndistance = \"{}\"\n[[body]]\nname = \"ball\"\nlattice = "
      "\"{}\"\nspacing_mm = 10\n"
      "shape = \"sphere\"\nradius_mm = 22\nat_mm = [{}, 0, 95]\nvelocity_m_per_s = [0, 0, -1]\nmaterial = "
      "\"m\"\n",
      dice.between(0, 1), seed % 2 == 0 ? "swept" : "paper", seed % 3 == 1 ? "fcc" : "voxel",
      dice.between(-20, 20));
  recipe.world += floor_at(0);
  recipe.physics = fmt::format("integrator = \"{}\"\nsafety = {}", integrator, dice.between(0.2, 0.8));
  return recipe;
}

TEST(Meeting, KeepsTheBooksWhateverTheSeed) {
  for (const char* integrator : {"symplectic_euler", "velocity_verlet", "backward_euler"})
    for (int seed = 0; seed < 12; ++seed) {
      World world(scene_of(meeting(seed, integrator)));
      const Books books = keep(world, 0.6);
      EXPECT_LT(books.error, 0.01) << integrator << " " << seed;
      EXPECT_EQ(books.falls, 0) << integrator << " " << seed;
      const bool single = world.scene().physics->precision == Precision::single_;
      EXPECT_LT(books.linear, single ? 1e-6 : 1e-10) << integrator << " " << seed;
    }
}

// --- what tools do ---

TEST(Tools, WorkIsWhatTheTissueTakes) {
  for (const char* integrator : {"symplectic_euler", "velocity_verlet"}) {
    Recipe recipe = pressed_slab_recipe();
    recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20";
    recipe.physics = fmt::format("sleep = false\nintegrator = \"{}\"\nsafety = 0.9", integrator);
    World world(scene_of(recipe));
    double worst = 0;
    for (int n = 0; n < 300; ++n) {
      const double push = 0.2 * (1 - std::cos(0.1 * n));
      const std::optional<ToolState> hand = steady_hand({0, 0, push});
      world.frame(std::span(&hand, 1));
      if (n > 20)
        worst = std::max({worst, world.watched_ledger().balance_error(), world.ledger().balance_error()});
    }
    EXPECT_GT(world.ledger().exchanged, 1e-6) << integrator;
    EXPECT_LT(worst, 1e-3) << integrator;
  }
}

/// A plate that a hand shakes beside a ball, which it strikes; the plate rings.
TEST(Tools, WorkOfAHandThatLeadsABodyIsWhatItTakes) {
  for (const char* distance : {"paper", "swept"})
    for (const char* integrator : {"symplectic_euler", "velocity_verlet"}) {
      World world(parse_scene(
          fmt::format("gravity_m_per_s2 = [0, 0, 0]\n[physics]\nprecision = \"double\"\nintegrator = \"{}\"\n"
                      "[contact]\ndistance = \"{}\"\nrestitution = 0.5\n"
                      "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius_mm = 12\nspacing_mm = 6\nat_mm "
                      "= [20, 18, 10]\n"
                      "material = \"m\"\n"
                      "[[tool]]\nname = \"plate\"\nshape = \"knife\"\nlength_mm = 40\nheight_mm = "
                      "40\nspacing_mm = 5\n"
                      "material = \"steel\"\ndevice = \"hand\"\n"
                      "[material.m]\nmass_g = 1\nk1_N_per_m = 500\n"
                      "[material.steel]\nmass_g = 10\nk1_N_per_m = 20000\n"
                      "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 0], [1, 0, 0, 0]]\n",
                      integrator, distance),
          "plate.toml"));
      double worst = 0;
      for (std::uint64_t n = 1; n <= 300; ++n) {
        ToolState state{};
        state.tick = n;
        state.engaged = 1;
        state.p_WT = {0, 0.006 * (1 - std::cos(0.05 * static_cast<double>(n))), 0};
        state.q_WT = {1, 0, 0, 0};
        const std::vector<std::optional<ToolState>> hand{state};
        world.frame(hand);
        if (n > 20)
          worst = std::max({worst, world.watched_ledger().balance_error(), world.ledger().balance_error()});
      }
      EXPECT_GT(world.collisions()->tally().collisions, 10);
      EXPECT_GT(world.body(0).momenta().linear.y(), 1e-3) << "the ball was struck";
      EXPECT_LT(worst, 1e-3) << integrator << " " << distance;
    }
}

}  // namespace
}  // namespace palpate::physics::test
