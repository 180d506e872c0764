// What a step says of the elements that broke in it, and what a break must not change.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

const char* const brittle =
    "mass_g = 1\nk1_N_per_m = 200\nk2_ratio = 0.2\nyield_ratio = 1.05\nbreak_ratio = 1.1";

Recipe brittle_box(const char* lattice, double width_mm = 50) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.material = brittle;
  recipe.shape = Recipe::box(width_mm, width_mm, width_mm);
  return recipe;
}

using Ends = std::pair<Index, Index>;

/// Elements by what the masks of their first ends say.
std::set<Ends> live_elements(const BodyModel& moving) {
  const Lattice& lattice = moving.body().lattice;
  std::set<Ends> live;
  for (const Index cell : lattice.masses)
    for (int d = 0; d < lattice.n_half; ++d)
      if ((moving.adjacency().live_elements(cell) >> d & 1) != 0) {
        const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
        live.insert({cell, cell + offset[static_cast<std::size_t>(d)]});
      }
  return live;
}

void shake(BodyModel& moving, double speed, std::uint64_t seed) {
  Dice dice(seed);
  for (const Index cell : moving.body().lattice.masses) moving.place(cell, Vec3::Zero(), dice.within(speed));
}

TEST(FreshBreaks, AreWhatTheMasksLost) {
  for (const char* lattice : {"fcc", "voxel"}) {
    const auto moving = make_body_model(body_of(brittle_box(lattice)), Precision::single_);
    shake(*moving, 1.5, 3);
    moving->advance({.dt = 2e-4}, {});
    std::set<Ends> before = live_elements(*moving);
    std::int64_t broken = moving->breaks();
    for (int n = 0; n < 150; ++n) {
      const std::int64_t now = moving->advance({.dt = 2e-4}, {}).broken;
      const std::set<Ends> after = live_elements(*moving);
      std::set<Ends> lost;
      Index last = 0;
      for (const EdgeGone& one : moving->events().edges_gone) {
        EXPECT_TRUE(lost.insert({one.a, one.b}).second) << lattice;
        EXPECT_LE(last, std::min(one.a, one.b)) << "not in storage order";
        last = std::min(one.a, one.b);
      }
      std::set<Ends> sum = after;
      sum.insert(lost.begin(), lost.end());
      EXPECT_EQ(sum, before) << lattice << " step " << n;
      EXPECT_EQ(after.size() + lost.size(), before.size()) << lattice << " step " << n;
      EXPECT_EQ(static_cast<std::size_t>(now), lost.size());
      EXPECT_FALSE(moving->events().overflow);
      broken += now;
      before = after;
    }
    EXPECT_EQ(moving->breaks(), broken);
    EXPECT_GT(broken, 50) << lattice;
  }
}

TEST(FreshBreaks, ComeInOneOrderForAnyNumberOfThreads) {
  std::vector<std::vector<Ends>> lists;
  for (const int threads : {1, 2, 5}) {
    const auto moving = make_body_model(body_of(brittle_box("fcc", 210)), Precision::single_);
    ASSERT_GT(moving->body().lattice.chunks.size(), 1u);
    shake(*moving, 2, 4);
    std::vector<Ends> all;
    Team team(threads);
    for (int n = 0; n < 30; ++n) {
      moving->advance({.dt = 2e-4, .team = &team, .threads = threads}, {});
      for (const EdgeGone& one : moving->events().edges_gone) all.emplace_back(one.a, one.b);
    }
    lists.push_back(all);
  }
  EXPECT_GT(lists[0].size(), 100u);
  EXPECT_EQ(lists[1], lists[0]);
  EXPECT_EQ(lists[2], lists[0]);
}

TEST(FreshBreaks, SayWhenTheyAreNotAll) {
  FreshBreaks fresh;
  fresh.reserve(2);
  const std::size_t room = fresh.list.capacity();
  fresh.begin_step();
  for (std::size_t n = 0; n < room; ++n) fresh.add(EdgeGone{});
  EXPECT_FALSE(fresh.overflow);
  fresh.add(EdgeGone{});
  EXPECT_TRUE(fresh.overflow);
  EXPECT_EQ(fresh.list.size(), room);
  fresh.begin_step();
  EXPECT_FALSE(fresh.overflow);
  EXPECT_TRUE(fresh.list.empty());
}

TEST(FreshBreaks, KnowThatAStateWasReplaced) {
  const auto moving = make_body_model(body_of(brittle_box("fcc")), Precision::double_);
  const ExplicitStep step{.dt = 2e-4};
  EXPECT_TRUE(moving->events().overflow);
  moving->advance(step, {});
  moving->advance(step, {});
  for (const bool restore : {true, false}) {
    EXPECT_FALSE(moving->events().overflow);
    if (restore) {
      moving->restore();
    } else {
      moving->reset();
    }
    EXPECT_TRUE(moving->events().overflow);
    moving->advance(step, {});
    EXPECT_TRUE(moving->events().overflow);
    moving->advance(step, {});
    EXPECT_FALSE(moving->events().overflow);
  }
  const auto elastic = make_body_model(body_of(Recipe{}), Precision::double_);
  EXPECT_FALSE(elastic->events().overflow);
}

TEST(Momentum, IsNotChangedByABreak) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Recipe recipe = brittle_box("fcc");
    recipe.material += "\nviscosity_N_s_per_m = 0.05";
    const auto moving = make_body_model(body_of(recipe), Precision::double_, integrator);
    shake(*moving, 2, 5);
    double scale = 0;  // sum of |m v|: what the sums round by
    for (const Index cell : moving->body().lattice.masses) scale += 1e-3 * moving->velocity(cell).norm();
    const Momenta start = moving->momenta();
    for (int n = 0; n < 200; ++n) {
      moving->advance({.dt = 2e-4, .verlet = integrator == Integrator::velocity_verlet}, {});
      const Momenta now = moving->momenta();
      ASSERT_LT((now.linear - start.linear).norm(), 1e-13 * scale) << "step " << n;
      // Central forces turn nothing; Verlet's velocity of whole steps is exact in it to second order only.
      if (integrator == Integrator::symplectic_euler) {
        ASSERT_LT((now.angular - start.angular).norm(), 1e-13 * scale) << "step " << n;
      }
    }
    EXPECT_GT(moving->breaks(), 100);
  }
}

struct Books {
  const char* integrator;
  const char* precision;
  double linear, angular;  // largest error
};
void PrintTo(const Books& b, std::ostream* out) { *out << b.integrator << " " << b.precision; }

class MomentumBooks : public testing::TestWithParam<Books> {};

/// A ball breaks on the floor, aside of the origin, and is pushed on one of its masses all the time.
TEST_P(MomentumBooks, HoldWhatGravityFloorAndPushesPutIn) {
  const Books& books = GetParam();
  Recipe recipe;
  recipe.shape = Recipe::sphere(40);
  recipe.material = brittle;
  recipe.material += "\nviscosity_N_s_per_m = 0.05";
  recipe.body = "velocity_m_per_s = [0.3, 0.1, -2]\nat_mm = [100, 50, 45]";
  recipe.precision = books.precision;
  recipe.physics = std::string("integrator = \"") + books.integrator + "\"";
  recipe.gravity = "[1, 0, -9.81]";
  recipe.world = floor_at(0);
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  for (int n = 0; n < 150; ++n) {
    const NodalForce push{body.body().lattice.masses[100], Vec3(0.1, -0.2, 0.05)};
    body.kick({&push, 1}, world.step_seconds());
    world.frame({});
  }
  EXPECT_GT(body.breaks(), 10);
  EXPECT_EQ(world.report().restored, 0);
  const MomentumBalance balance = body.momentum_balance();
  EXPECT_GT(balance.linear, 0.5);
  EXPECT_GT(balance.angular, 0.05);
  EXPECT_LT(balance.missing.linear.norm(), books.linear * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), books.angular * balance.angular);
}
INSTANTIATE_TEST_SUITE_P(EveryIntegrator, MomentumBooks,
                         testing::Values(Books{"symplectic_euler", "double", 1e-12, 1e-12},
                                         Books{"symplectic_euler", "single", 1e-5, 1e-5},
                                         Books{"velocity_verlet", "double", 1e-12, 1e-12},
                                         Books{"velocity_verlet", "single", 1e-5, 1e-5},
                                         Books{"backward_euler", "double", 1e-6, 1e-2}));

}  // namespace
}  // namespace palpate::physics::test
