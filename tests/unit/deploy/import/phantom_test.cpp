// The made angiogram: its centre of gravity lies in the aneurysm, and a smaller one is cut from a larger.
#include "deploy/import/phantom.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "common/scene/shape_spec.h"
#include "physics_node/body/deformable.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::test {
namespace {

using physics::Cells;
using testing::HasSubstr;

/// The vessels as a scene keeps them.
Cells kept_cells(const Volume& volume) {
  Cells cells;
  cells.size = {volume.size[0], volume.size[1], volume.size[2]};
  cells.spacing = volume.spacing;
  for (const float value : volume.intensity) cells.filled.push_back(value >= 220 ? 1 : 0);
  return cells;
}

TEST(AneurysmPhantom, DeformsFiveThousandVoxelsRoundItsCentreOfGravity) {
  const Volume volume = aneurysm_phantom(phantom_size);
  Cells cells = kept_cells(volume);
  const std::size_t all = cells.n_filled();
  EXPECT_EQ(physics::keep_largest_component(cells), 1) << "noise makes no vessel, and no vessel hangs loose";
  EXPECT_EQ(cells.n_filled(), all);
  const Eigen::Vector3i centre = physics::gravity_cell(cells);
  const Eigen::Vector3d from_sac =
      cells.spacing.cwiseProduct((centre - Eigen::Vector3i(168, 168, 70)).cast<double>());
  EXPECT_LT(from_sac.norm(), 2e-3);
  DeformableRegion region{false, {}, 10};
  region.gravity_center = true;
  mark_deformable(cells, region);
  EXPECT_GE(cells.n_deformable(), 5000u);
  EXPECT_LT(static_cast<double>(all), 0.01 * static_cast<double>(volume.n_cells()))
      << "vessels in dark tissue";
}

TEST(AneurysmPhantom, IsBrightInsideDarkOutsideAndSmoothBetween) {
  const Volume volume = aneurysm_phantom({64, 64, 64});
  EXPECT_NEAR(static_cast<double>(volume.at(32, 32, 32)), 400, 50);
  EXPECT_NEAR(static_cast<double>(volume.at(2, 60, 60)), 60, 50);
  const auto between = std::count_if(volume.intensity.begin(), volume.intensity.end(),
                                     [](float v) { return v > 120 && v < 300; });
  EXPECT_GT(between, 1000) << "walls fill a part of a voxel";
  for (const double h : volume.spacing) EXPECT_TRUE(h > 0.3e-3 && h < 1e-3) << "as angiograms have";
}

TEST(AneurysmPhantom, OfAnotherSizeIsTheSameRoundItsMiddle) {
  const Volume small = aneurysm_phantom({24, 20, 16});
  const Volume large = aneurysm_phantom({41, 50, 33});
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 24; ++i)
        ASSERT_EQ(small.at(i, j, k), large.at(i - 12 + 20, j - 10 + 25, k - 8 + 16))
            << i << ' ' << j << ' ' << k;
}

TEST(AneurysmPhantom, IsWrittenByTheImporter) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_importer({"--phantom", "aneurysm", "--size", "40,36,30", "--out", folder / "p.h5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("phantom aneurysm: 40 x 36 x 30 cells of 0.48 x 0.48 x 0.6 mm"));
  const Volume volume = read_volume(folder / "p.h5");
  EXPECT_EQ(volume.intensity, aneurysm_phantom({40, 36, 30}).intensity);
  EXPECT_EQ(volume.source, "phantom aneurysm");
  ASSERT_EQ(run_importer({"--phantom", "aneurysm", "--size", "40,36,30", "--partition", "20,36,30", "--out",
                          folder / "q.h5"})
                .code,
            0);
  EXPECT_EQ(read_volume(folder / "q.h5").size, (std::array<int, 3>{20, 36, 30}));
}

TEST(LobePhantom, IsWrittenByTheImporter) {
  const ScratchFolder folder;
  const Outcome outcome = run_importer({"--phantom", "lobe", "--out", folder / "lobe.msh"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("phantom lobe: 6336 tetrahedra, 1428 nodes, dihedral angles 19 to 147 degrees"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "lobe.msh"));
  EXPECT_EQ(run_importer({"--phantom", "lobe", "--size", "9,9,9", "--out", folder / "lobe.msh"}).code, 2);
}

TEST(AneurysmPhantom, IsNotMixedUpWithAnImage) {
  const ScratchFolder folder;
  const auto complaint = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--out", folder / "p.h5"});
    const Outcome outcome = run_importer(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(complaint({}), HasSubstr("image, or --phantom aneurysm"));
  EXPECT_THAT(complaint({"--phantom", "heart"}), HasSubstr("aneurysm"));
  EXPECT_THAT(complaint({"scan.nii", "--phantom", "aneurysm"}), HasSubstr("excludes"));
  EXPECT_THAT(complaint({"--phantom", "aneurysm", "--spacing-mm", "1,1,1"}), HasSubstr("excludes"));
  EXPECT_THAT(complaint({"--phantom", "aneurysm", "--size", "0,3,3"}), HasSubstr("--size"));
}

}  // namespace
}  // namespace palpate::test
