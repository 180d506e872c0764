// Surfaces and loose parts of bodies that have lost elements. Elements are broken by pulling masses away.
#include <gtest/gtest.h>

#include <algorithm>

#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/loose_parts.h"
#include "physics_node/step/body_model.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/surface_volume.h"

namespace palpate::physics {
namespace {

using namespace test;

constexpr double cell_m3 = 1e-6;  // 10 mm

/// Pulls these masses a metre away, all by the same, so that they lose every element to the others.
void pull(BodyModel& moving, const std::vector<Index>& masses) {
  for (const Index mass : masses) moving.place(mass, Vec3(0, 0, 1), Vec3::Zero());
  moving.advance({.dt = 1e-9, .watch = true}, {});
}

/// What the tetrahedra at a mass deep inside hold: at an odd one a sixth of each of eight cells, at an even one that of
/// three corners and of the middle, five sixths.
double volume_at(const Vec3i& grid) { return cell_m3 * 8 * ((grid.sum() & 1) != 0 ? 1 : 5) / 6; }

TEST(BrokenVoxelSurface, LosesTheTetrahedraAtMassesThatAreGone) {
  const auto moving =
      make_body_model(body_of(fragile("voxel", Recipe::box(130, 130, 130))), Precision::double_);
  const Lattice& lattice = moving->body().lattice;
  const std::uint64_t seed = 7;
  Dice dice(seed);
  std::vector<Vec3i> gone;
  std::vector<Index> cells;
  double lost = 0;
  for (int n = 0; n < 200; ++n) {
    const Vec3i grid = (Vec3::Constant(6.5) + dice.within(4.4)).cast<int>();
    // Neither two nearby nor one near the outside: triangles without a tetrahedron would be left, as sheets.
    const bool alone = std::all_of(gone.begin(), gone.end(), [&](const Vec3i& other) {
      return (grid - other).cwiseAbs().maxCoeff() > 2;
    });
    if (!alone) continue;
    gone.push_back(grid);
    cells.push_back(lattice.mass_at(grid));
    lost += volume_at(grid);
  }
  ASSERT_GT(gone.size(), 10u) << "seed " << seed;
  pull(*moving, cells);
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  EXPECT_NEAR(volume_inside(surface), 13 * 13 * 13 * cell_m3 - lost, 1e-12) << "seed " << seed;
  const auto parts = loose_parts(moving->body(), LiveElements(*moving));
  ASSERT_EQ(parts.size(), cells.size()) << "a particle each, seed " << seed;
  for (const auto& part : parts) EXPECT_EQ(part[0], part[1]);
}

TEST(BrokenVoxelSurface, LosesWhatIsRoundOneMass) {
  for (const Vec3i& grid : {Vec3i(3, 3, 3), Vec3i(3, 3, 4)}) {
    const auto moving =
        make_body_model(body_of(fragile("voxel", Recipe::box(60, 60, 60))), Precision::double_);
    pull(*moving, {moving->body().lattice.mass_at(grid)});
    EXPECT_NEAR(volume_inside(make_surface(*moving, std::nullopt, 0)), 216 * cell_m3 - volume_at(grid),
                1e-15);
  }
}

TEST(BrokenVoxelSurface, StaysClosedAtACornerOfABox) {
  for (const Vec3i& corner : {Vec3i(0, 0, 0), Vec3i(3, 0, 0)}) {
    const auto moving =
        make_body_model(body_of(fragile("voxel", Recipe::box(30, 30, 30))), Precision::double_);
    pull(*moving, {moving->body().lattice.mass_at(corner)});
    const double lost = (corner.sum() & 1) != 0 ? 1.0 / 6 : 5.0 / 6;
    EXPECT_NEAR(volume_inside(make_surface(*moving, std::nullopt, 0)), (27 - lost) * cell_m3, 1e-15);
  }
}

TEST(BrokenVoxelSurface, LeavesWholeCellsAsTheyWere) {
  const auto moving = make_body_model(body_of(fragile("voxel", Recipe::box(60, 30, 30))), Precision::double_);
  const Surface before = make_surface(*moving, std::nullopt, 0);
  pull(*moving, {moving->body().lattice.mass_at({0, 0, 0})});
  const Surface after = make_surface(*moving, std::nullopt, 0);
  const CutCells cut(moving->body(), LiveElements(*moving));
  EXPECT_EQ(cut.cells().size(), 1u);
  const auto quads = [](const Surface& surface) {
    return std::count_if(surface.facets.begin(), surface.facets.end(),
                         [](const auto& f) { return f[2] != f[3]; });
  };
  EXPECT_EQ(quads(after), quads(before) - 3);
}

class LooseParts : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Lattices, LooseParts, testing::Values("fcc", "voxel"));

TEST_P(LooseParts, AreNoneInAWholeBox) {
  const auto moving =
      make_body_model(body_of(fragile(GetParam(), Recipe::box(60, 60, 60))), Precision::double_);
  EXPECT_TRUE(loose_parts(moving->body(), LiveElements(*moving)).empty());
}

TEST_P(LooseParts, KeepALoneElementAndALoneMassInSight) {
  const auto moving =
      make_body_model(body_of(fragile(GetParam(), Recipe::box(90, 90, 90))), Precision::double_);
  const Lattice& lattice = moving->body().lattice;
  const Index first = lattice.mass_at({4, 4, 4});
  const Index other = lattice.mass_at(Vec3i(4, 4, 4) + half_directions(lattice.kind)[0]);
  const Index alone = lattice.mass_at({8, 8, 8});
  pull(*moving, {first, other});
  moving->place(alone, Vec3(0, 1, 0), Vec3::Zero());
  moving->advance({.dt = 1e-9, .watch = true}, {});
  const LiveElements live(*moving);
  const auto parts = loose_parts(moving->body(), live);
  ASSERT_EQ(parts.size(), 2u);
  for (const auto& part : parts) {
    if (part[0] == part[1]) {
      EXPECT_EQ(part[0], alone);
    } else {
      EXPECT_EQ(std::minmax(part[0], part[1]), std::minmax(first, other));
    }
  }
  Surface surface = make_surface(*moving, std::nullopt, 0);
  const std::size_t facets = surface.facets.size(), moving_before = surface.n_moving();
  add_loose_parts(moving->body(), live, std::nullopt, 0xFF010203, surface);
  EXPECT_EQ(surface.facets.size(), facets + 2);
  EXPECT_EQ(surface.rgba.size(), facets + 2);
  EXPECT_EQ(count_loose(surface), 2u);
  EXPECT_EQ(surface.n_moving(), moving_before + 3);
  for (std::size_t f = facets; f < surface.facets.size(); ++f)
    for (const auto corner : surface.facets[f])
      EXPECT_GT(surface.position(corner, *moving).maxCoeff(), 0.9) << "where the masses are now";
}

}  // namespace
}  // namespace palpate::physics
