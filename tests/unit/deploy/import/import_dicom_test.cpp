#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/math/hash.h"
#include "common/record/volume.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/image/small_images.h"

namespace palpate::test {
namespace {

namespace fs = std::filesystem;

/// Three slices whose file names run against their positions.
void write_series(const std::string& folder, const std::string& series = "1.2.826.0.1.3680043.2.1.1") {
  fs::create_directories(folder);
  for (int k = 0; k < nz; ++k)
    write_file(folder + "/" + series.back() + "_" + std::to_string(9 - k) + ".dcm",
               dicom({k, series, 10.0 + 2 * k}));
}

std::string complaint_of(const std::string& image, const std::string& out) {
  const Outcome outcome = run_importer({image, "--out", out});
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_FALSE(fs::exists(out));
  return outcome.err;
}

TEST(ImportDicom, ASeriesIsSortedByPositionAndRescaled) {
  const ScratchFolder folder;
  write_series(folder / "scan");
  write_file(folder / "scan/README", "not an image");
  for (const std::string& image : {folder / "scan", folder / "scan/", folder / "scan/1_8.dcm"}) {
    const Outcome outcome = run_importer({image, "--out", folder / "v.h5"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const Volume volume = read_volume(folder / "v.h5");
    EXPECT_EQ(volume.size, (std::array<int, 3>{nx, ny, nz}));
    EXPECT_TRUE(volume.spacing.isApprox(Eigen::Vector3d(5e-4, 7.5e-4, 2e-3), 1e-12));
    EXPECT_TRUE(volume.origin.isApprox(Eigen::Vector3d(1e-3, 2e-3, 10e-3), 1e-12));
    ASSERT_TRUE(volume.orientation);
    EXPECT_TRUE(volume.orientation->isIdentity(1e-12));
    EXPECT_EQ(volume.source, image.ends_with("dcm") ? "1_8.dcm" : "scan");
    std::uint64_t hash = hash_seed;
    for (int k = 0; k < nz; ++k) hash = hash_text(dicom({.k = k, .z_mm = 10.0 + 2 * k}), hash);
    EXPECT_EQ(volume.source_checksum, hash);
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) ASSERT_EQ(volume.at(i, j, k), value_at(i, j, k));
  }
}

TEST(ImportDicom, OneFileChoosesItsSeriesAmongSeveral) {
  const ScratchFolder folder;
  write_series(folder / "scan", "1.2.826.0.1.3680043.2.1.1");
  write_series(folder / "scan", "1.2.826.0.1.3680043.2.1.2");
  EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("2 series"));
  EXPECT_EQ(run_importer({folder / "scan/2_8.dcm", "--out", folder / "v.h5"}).code, 0);
  EXPECT_EQ(read_volume(folder / "v.h5").size[2], nz);
}

TEST(ImportDicom, AMissingSliceIsNoticed) {
  const ScratchFolder folder;
  write_series(folder / "scan");
  write_file(folder / "scan/1_1.dcm", dicom({.k = 2, .z_mm = 18}));  // 10, 12, 14, 18
  EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("give every slice once"));
}

TEST(ImportDicom, ASliceGivenTwiceIsNoticed) {
  const ScratchFolder folder;
  write_series(folder / "scan");
  write_file(folder / "scan/copy.dcm", dicom({.k = 1, .z_mm = 12}));
  EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("give every slice once"));
}

TEST(ImportDicom, ShearedSlicesAreRefused) {
  const ScratchFolder folder;
  fs::create_directories(folder / "scan");
  for (int k = 0; k < nz; ++k)
    write_file(folder / ("scan/" + std::to_string(k)),
               dicom({.k = k, .z_mm = 10.0 + 2 * k, .shear_mm = 0.5 * k}));
  EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("sheared"));
}

TEST(ImportDicom, ASingleSliceIsNoVolume) {
  const ScratchFolder folder;
  fs::create_directories(folder / "scan");
  write_file(folder / "scan/0.dcm", dicom({}));
  EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("single slice"));
}

TEST(ImportDicom, TruncatedFilesAreNamedWhereverTheyEnd) {
  const Bytes whole = dicom({.k = 1, .z_mm = 12});
  for (std::size_t n : {std::size_t{0}, std::size_t{100}, std::size_t{140}, whole.size() / 2,
                        whole.size() - 20, whole.size() - 1}) {
    const ScratchFolder folder;
    write_series(folder / "scan");
    write_file(folder / "scan/1_8.dcm", first_bytes(whole, n));
    EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("scan")) << n;
  }
}

TEST(ImportDicom, AFolderWithoutDicomIsSaid) {
  const ScratchFolder folder;
  fs::create_directories(folder / "scan");
  EXPECT_THAT(complaint_of(folder / "scan", folder / "v.h5"), testing::HasSubstr("no DICOM"));
}

}  // namespace
}  // namespace palpate::test
