// Who sleeps and what wakes it, at the thresholds that the header names.

#include "physics_node/step/lattice/sleep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

constexpr double frame = 0.01;  // [s]

/// A held block, of which the tests say what the last step saw.
class SleepingBlock : public testing::Test {
 protected:
  static Body block(const std::string& keys) {
    test::Recipe recipe;
    recipe.body = keys;
    return test::body_of(recipe);
  }
  void see_all(double speed, double acceleration) {
    for (std::size_t r = 0; r < state.ledger.size(); ++r) see(r, speed, acceleration);
  }
  void see(std::size_t row, double speed, double acceleration) {
    state.ledger[row].speed2 = speed * speed;
    state.ledger[row].acceleration2 = acceleration * acceleration;
  }
  /// Looks for so long at rows that go on as they are.
  void look_for(double seconds) {
    const int frames = static_cast<int>(std::lround(seconds / frame));
    for (int n = 0; n < frames; ++n) sleep.look(body, state, frame);
  }
  void lull() {
    see_all(1e-5, 1e-3);
    look_for(0.25);
  }
  Index masses() const { return static_cast<Index>(body.lattice.masses.size()); }

  Body body = block("fixed = [\"-z\"]");
  LatticeState<double> state{body};
  Sleep sleep{body};
};

TEST_F(SleepingBlock, SleepsAfterBeingSlowAndBalancedForAFifthOfASecond) {
  see_all(4.9e-5, 0.019);
  look_for(0.18);
  EXPECT_FALSE(sleep.any_asleep());
  look_for(0.04);
  EXPECT_EQ(sleep.sleeping_masses(), masses());
}

TEST_F(SleepingBlock, StaysAwakeWhileFasterOrOutOfBalance) {
  see_all(5.1e-5, 0);
  look_for(1);
  EXPECT_FALSE(sleep.any_asleep());
  see_all(0, 0.021);
  look_for(1);
  EXPECT_FALSE(sleep.any_asleep());
}

TEST_F(SleepingBlock, BeginsAnewAfterEachDisturbance) {
  see_all(1e-5, 0.001);
  look_for(0.15);
  see_all(1, 0.001);
  look_for(frame);
  see_all(1e-5, 0.001);
  look_for(0.15);
  EXPECT_FALSE(sleep.any_asleep());
}

/// Energy that sleep takes away is booked, and nothing moves on.
TEST_F(SleepingBlock, StandsStillAndBooksWhatItStillMoved) {
  test::shake(body, state, 1e-5, 3);
  state.ledger[0].kinetic = 2e-9;
  lull();
  ASSERT_EQ(sleep.sleeping_masses(), masses());
  for (const Index cell : body.lattice.masses) EXPECT_EQ(vector_of(state.v, cell), Vec3::Zero());
  EXPECT_DOUBLE_EQ(state.ledger[0].numerical, 2e-9);
  EXPECT_EQ(state.ledger[0].kinetic, 0);
}

TEST_F(SleepingBlock, WakesTheRowOfACellThatIsPushedAndThoseBesideIt) {
  lull();
  const Index cell = body.lattice.masses.back();
  const auto row = static_cast<std::size_t>(body.lattice.row_of(cell));
  sleep.wake_cell(body, state, cell);
  EXPECT_EQ(state.row_state[row], RowState::awake);
  EXPECT_LT(sleep.sleeping_masses(), masses());
  EXPECT_GT(sleep.sleeping_masses(), 0) << "but not the whole block";
  const auto awake = std::count(state.row_state.begin(), state.row_state.end(), RowState::awake);
  EXPECT_GT(awake, 1) << "rows beside it";
}

/// A sleeping row that borders on awake ones watches: beyond 0.08 m/s^2 it wakes, below it does not.
TEST_F(SleepingBlock, WakesAtARimThatIsPulledOutOfBalance) {
  lull();
  sleep.wake_cell(body, state, body.lattice.masses.back());
  const auto rim = static_cast<std::size_t>(
      std::find(state.row_state.begin(), state.row_state.end(), RowState::rim) - state.row_state.begin());
  ASSERT_LT(rim, state.row_state.size());
  see(rim, 0, 0.079);
  look_for(frame);
  EXPECT_EQ(state.row_state[rim], RowState::rim);
  see(rim, 0, 0.081);
  look_for(frame);
  EXPECT_EQ(state.row_state[rim], RowState::awake);
}

TEST_F(SleepingBlock, WakesAsAWhole) {
  lull();
  sleep.wake_all(body, state);
  EXPECT_FALSE(sleep.any_asleep());
  for (const RowState row : state.row_state) EXPECT_EQ(row, RowState::awake);
}

/// Slower than 0.05 mm/s it may still be far from its place: by that times viscosity over modulus.
TEST(Sleep, NeverTakesHoldOfWhatCreeps) {
  for (const char* model : {"springs", "fem"})
    for (const int viscosity : {400, 600}) {  // over 1 kPa: 0.4 and 0.6 s
      test::Recipe recipe;
      recipe.lattice = "voxel";
      recipe.material =
          "density_kg_per_m3 = 1000\nmodulus_kPa = 1\nviscosity_Pa_s = " + std::to_string(viscosity);
      recipe.body = "fixed = [\"-z\"]\nmodel = \"" + std::string(model) + "\"";
      const Body body = test::body_of(recipe);
      LatticeState<double> state{body};
      Sleep sleep{body};
      for (int n = 0; n < 100; ++n) sleep.look(body, state, frame);
      EXPECT_EQ(sleep.any_asleep(), viscosity < 500) << model;
    }
}

/// A free body must keep its momentum, however slow it is.
TEST_F(SleepingBlock, NeverSleepsWhereNothingHoldsIt) {
  body = block("");
  state = LatticeState<double>(body);
  sleep = Sleep(body);
  see_all(0, 0);
  look_for(2);
  EXPECT_FALSE(sleep.any_asleep());
}

}  // namespace
}  // namespace palpate::physics
