#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/record/volume.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/image/small_images.h"

namespace palpate::test {
namespace {

TEST(ImportOptions, QuietSaysNothing) {
  const ScratchFolder folder;
  write_file(folder / "a.nii", nifti());
  const Outcome outcome = run_importer({folder / "a.nii", "--out", folder / "v.h5", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(ImportOptions, PartitionResamplesAndRemembersTheSourceSize) {
  const ScratchFolder folder;
  write_file(folder / "a.nii", nifti());
  ASSERT_EQ(run_importer({folder / "a.nii", "--out", folder / "whole.h5"}).code, 0);
  ASSERT_EQ(run_importer({folder / "a.nii", "--out", folder / "v.h5", "--partition", "2,8,3"}).code, 0);
  const Volume volume = read_volume(folder / "v.h5");
  EXPECT_EQ(volume.size, (std::array<int, 3>{2, 8, 3}));
  EXPECT_EQ(volume.source_size, (std::array<int, 3>{5, 4, 3}));
  EXPECT_TRUE(volume.spacing.isApprox(Eigen::Vector3d(1.25e-3, 3.75e-4, 2e-3), 1e-12));
  EXPECT_EQ(volume.intensity, resample(read_volume(folder / "whole.h5"), {2, 8, 3}).intensity);
}

TEST(ImportOptions, ColoursFollowTheRangeUnlessGiven) {
  const ScratchFolder folder;
  write_file(folder / "a.nii", nifti());  // -1000 to 1328: looks like CT
  const auto points = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {folder / "a.nii", "--out", folder / "v.h5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_importer(arguments).code, 0);
    return read_volume(folder / "v.h5").transfer;
  };
  EXPECT_EQ(points({}).size(), ct_transfer().size());
  EXPECT_EQ(points({"--transfer", "ct"}).size(), ct_transfer().size());
  const auto grey = points({"--transfer", "grey"});
  ASSERT_EQ(grey.size(), 2u);
  EXPECT_EQ(grey[0].intensity, -1000);
  EXPECT_EQ(grey[1].intensity, 1328);
}

/// Two halves of 2 x 4 x 4 cells of 10 mm each.
TEST(ImportOptions, KeepGivenAgainMakesAnotherRegion) {
  const ScratchFolder folder;
  Bytes cells;
  for (int n = 0; n < 64; ++n) cells += n % 4 < 2 ? '\x28' : '\x55';  // 40, 85
  write_file(folder / "a.raw", cells);
  const auto run = [&](const std::vector<std::string>& keeps) {
    std::vector<std::string> all = {"--size", "4,4,4",           "--spacing-mm", "10,10,10", "--type",
                                    "uint8",  "--tetrahedra-mm", "10",           "--out",    folder / "m.h5"};
    all.insert(all.begin(), folder / "a.raw");
    all.insert(all.end(), keeps.begin(), keeps.end());
    return run_importer(all);
  };
  const Outcome outcome = run({"--keep", "40,40", "--keep", "85,85"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              testing::ContainsRegex("of tissue, region 0: [0-9.]+ of 32, region 1: [0-9.]+ of 32, "));
  EXPECT_THAT(run({"--keep", "40,80", "--keep", "80,85"}).err,
              testing::HasSubstr("--keep: given again names other intensities: a cell is of one tissue"));
  EXPECT_EQ(run({"--keep", "40,40", "--keep", "85"}).code, 2);
  EXPECT_EQ(run({"--keep", "40,40", "--keep", "85,41"}).code, 2);
}

TEST(ImportOptions, HelpIsNoMistake) {
  const Outcome outcome = run_importer({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::HasSubstr("--partition"));
}

TEST(ImportOptions, NothingIsLeftBesideTheVolume) {
  const ScratchFolder folder;
  write_file(folder / "a.nii", nifti());
  ASSERT_EQ(run_importer({folder / "a.nii", "--out", folder / "v.h5"}).code, 0);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename());
  EXPECT_THAT(names, testing::UnorderedElementsAre("a.nii", "v.h5"));
}

}  // namespace
}  // namespace palpate::test
