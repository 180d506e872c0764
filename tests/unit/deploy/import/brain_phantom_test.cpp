// The made brain: one piece, folded, with white matter inside, and the same from a scene.
#include "deploy/import/brain_phantom.h"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <filesystem>

#include "common/math/units.h"
#include "common/record/slice_stack.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/body.h"
#include "tests/support/image/bytes.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::test {
namespace {

using testing::HasSubstr;

constexpr int tissue_from = 90, white_from = 165;

BodySpec brain_body(const std::string& folder) {
  BodySpec spec;
  spec.name = "brain";
  spec.lattice = LatticeKind::voxel;
  spec.material = "grey";
  VolumeShape shape;
  shape.slices.emplace();
  for (int k = 0; k < brain_planes; ++k)
    shape.slices->files.push_back(fmt::format("{}/slice_{:02}.png", folder, k));
  shape.slices->spacing = Vec3(brain_pixel_mm, brain_pixel_mm, brain_plane_mm) * m_from_mm(1);
  shape.keep_min = tissue_from;
  shape.keep_max = 255;
  spec.shape = shape;
  spec.regions.push_back({"white", IntensityRegion{white_from, 255}, {}});
  return spec;
}

std::vector<MaterialSpec> grey_and_white() {
  MaterialSpec grey, white;
  grey.name = "grey";
  grey.density = white.density = 1000;
  grey.modulus = 1e3;
  white.modulus = 2e3;
  white.name = "white";
  return {grey, white};
}

class BrainPhantom : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    outcome_ = new Outcome(run_importer({"--phantom", "brain", "--out", brain()}));
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete outcome_;
  }
  static std::string brain() { return *folder_ / "brain"; }
  static ScratchFolder* folder_;
  static Outcome* outcome_;
};
ScratchFolder* BrainPhantom::folder_ = nullptr;
Outcome* BrainPhantom::outcome_ = nullptr;

TEST_F(BrainPhantom, IsAFolderOfSlices) {
  EXPECT_EQ(outcome_->code, 0) << outcome_->err;
  EXPECT_THAT(outcome_->out,
              HasSubstr("48 slices of 96 x 112 pixels, pixel_mm = [1.8, 1.8], plane_mm = 3.5, written to"));
  const auto slices = brain_phantom();
  ASSERT_EQ(slices.size(), 48u);
  EXPECT_EQ(read_grey_png(brain() + "/slice_24.png").value, slices[24].value) << "the same every time";
  EXPECT_FALSE(std::filesystem::exists(brain() + "/slice_48.png"));
}

TEST_F(BrainPhantom, IsOnePieceOfGreyRoundWhite) {
  const physics::Cells cells = physics::make_cells(brain_body(brain()));
  physics::Cells largest = cells;
  physics::keep_largest_component(largest);
  EXPECT_GT(static_cast<double>(largest.n_filled()), 0.99 * static_cast<double>(cells.n_filled()));
  const double litres = 1e3 * static_cast<double>(cells.n_filled()) * cells.spacing.prod();
  EXPECT_TRUE(litres > 1.0 && litres < 1.5) << litres << " l, as a grown-up's";
  std::size_t grey = 0, grey_outside = 0, white = 0, white_outside = 0;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        if (!cells.is_filled(i, j, k)) continue;
        const bool outside = !cells.is_filled(i - 1, j, k) || !cells.is_filled(i + 1, j, k) ||
                             !cells.is_filled(i, j - 1, k) || !cells.is_filled(i, j + 1, k);
        const bool is_white = cells.intensity[cells.index(i, j, k)] >= white_from;
        (is_white ? white : grey) += 1;
        (is_white ? white_outside : grey_outside) += outside ? 1 : 0;
      }
  EXPECT_GT(static_cast<double>(grey_outside) / static_cast<double>(grey),
            3 * static_cast<double>(white_outside) / static_cast<double>(white))
      << "grey is the rind";
  for (int k = 30; k < 40; ++k)
    EXPECT_FALSE(cells.is_filled(48, 100, k) && cells.is_filled(47, 100, k)) << "the fissure, plane " << k;
}

TEST_F(BrainPhantom, IsABodyOnBothLattices) {
  BodySpec spec = brain_body(brain());
  std::get<VolumeShape>(spec.shape).largest_component = true;
  std::get<VolumeShape>(spec.shape).partition = {{24, 28, 24}};
  const physics::Body voxels = physics::build_body(spec, grey_and_white());
  EXPECT_EQ(voxels.laws.size(), 2u);
  std::get<VolumeShape>(spec.shape).partition.reset();
  spec.lattice = LatticeKind::fcc;
  spec.spacing = 0.008;
  const physics::Body fcc = physics::build_body(spec, grey_and_white());
  ASSERT_EQ(fcc.laws.size(), 2u);
  // A mass of fcc stands for L^3 / sqrt(2) of tissue.
  const double litres =
      1e3 * static_cast<double>(fcc.lattice.n_masses()) * physics::volume_per_mass(fcc.lattice);
  EXPECT_TRUE(litres > 1.0 && litres < 1.5) << litres << " l";
  std::size_t white = 0;
  for (const physics::Index cell : fcc.lattice.masses) {
    const auto n = static_cast<std::size_t>(cell);
    EXPECT_GE(fcc.intensity[n], tissue_from);
    EXPECT_EQ(fcc.law_of[n] == 1, fcc.intensity[n] >= white_from);
    white += fcc.law_of[n];
  }
  EXPECT_GT(white, fcc.lattice.masses.size() / 4);
}

TEST_F(BrainPhantom, RefusesWhatDoesNotFit) {
  const auto sized = run_importer({"--phantom", "brain", "--size", "9,9,9", "--out", brain()});
  EXPECT_EQ(sized.code, 2);
  EXPECT_THAT(sized.err, HasSubstr("leave out --size, --partition and --transfer"));
  const auto nowhere = run_importer({"--phantom", "brain", "--out", *folder_ / "none/none/brain"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("is no folder and cannot be made; name a folder"));
  write_file(*folder_ / "file", "x");
  EXPECT_EQ(run_importer({"--phantom", "brain", "--out", *folder_ / "file"}).code, 2);
  EXPECT_EQ(file_bytes(*folder_ / "file"), "x");
}

}  // namespace
}  // namespace palpate::test
