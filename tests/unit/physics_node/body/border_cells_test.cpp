#include "physics_node/body/border_cells.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;

Recipe solid(const std::string& shape, const std::string& border_cells, double spacing_mm = 2) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.spacing_mm = spacing_mm;
  recipe.shape = shape;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10";
  recipe.body = "model = \"fem\"\nborder_cells = \"" + border_cells + "\"";
  return recipe;
}

double mass_of(const Body& body) {
  double sum = 0;
  for (const Index node : body.nodes()) sum += node_mass(body, node);
  return sum;
}

TEST(BorderCells, WeighWhatTheShapeWeighs) {
  const double ball = 1000 * 4 / 3.0 * std::numbers::pi * std::pow(0.0093, 3);
  EXPECT_NEAR(mass_of(body_of(solid(Recipe::sphere(9.3), "filled"))), ball, 2e-3 * ball);
  EXPECT_GT(std::abs(mass_of(body_of(solid(Recipe::sphere(9.3), "whole"))) - ball), 0.01 * ball);
  const std::string tube =
      "shape = \"tube\"\nouter_radius_mm = 10.7\ninner_radius_mm = 6.1\nlength_mm = 30\naxis = \"x\"";
  const double pipe = 1000 * 0.03 * std::numbers::pi * (std::pow(0.0107, 2) - std::pow(0.0061, 2));
  EXPECT_NEAR(mass_of(body_of(solid(tube, "filled"))), pipe, 2e-3 * pipe);
  // What is left over beyond whole cells: 0.65 of a cell at either end of 9.3 mm.
  EXPECT_NEAR(mass_of(body_of(solid(Recipe::box(9.3, 8, 8), "filled"))), 9.3 * 64e-6, 1e-3 * 9.3 * 64e-6);
}

/// Flat faces that lie across cells, wherever.
TEST(BorderCells, OfABoxWeighWhatItWeighsOnCellsOfAnySize) {
  for (const double spacing : {4.0, 3.333, 3.0, 2.4, 1.7})
    EXPECT_NEAR(mass_of(body_of(solid(Recipe::box(10, 10, 10), "filled", spacing))), 1e-3, 5e-6) << spacing;
}

TEST(BorderCells, OfABoxOfWholeCellsAreWhole) {
  const Body filled = body_of(solid(Recipe::box(8, 12, 16), "filled")),
             whole = body_of(solid(Recipe::box(8, 12, 16), "whole"));
  EXPECT_EQ(filled.lattice.masses, whole.lattice.masses);
  EXPECT_EQ(filled.solid->stiffness, whole.solid->stiffness);
  EXPECT_EQ(filled.solid->mass, whole.solid->mass);
}

/// They are seen where their centres lie in the shape, as whole ones are.
TEST(BorderCells, AreSeenByTheirCentres) {
  const Recipe recipe = solid(Recipe::sphere(9.3), "filled");
  const BodySpec spec = scene_of(recipe).bodies.front();
  const Cells cells = make_cells(spec);
  std::size_t unseen = 0;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        EXPECT_EQ(cells.is_filled(i, j, k), cells.centre_of(i, j, k).norm() <= 0.0093);
        if (!cells.is_filled(i, j, k) && cells.share_of(i, j, k) > 0) ++unseen;
      }
  EXPECT_GT(unseen, 100u);
  const Body body = body_of(recipe);
  std::size_t beyond = 0;
  for (const Index node : body.nodes()) beyond += body.lattice.is_beyond(node) ? 1 : 0;
  EXPECT_GT(beyond, 50u);
}

/// An image whose intensity rises by 100 a cell along x is tissue from 250 on, which is reached at three cells from its edge.
TEST(BorderCells, OfAnImageFollowTheIntensityBetweenItsCells) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({8, 3, 3}, [](int i, int, int) { return 100.F * static_cast<float>(i); }), path);
  for (const auto& [from, expected] : {std::pair{275.0, 0.75}, {320.0, 0.3}, {295.0, 0.55}}) {
    BodySpec spec = volume_body(path, from, 1000);
    spec.model = ElementModel::fem;
    spec.border.cells = BorderCells::filled;
    const Cells cells = make_cells(spec);
    // The border lies at from / 100 + 1/2 cells from the edge; a look in four finds it to an eighth.
    EXPECT_NEAR(static_cast<double>(cells.share_of(3, 1, 1)), expected, 0.126) << from;
    EXPECT_EQ(cells.share_of(4, 1, 1), 1.0F) << from;
    EXPECT_EQ(cells.share_of(7, 0, 0), 1.0F) << "at the edge of the image";
    EXPECT_EQ(cells.share_of(1, 1, 1), 0.0F) << from;
  }
}

/// What is bright but belongs to another piece does not come back as a border.
TEST(BorderCells, AreNotOfAPieceThatIsLeftOut) {
  const palpate::test::ScratchFolder folder;
  const std::string path = folder / "made.h5";
  write_volume(made_volume({9, 3, 3}, [](int i, int, int) { return i == 5 || i == 6 ? 40.F : 200.F; }), path);
  BodySpec spec = volume_body(path, 100, 1000);
  spec.model = ElementModel::fem;
  spec.border.cells = BorderCells::filled;
  std::get<VolumeShape>(spec.shape).largest_component = true;
  const Cells cells = make_cells(spec);
  EXPECT_EQ(cells.share_of(4, 1, 1), 1.0F);
  EXPECT_GT(cells.share_of(5, 1, 1), 0.0F);
  for (int i = 7; i < 9; ++i) EXPECT_EQ(cells.share_of(i, 1, 1), 0.0F) << i;
}

}  // namespace
}  // namespace palpate::physics
