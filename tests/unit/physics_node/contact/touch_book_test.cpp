// What hand and tissue do to each other: against closed forms, and against the ledger of the world.

#include "physics_node/contact/touch_book.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "common/message/vec3.h"
#include "common/scene/scene.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;

ToolState state_of_hand(const Vec3& p, const Vec3& force, double turned = 0, double torque = 0) {
  ToolState state{};
  state.engaged = 1;
  state.p_WT = array(p);
  state.q_WT = {std::cos(0.5 * turned), 0, 0, std::sin(0.5 * turned)};
  state.force_now = array(force);
  state.torque_now = {0, 0, torque};
  return state;
}

/// Into a spring of 400 N/m by 5 mm: k d^2 / 2, whatever the pace.
TEST(TouchBook, BooksTheWorkOnASpring) {
  for (const int n : {10, 1000}) {
    TouchBook book;
    for (int i = 0; i <= n; ++i) {
      const double d = 0.005 * i / n;
      book.hand(state_of_hand({0.1, 0.2, -d}, {0, 0, 400 * d}));
    }
    EXPECT_NEAR(book.hand_work(), 0.5 * 400 * 0.005 * 0.005, 1e-15) << n;
  }
}

TEST(TouchBook, BooksTheWorkOfATurn) {
  TouchBook book;
  constexpr double spring = 0.3;  // [N m/rad]
  for (int i = 0; i <= 100; ++i) {
    const double turned = 0.01 * i;
    book.hand(state_of_hand(Vec3::Zero(), Vec3::Zero(), turned, -spring * turned));
  }
  EXPECT_NEAR(book.hand_work(), 0.5 * spring, 1e-12);
}

/// A tool that another hand takes, or one that nobody has heard of for long, has not gone from one to the other under force.
TEST(TouchBook, BooksNoWayFromOneHandToTheNext) {
  constexpr std::int64_t ms = 1'000'000;
  struct Next {
    std::uint64_t tick;
    std::int64_t stamp_ns;
    bool same;
  };
  for (const Next next : {Next{3, 3 * ms, true}, Next{900, 900 * ms, true}, Next{1, 3 * ms, false},
                          Next{3, 1, false}, Next{3, 2000 * ms, false}}) {
    World world(pressed_slab());
    const auto frame = [&world](double z, std::uint64_t tick, std::int64_t stamp_ns) {
      std::optional<ToolState> state = state_of_hand({0, 0, z}, {0, 0, 1});
      state->tick = tick, state->stamp_ns = stamp_ns;
      world.frame(std::span(&state, 1));
    };
    frame(0.010, 1, ms);
    frame(0.009, 2, 2 * ms);
    EXPECT_NEAR(world.tool(0).book().hand_work(), 1e-3, 1e-12);
    frame(0.030, next.tick, next.stamp_ns);
    EXPECT_NEAR(world.tool(0).book().hand_work(), next.same ? -20e-3 : 1e-3, 1e-12) << next.tick;
    frame(0.029, next.tick + 1, next.stamp_ns + ms);
    EXPECT_NEAR(world.tool(0).book().hand_work(), next.same ? -19e-3 : 2e-3, 1e-12) << next.tick;
  }
}

TEST(TouchBook, BooksNothingOfAHandWithoutForces) {
  TouchBook book;
  for (int i = 0; i <= 10; ++i) {
    ToolState state = state_of_hand({0, 0, 0.01 * i}, {0, 0, 3});
    state.engaged = 0;
    book.hand(state);
    book.frame(Vec3::Zero());
  }
  EXPECT_EQ(book.hand_work(), 0);
  EXPECT_FALSE(book.felt_over_true_rms()) << "tissue bore nothing";
}

/// Felt a third more than is borne, and a quarter of a period late, along another axis.
TEST(TouchBook, TellsHowMuchMoreIsFeltThanBorne) {
  TouchBook book;
  for (int i = 0; i < 1000; ++i) {
    const double phase = 2 * std::numbers::pi * i / 100;
    book.hand(state_of_hand(Vec3::Zero(), {0, 0, 4 * std::cos(phase)}));
    book.frame({3 * std::sin(phase), 0, 0});
  }
  EXPECT_NEAR(book.felt_over_true_rms().value(), 4.0 / 3, 1e-9) << "their sizes";
  EXPECT_NEAR(book.felt_off_rms().value(), 5.0 / 3, 1e-9) << "their difference";
}

TEST(TouchBook, LeavesOutWhatIsNoNumber) {
  TouchBook book;
  book.hand(state_of_hand(Vec3::Zero(), {0, 0, 1}));
  book.frame({0, 0, 1});
  book.frame({0, 0, std::numeric_limits<double>::infinity()});
  book.tissue(std::numeric_limits<double>::quiet_NaN());
  book.tissue(2);
  EXPECT_EQ(book.felt_over_true_rms(), 1);
  EXPECT_EQ(book.tissue_work(), 2);
}

/// What the ledger has of all tools is what the only tool has done on tissue: with springs, on faces of
/// elements, in implicit steps.
TEST(TouchBook, AgreesWithTheLedgerOfTheWorld) {
  const std::string euler = "integrator = \"symplectic_euler\"", verlet = "integrator = \"velocity_verlet\"",
                    implicit = "integrator = \"backward_euler\"\nstep_ms = 5";
  const std::string springs, fem = "\nmodel = \"fem\"";
  for (const auto& [physics, model] :
       {std::pair(euler, springs), {verlet, springs}, {implicit, springs}, {euler, fem}, {implicit, fem}}) {
    SCOPED_TRACE(physics + model);
    Recipe recipe = pressed_slab_recipe();
    recipe.physics = physics;
    recipe.body += model;
    if (model == fem) recipe.material += "\npoisson_ratio = 0.4";
    World world(scene_of(recipe));
    run(world, steady_hand({0, 0, 0.5}), 100);
    ASSERT_GT(world.ledger().tool_work, 1e-5);
    EXPECT_NEAR(world.tool(0).book().tissue_work(), world.ledger().tool_work,
                1e-6 * world.ledger().tool_work);
    EXPECT_LT((world.tool(0).borne() - world.tool(0).force()).norm(), 1e-12);
    world.reset();
    EXPECT_EQ(world.tool(0).book().tissue_work(), 0);
  }
}

}  // namespace
}  // namespace palpate::physics
