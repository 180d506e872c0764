#include "physics_node/lattice/lattice.h"

#include <gtest/gtest.h>

#include <bit>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

int neighbours(const Lattice& lattice, Index cell) {
  return std::popcount(lattice.mask[static_cast<std::size_t>(cell)]);
}

Lattice ball_of_twelve_spacings() {
  Recipe recipe;
  recipe.shape = Recipe::sphere(60);
  return body_of(recipe).lattice;
}

TEST(FccLattice, PutsThePapersNumberOfMassesIntoASphere) {
  const Lattice lattice = ball_of_twelve_spacings();
  EXPECT_EQ(lattice.n_masses(), 1289);
  EXPECT_EQ(lattice.total_share(), 1289);
}

TEST(FccLattice, JoinsInnerMassesToTwelveEquallyFarNeighbours) {
  const Lattice lattice = ball_of_twelve_spacings();
  int inner = 0;
  for (const Index cell : lattice.masses) {
    if (lattice.rest_position(cell).norm() > 0.060 - 0.010 - 1e-9) continue;
    ++inner;
    ASSERT_EQ(neighbours(lattice, cell), 12);
    for (std::size_t d = 0; d < 12; ++d) {
      const Index other = cell + lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))][d];
      const Vec3 to = lattice.rest_position(other) - lattice.rest_position(cell);
      ASSERT_NEAR(to.norm(), 0.010, 1e-12);
      ASSERT_LT((to - lattice.rest_vector[d]).norm(), 1e-12);
    }
  }
  EXPECT_GT(inner, 600);
}

TEST(FccLattice, JoinsExactlyThePairsOfNeighboursWithin) {
  const Lattice lattice = ball_of_twelve_spacings();
  std::int64_t pairs = 0;
  for (std::size_t a = 0; a < lattice.masses.size(); ++a)
    for (std::size_t b = a + 1; b < lattice.masses.size(); ++b)
      if ((lattice.rest_position(lattice.masses[a]) - lattice.rest_position(lattice.masses[b])).norm() <
          0.0101)
        ++pairs;
  EXPECT_EQ(lattice.n_elements(), pairs);
}

class AnyLattice : public testing::TestWithParam<LatticeKind> {
 protected:
  static Lattice make() {
    return make_lattice(GetParam(), {7, 5, 6}, {0.1, 0.2, 0.3}, {0.001, 0.001, 0.001});
  }
  static bool is_node(const Vec3i& grid) { return GetParam() == LatticeKind::voxel || grid.sum() % 2 == 0; }
};
INSTANTIATE_TEST_SUITE_P(BothKinds, AnyLattice, testing::Values(LatticeKind::fcc, LatticeKind::voxel));

TEST_P(AnyLattice, FindsGridCoordinatesBack) {
  const Lattice lattice = make();
  std::vector<bool> taken(static_cast<std::size_t>(lattice.n_cells()), false);
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 7; ++x) {
        const Vec3i grid(x, y, z);
        if (!is_node(grid)) continue;
        const Index cell = lattice.cell_of(grid);
        ASSERT_GE(cell, 0);
        ASSERT_LT(cell, lattice.n_cells());
        ASSERT_FALSE(taken[static_cast<std::size_t>(cell)]);
        taken[static_cast<std::size_t>(cell)] = true;
        ASSERT_EQ(lattice.grid_of(cell), grid);
        ASSERT_LT((lattice.rest_position(cell) - Vec3(0.1, 0.2, 0.3) - 0.001 * grid.cast<double>()).norm(),
                  1e-15);
      }
}

TEST_P(AnyLattice, HasOppositeDirectionsAtOppositeOffsets) {
  const Lattice lattice = make();
  const auto n_half = static_cast<std::size_t>(lattice.n_half);
  for (const Vec3i& at : {Vec3i(2, 2, 2), Vec3i(3, 2, 3), Vec3i(2, 3, 3), Vec3i(3, 3, 2)}) {
    const Index cell = lattice.cell_of(at);
    for (std::size_t d = 0; d < 2 * n_half; ++d) {
      const Index other = cell + lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))][d];
      const std::size_t back = (d + n_half) % (2 * n_half);
      EXPECT_EQ(other + lattice.offset[static_cast<std::size_t>(lattice.row_kind(other))][back], cell);
      EXPECT_EQ(lattice.rest_vector[d], Vec3(-lattice.rest_vector[back]));
    }
  }
}

TEST_P(AnyLattice, KnowsThatThereIsNoMassOutside) {
  const Lattice lattice = make();
  for (const Vec3i& grid :
       {Vec3i(-2, 0, 0), Vec3i(0, -1, 1), Vec3i(0, 2, 1000), Vec3i(1000000, 0, 0), Vec3i(2, 2, 2)})
    EXPECT_EQ(lattice.mass_at(grid), -1) << grid.transpose();
}

TEST(VoxelLattice, BuildsTheVesselOfOneByTenByOneVoxels) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(1, 10, 1);
  recipe.spacing_mm = 1;
  const Lattice lattice = body_of(recipe).lattice;
  EXPECT_EQ(lattice.n_masses(), 44);
  EXPECT_NEAR(lattice.total_share(), 10, 1e-12);
}

TEST(VoxelLattice, HasTheEdgesOfFiveTetrahedraACell) {
  for (const auto& [nx, ny, nz] : {std::array{1, 10, 1}, std::array{1, 1, 1}, std::array{3, 4, 5}}) {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(nx, ny, nz);
    recipe.spacing_mm = 1;
    const int axes = nx * (ny + 1) * (nz + 1) + (nx + 1) * ny * (nz + 1) + (nx + 1) * (ny + 1) * nz;
    const int diagonals = nx * ny * (nz + 1) + nx * (ny + 1) * nz + (nx + 1) * ny * nz;
    EXPECT_EQ(body_of(recipe).lattice.n_elements(), axes + diagonals);
  }
}

TEST(VoxelLattice, JoinsInnerMassesToEighteenOrSixNeighbours) {
  Recipe recipe;
  recipe.lattice = "voxel";
  const Lattice lattice = body_of(recipe).lattice;  // 4 x 4 x 4 cells
  int inner = 0;
  for (const Index cell : lattice.masses) {
    const Vec3i grid = lattice.grid_of(cell);
    if ((grid.array() < 1).any() || (grid.array() > 3).any()) continue;
    EXPECT_EQ(neighbours(lattice, cell), (grid.sum() & 1) == 0 ? 18 : 6) << grid.transpose();
    ++inner;
  }
  EXPECT_EQ(inner, 27);
}

}  // namespace
}  // namespace palpate::physics
