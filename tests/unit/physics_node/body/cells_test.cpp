#include "physics_node/body/cells.h"

#include <gmock/gmock.h>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;
using palpate::test::ScratchFolder;
using testing::HasSubstr;

std::size_t cells_in(const std::string& shape) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = shape;
  return make_cells(scene_of(recipe).bodies.front()).n_filled();
}

TEST(Cells, FillShapesByTheirCentres) {
  EXPECT_EQ(cells_in(Recipe::box(40, 40, 40)), 64u);
  EXPECT_EQ(cells_in(Recipe::sphere(20)),
            32u);  // centres at (5, 5, 5) and (15, 5, 5) mm and their mirror images
  for (const char* axis : {"x", "y", "z"})
    EXPECT_EQ(
        cells_in(std::string("shape = \"tube\"\nouter_radius_mm = 20\ninner_radius_mm = 10\nlength_mm = 30\n"
                             "axis = \"") +
                 axis + "\""),
        3 * 8u);
}

TEST(Cells, OfABodyThinnerThanHalfOfOneAreRefused) {
  const auto complaint = [](double thin_mm) -> std::string {
    Recipe recipe;
    recipe.lattice = "voxel";
    recipe.shape = Recipe::box(40, thin_mm, 40);
    try {
      body_of(recipe);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint(5.1), "none");
  EXPECT_THAT(complaint(4), HasSubstr("is 4 mm along y, less than half of a cell of 10 mm"));
}

TEST(Cells, AreCentredWhereTheBodyIs) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.body = "at_mm = [100, 200, 300]";
  const Cells cells = make_cells(scene_of(recipe).bodies.front());
  EXPECT_LT((cells.corner - Vec3(0.080, 0.180, 0.280)).norm(), 1e-12);
}

Cells row_of(const std::string& pattern) {
  Cells cells;
  cells.size = {static_cast<int>(pattern.size()), 1, 1};
  for (const char c : pattern) cells.filled.push_back(c == '#' ? 1 : 0);
  return cells;
}

TEST(Components, KeepOnlyTheLargest) {
  Cells cells = row_of("##.###.#");
  EXPECT_EQ(keep_largest_component(cells), 3);
  EXPECT_EQ(cells.filled, row_of("...###..").filled);
}

TEST(Components, AreNotJoinedByEdgesOrCorners) {
  Cells cells;
  cells.size = {2, 2, 2};
  cells.filled = {1, 0, 0, 1, 0, 0, 0, 0};
  EXPECT_EQ(keep_largest_component(cells), 2);
  EXPECT_EQ(cells.n_filled(), 1u);
}

TEST(Components, OfNothingAreNone) {
  Cells cells = row_of("....");
  EXPECT_EQ(keep_largest_component(cells), 0);
  EXPECT_EQ(cells.n_filled(), 0u);
}

class VolumeCells : public testing::Test {
 protected:
  std::string save(const Volume& volume) {
    const std::string path = folder_ / "made.h5";
    write_volume(volume, path);
    return path;
  }
  ScratchFolder folder_;
};

TEST_F(VolumeCells, KeepTheIntensityWindowWithBothEnds) {
  const auto path = save(made_volume({5, 4, 3}, [](int i, int, int) { return static_cast<float>(100 * i); }));
  const Cells cells = make_cells(volume_body(path, 100, 300));
  EXPECT_EQ(cells.n_filled(), 3 * 12u);
  EXPECT_FALSE(cells.is_filled(0, 0, 0));
  EXPECT_TRUE(cells.is_filled(1, 3, 2));
  EXPECT_TRUE(cells.is_filled(3, 0, 1));
  EXPECT_FALSE(cells.is_filled(4, 0, 0));
  EXPECT_EQ(cells.spacing, Vec3(0.002, 0.002, 0.002));
}

TEST_F(VolumeCells, KeepOnlyTheLargestComponentWhereAskedTo) {
  const auto path = save(made_volume({5, 1, 1}, [](int i, int, int) { return i == 1 ? 0.F : 100.F; }));
  BodySpec spec = volume_body(path, 50, 200);
  EXPECT_EQ(make_cells(spec).n_filled(), 4u);
  std::get<VolumeShape>(spec.shape).largest_component = true;
  EXPECT_EQ(make_cells(spec).n_filled(), 3u);
}

TEST_F(VolumeCells, DeformOnlyInTheRegionAskedFor) {
  const auto path = save(made_volume({9, 9, 9}, [](int, int, int) { return 100.F; }));
  BodySpec spec = volume_body(path, 50, 200);
  std::get<VolumeShape>(spec.shape).deformable = {false, {4, 4, 4}, 2};
  const Cells cells = make_cells(spec);
  EXPECT_EQ(cells.n_filled(), 729u);
  EXPECT_EQ(cells.n_deformable(), 125u);
  EXPECT_TRUE(cells.is_deformable(6, 2, 4));
  EXPECT_FALSE(cells.is_deformable(7, 4, 4));
}

TEST_F(VolumeCells, CutTheRegionAtTheEdgeOfTheImage) {
  const auto path = save(made_volume({9, 9, 9}, [](int, int, int) { return 100.F; }));
  BodySpec spec = volume_body(path, 50, 200);
  std::get<VolumeShape>(spec.shape).deformable = {false, {0, 0, 8}, 2};
  EXPECT_EQ(make_cells(spec).n_deformable(), 27u);
}

std::string complaint_about(const BodySpec& spec) {
  try {
    make_cells(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(VolumeCells, SayWhatTheImageHoldsWhenTheWindowIsEmpty) {
  const auto path = save(made_volume({3, 3, 3}, [](int i, int, int) { return static_cast<float>(10 * i); }));
  const auto text = complaint_about(volume_body(path, 500, 600));
  EXPECT_THAT(text, HasSubstr("keeps no voxel between 500 and 600"));
  EXPECT_THAT(text, HasSubstr("from 0 to 20"));
}

TEST_F(VolumeCells, SayThatTheRegionMissesTheTissue) {
  const auto path = save(made_volume({9, 1, 1}, [](int i, int, int) { return i < 3 ? 100.F : 0.F; }));
  BodySpec spec = volume_body(path, 50, 200);
  std::get<VolumeShape>(spec.shape).deformable = {false, {7, 0, 0}, 1};
  EXPECT_THAT(complaint_about(spec), HasSubstr("no deformable tissue"));
}

}  // namespace
}  // namespace palpate::physics
