// Who pays for what cells of one crack take.

#include "physics_node/step/lattice/hex_crack.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "common/scene/scene.h"
#include "tests/support/physics/solid_box.h"

namespace palpate::physics {
namespace {

/// A box of 40 x 10 x 60 mm of cells of 5 mm that break at 1.3; a crack reaches 100 / 385 / 2 = 130 mm, or as far as it is told.
class Crack : public ::testing::Test {
 protected:
  explicit Crack(double J_per_m2 = 100) : body_(breaking_box(J_per_m2)), state_(body_), shares_(body_) {}

  static Body breaking_box(double J_per_m2) {
    test::Recipe recipe = test::solid_box(40, 10, 60, 5);
    recipe.material += fmt::format("\nbreak_ratio = 1.3\nfracture_energy_J_per_m2 = {}", J_per_m2);
    return test::body_of(recipe);
  }
  /// Of the lattice. Cell (0, 0, 0) is the lowest of the box.
  Index at(int x, int y, int z) const {
    return body_.lattice.cell_of(body_.lattice.grid_of(body_.lattice.masses.front()) + Vec3i(x, y, z));
  }
  /// Its crack is across z.
  Index open(int x, int y, int z, double damage) {
    const auto c = static_cast<std::size_t>(at(x, y, z));
    state_.failed.damage[c] = damage;
    state_.failed.reached[c] = 1e-6;
    state_.failed.left[c] = 1;
    state_.failed.normal[2][c] = 1;
    return at(x, y, z);
  }
  double left(Index cell) const { return shares_.left_to(state_, cell); }

  Body body_;
  LatticeState<double> state_;
  CrackShares<double> shares_;
};

class ShortCrack : public Crack {
 protected:
  ShortCrack() : Crack(5) {}  // 5 / 385 / 2 = 6.5 mm: into the next cell, not into the one behind it
};

TEST_F(Crack, IsSharedByItsWidthAcrossItsNormal) {
  const double volume = 125e-9, edge = 5e-3;
  EXPECT_NEAR(shares_.share_of(at(0, 0, 0), Vec3::UnitZ()), 100 * volume / edge, 1e-12);
  EXPECT_NEAR(shares_.share_of(at(0, 0, 0), Vec3(1, 0, 1).normalized()),
              100 * volume / (edge * std::sqrt(2.0)), 1e-12);
}

TEST_F(Crack, ChargesTheOneThatLostMostOnce) {
  const Index leader = open(2, 0, 5, 0.8), beside = open(2, 0, 6, 0.3);
  shares_.take(state_, leader, 0.25);
  shares_.take(state_, beside, 0.125);
  EXPECT_DOUBLE_EQ(left(leader), 1 - 0.25 - 0.125);
  EXPECT_DOUBLE_EQ(left(beside), 1 - 0.125);
}

TEST_F(Crack, ChargesWhoeverLeadsLater) {
  const Index first = open(2, 0, 5, 0.3), later = open(2, 0, 6, 0.1);
  shares_.take(state_, first, 0.25);
  state_.failed.damage[static_cast<std::size_t>(later)] = 0.6;
  EXPECT_DOUBLE_EQ(left(later), 1 - 0.25);
  EXPECT_DOUBLE_EQ(left(first), 1 - 0.25);
  shares_.take(state_, first, 0.125);  // and what it took before, which nobody pays twice
  EXPECT_DOUBLE_EQ(left(later), 1 - 0.25 - 0.125);
}

TEST_F(Crack, IsNotThatOfCellsBesideTheLine) {
  const Index leader = open(2, 0, 5, 0.8), aside = open(3, 0, 5, 0.3);
  shares_.take(state_, aside, 0.25);
  EXPECT_DOUBLE_EQ(left(leader), 1);
}

/// What lies beyond tissue that is whole is another crack.
TEST_F(Crack, EndsAtACellThatHasNotBegun) {
  const Index leader = open(2, 0, 5, 0.8), beyond = open(2, 0, 7, 0.3);
  shares_.take(state_, beyond, 0.25);
  EXPECT_DOUBLE_EQ(left(leader), 1);
  open(2, 0, 6, 0.1);
  EXPECT_DOUBLE_EQ(left(leader), 1 - 0.25);
}

TEST_F(ShortCrack, DoesNotReachFar) {
  const Index leader = open(2, 0, 5, 0.8), near = open(2, 0, 6, 0.3), far = open(2, 0, 7, 0.3);
  shares_.take(state_, far, 0.25);
  EXPECT_DOUBLE_EQ(left(leader), 1);
  shares_.take(state_, near, 0.25);
  EXPECT_DOUBLE_EQ(left(leader), 1 - 0.25);
}

TEST_F(Crack, EndsAtAGapAndChargesWhoTearsThere) {
  const Index gone = open(2, 0, 5, 1), above = open(2, 0, 6, 0.3), below = open(2, 0, 4, 0.9);
  const Index next = open(3, 0, 5, 0.5);
  shares_.take(state_, above, 0.25);
  EXPECT_DOUBLE_EQ(left(below), 1 - 0.25);  // the one around the gap that lost most
  state_.failed.damage[static_cast<std::size_t>(below)] = 0;
  shares_.take(state_, above, 0.125);
  EXPECT_DOUBLE_EQ(left(next), 1 - 0.125);
  EXPECT_DOUBLE_EQ(left(gone), 1);
}

/// A cell that has nothing left goes when it is pulled on, not before.
TEST_F(Crack, LeavesSomething) {
  const Index leader = open(2, 0, 5, 0.8), beside = open(2, 0, 6, 0.3);
  shares_.take(state_, beside, 3);
  EXPECT_GT(left(leader), 0);
  EXPECT_LT(left(leader), 1e-6);
}

}  // namespace
}  // namespace palpate::physics
