// Labels that follow the breaks of a step against a flood over the whole body.
#include "physics_node/fragments/fragments.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

/// Whatever is stretched by more than a thousandth of its length breaks.
Recipe glass(const char* lattice, double width_mm) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.material = "mass_g = 1\nk1_N_per_m = 200\nyield_ratio = 1.0005\nbreak_ratio = 1.001";
  recipe.shape = Recipe::box(width_mm, width_mm, width_mm);
  return recipe;
}

/// Numbers of the components, by the simplest way: spread the smallest number until nothing changes.
std::map<Index, Index> brute_force(const BodyModel& moving) {
  const Lattice& lattice = moving.body().lattice;
  std::map<Index, Index> number;
  for (const Index cell : lattice.masses) number[cell] = cell;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Index cell : lattice.masses)
      for (std::size_t d = 0; d < 2 * static_cast<std::size_t>(lattice.n_half); ++d) {
        if ((moving.adjacency().live_elements(cell) >> d & 1) == 0) continue;
        const Index other = cell + lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))][d];
        const Index least = std::min(number[cell], number[other]);
        changed = changed || number[cell] != least || number[other] != least;
        number[cell] = number[other] = least;
      }
  }
  return number;
}

void expect_same_pieces(const Fragments& fragments, const BodyModel& moving, const std::string& where) {
  const std::map<Index, Index> expected = brute_force(moving);
  std::map<Index, Index> label_of, masses;
  for (const auto& [cell, number] : expected) {
    const auto known = label_of.emplace(number, fragments.label(cell)).first;
    ASSERT_EQ(fragments.label(cell), known->second) << where << ": one piece has two labels";
    ++masses[fragments.label(cell)];
  }
  ASSERT_EQ(masses.size(), label_of.size()) << where << ": two pieces have one label";
  ASSERT_EQ(fragments.count(), static_cast<Index>(label_of.size())) << where;
  for (const auto& [label, n] : masses) {
    ASSERT_GE(label, 0) << where;
    ASSERT_EQ(fragments.masses()[static_cast<std::size_t>(label)], n) << where;
  }
}

/// Moves the masses that `chosen` picks, lets what is stretched break, and puts them back.
void tear(BodyModel& moving, const std::function<Vec3(const Vec3&)>& displacement) {
  for (const Index cell : moving.body().lattice.masses)
    moving.place(cell, displacement(moving.body().lattice.rest_position(cell)), Vec3::Zero());
  moving.advance({.dt = 0}, {});
}

class RandomTears : public testing::TestWithParam<const char*> {};

TEST_P(RandomTears, LeaveThePiecesOfAFlood) {
  const std::uint64_t seed = std::random_device{}();
  for (std::uint64_t round = 0; round < 6; ++round) {
    Dice dice(seed + round);
    const auto moving = make_body_model(body_of(glass(GetParam(), 70)), Precision::double_);
    Fragments fragments(*moving);
    Fragments flood(*moving);
    moving->advance({.dt = 0}, {});
    for (int n = 0; n < 25; ++n) {
      const std::string where =
          std::string(GetParam()) + " seed " + std::to_string(seed + round) + " tear " + std::to_string(n);
      if (n % 2 == 0) {  // single masses are pulled out of place
        const double share = dice.between(0, 0.1);
        tear(*moving, [&](const Vec3&) -> Vec3 {
          return dice.between(0, 1) < share ? dice.within(0.005) : Vec3::Zero();
        });
      } else {  // a slice slides out of the body
        const Vec3 normal = dice.within(1).normalized();
        const double from = dice.between(-0.04, 0.04), thick = dice.between(0, 0.03);
        const Vec3 slide = normal.unitOrthogonal() * 0.02;
        tear(*moving, [&](const Vec3& p) -> Vec3 {
          return p.dot(normal) > from && p.dot(normal) < from + thick ? slide : Vec3::Zero();
        });
      }
      ASSERT_FALSE(moving->events().overflow);
      fragments.update(*moving);
      expect_same_pieces(fragments, *moving, where);
      flood.recompute(*moving);
      ASSERT_EQ(flood.count(), fragments.count()) << where;
    }
    EXPECT_GT(fragments.count(), 10) << "seed " << seed + round;
  }
}
INSTANTIATE_TEST_SUITE_P(EveryLattice, RandomTears, testing::Values("fcc", "voxel"));

/// A-B-C comes apart at both joints in one step, whichever of the three is the smallest.
TEST(Fragments, FollowAMiddleThatComesOffAtBothEnds) {
  struct Case {
    double from, to;  // the middle [m]
  };
  for (const Case middle : {Case{-0.006, 0.006}, Case{-0.025, 0.025}, Case{-0.03, 0.01}}) {
    const auto moving = make_body_model(body_of(glass("fcc", 90)), Precision::double_);
    Fragments fragments(*moving);
    moving->advance({.dt = 0}, {});
    fragments.update(*moving);
    ASSERT_EQ(fragments.count(), 1);
    tear(*moving, [&](const Vec3& p) -> Vec3 {
      return p.x() > middle.from && p.x() < middle.to ? Vec3(0, 0.02, 0) : Vec3::Zero();
    });
    fragments.update(*moving);
    EXPECT_EQ(fragments.count(), 3);
    expect_same_pieces(fragments, *moving, "middle to " + std::to_string(middle.to));
  }
}

TEST(Fragments, AreOfOneMassEachWhenAllIsBroken) {
  const auto moving = make_body_model(body_of(glass("fcc", 50)), Precision::double_);
  Fragments fragments(*moving);
  moving->advance({.dt = 0}, {});
  tear(*moving, [&](const Vec3& p) -> Vec3 { return p; });  // twice the size
  fragments.update(*moving);
  EXPECT_EQ(fragments.count(), moving->body().lattice.n_masses());
  EXPECT_EQ(std::count(fragments.masses().begin(), fragments.masses().end(), 1), fragments.count());
}

TEST(Fragments, FollowTheStateThatTheGuardBringsBack) {
  const auto moving = make_body_model(body_of(glass("fcc", 50)), Precision::double_);
  Fragments fragments(*moving);
  moving->advance({.dt = 0}, {});
  const auto slide = [](double from) {
    return [from](const Vec3& p) -> Vec3 { return p.x() > from ? Vec3(0, 0.02, 0) : Vec3::Zero(); };
  };
  tear(*moving, slide(0));
  fragments.update(*moving);
  ASSERT_EQ(fragments.count(), 2);
  moving->save(false);
  moving->save(true);
  tear(*moving, slide(-0.015));
  fragments.update(*moving);
  ASSERT_EQ(fragments.count(), 3);
  moving->restore();
  fragments.update(*moving);
  EXPECT_EQ(fragments.count(), 2);
  expect_same_pieces(fragments, *moving, "restored");
}

TEST(Fragments, AreWholeAgainAfterAReset) {
  Recipe recipe = glass("fcc", 50);
  recipe.body = "velocity_m_per_s = [0, 0, -3]";
  recipe.world = floor_at(-26);
  World world(scene_of(recipe));
  ASSERT_EQ(world.fragments(0)->count(), 1);
  for (int n = 0; n < 30; ++n) world.frame({});
  EXPECT_GT(world.fragments(0)->count(), 1);
  expect_same_pieces(*world.fragments(0), world.body(0), "broken");
  world.reset();
  EXPECT_EQ(world.fragments(0)->count(), 1);
  EXPECT_EQ(World(scene_of(Recipe{})).fragments(0), nullptr) << "it cannot break";
}

}  // namespace
}  // namespace palpate::physics::test
