// Which of the kept cells deform.
#include "physics_node/body/deformable.h"
#include "common/scene/shape_spec.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

Cells full_block(const Vec3i& size, const Vec3& spacing) {
  Cells cells;
  cells.size = size;
  cells.spacing = spacing;
  cells.filled.assign(static_cast<std::size_t>(size.prod()), 1);
  return cells;
}

DeformableRegion nearest_to(const std::array<int, 3>& centre, int n) {
  DeformableRegion region{false, centre, 10};
  region.nearest = n;
  return region;
}

TEST(GravityCell, IsTheRoundedMeanOfTheFilled) {
  Cells cells = full_block({9, 7, 5}, Vec3::Constant(0.001));
  EXPECT_EQ(gravity_cell(cells), Vec3i(4, 3, 2));
  std::fill(cells.filled.begin(), cells.filled.end(), std::uint8_t{0});
  cells.filled[cells.index(1, 6, 4)] = cells.filled[cells.index(2, 6, 4)] =
      cells.filled[cells.index(2, 5, 4)] = 1;
  EXPECT_EQ(gravity_cell(cells), Vec3i(2, 6, 4));  // (5/3, 17/3, 4)
}

TEST(Deformable, MayBeCentredOnTheCentreOfGravity) {
  Cells cells = full_block({9, 9, 9}, Vec3::Constant(0.001));
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 4; ++i) cells.filled[cells.index(i, j, k)] = 0;
  DeformableRegion region{false, {0, 0, 0}, 1};
  region.gravity_center = true;
  mark_deformable(cells, region);
  EXPECT_EQ(cells.n_deformable(), 27u);
  EXPECT_TRUE(cells.is_deformable(5, 3, 5) && cells.is_deformable(7, 5, 3));
}

TEST(Deformable, TakesTheLiteralNumberOfNearestCells) {
  Cells cells = full_block({9, 9, 9}, Vec3::Constant(0.001));
  mark_deformable(cells, nearest_to({4, 4, 4}, 7));
  EXPECT_EQ(cells.n_deformable(), 7u);  // itself and its six faces
  EXPECT_TRUE(cells.is_deformable(4, 4, 4) && cells.is_deformable(3, 4, 4) && cells.is_deformable(4, 4, 5));
  mark_deformable(cells, nearest_to({4, 4, 4}, 10));
  EXPECT_EQ(cells.n_deformable(), 10u);
  EXPECT_TRUE(cells.is_deformable(4, 3, 3)) << "first in storage of the twelve that are as near";
}

TEST(Deformable, CountsNearnessInTheWorldNotInCells) {
  Cells cells = full_block({9, 9, 9}, Vec3(0.001, 0.001, 0.010));
  mark_deformable(cells, nearest_to({4, 4, 4}, 49));
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i)
        EXPECT_TRUE(k == 4 || !cells.is_deformable(i, j, k)) << i << ' ' << j << ' ' << k;
}

TEST(Deformable, FindsTheNearestOfScatteredCellsHoweverFar) {
  physics::test::Dice dice(7);
  for (int round = 0; round < 20; ++round) {
    Cells cells = full_block({14, 11, 12}, Vec3(0.001, 0.002, 0.0013));
    for (auto& filled : cells.filled) filled = dice.between(0, 1) < 0.03 ? 1 : 0;
    if (cells.n_filled() < 10) continue;
    const Vec3i centre(2, 9, 1);
    mark_deformable(cells, nearest_to({2, 9, 1}, 10));
    EXPECT_EQ(cells.n_deformable(), 10u);
    double inside = 0, outside = 1e9;
    for (int k = 0; k < 12; ++k)
      for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 14; ++i) {
          const double away = cells.spacing.cwiseProduct((Vec3i(i, j, k) - centre).cast<double>()).norm();
          if (cells.is_deformable(i, j, k)) inside = std::max(inside, away);
          if (cells.is_filled(i, j, k) && !cells.is_deformable(i, j, k)) outside = std::min(outside, away);
        }
    EXPECT_LE(inside, outside) << "round " << round << " of seed 7";
  }
}

TEST(Deformable, IsAllThereIsWhereFewerThanAskedForAreKept) {
  Cells cells = full_block({2, 2, 1}, Vec3::Constant(0.001));
  mark_deformable(cells, nearest_to({0, 0, 0}, 10));
  EXPECT_EQ(cells.n_deformable(), 4u);
}

}  // namespace
}  // namespace palpate::physics
