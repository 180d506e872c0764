#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <limits>
#include <random>

#include "common/error/error.h"
#include "common/record/volume.h"
#include "tests/support/image/bytes.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

using test::ScratchFolder;

Volume sample() {
  Volume volume;
  volume.size = {4, 3, 2};
  volume.spacing = {0.001, 0.0015, 0.002};
  volume.origin = {-0.1, 0.25, 0};
  volume.orientation = Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix();
  for (int i = 0; i < 24; ++i) volume.intensity.push_back(static_cast<float>(100 * i - 1000));
  volume.transfer = {{-1000, {0, 0, 0, 0}}, {0, {0.5, 0.25, 0.125, 1}}, {1300, {1, 1, 1, 1}}};
  volume.source = "head.inv3";
  volume.source_checksum = 0xfedcba9876543210;
  volume.source_size = {8, 6, 4};
  return volume;
}

TEST(VolumeFile, ComesBackAsItWas) {
  const ScratchFolder folder;
  const Volume a = sample();
  write_volume(a, folder / "v.h5");
  const Volume b = read_volume(folder / "v.h5");
  EXPECT_EQ(b.size, a.size);
  EXPECT_EQ(b.spacing, a.spacing);
  EXPECT_EQ(b.origin, a.origin);
  ASSERT_TRUE(b.orientation);
  EXPECT_EQ(*b.orientation, *a.orientation);
  EXPECT_EQ(b.intensity, a.intensity);
  EXPECT_EQ(b.source, a.source);
  EXPECT_EQ(b.source_checksum, a.source_checksum);
  EXPECT_EQ(b.source_size, a.source_size);
  ASSERT_EQ(b.transfer.size(), a.transfer.size());
  for (std::size_t i = 0; i < a.transfer.size(); ++i) {
    EXPECT_EQ(b.transfer[i].intensity, a.transfer[i].intensity);
    EXPECT_EQ(b.transfer[i].rgba, a.transfer[i].rgba);
  }
}

TEST(VolumeFile, RemembersThatTheOrientationIsUnknown) {
  const ScratchFolder folder;
  Volume volume = sample();
  volume.orientation.reset();
  write_volume(volume, folder / "v.h5");
  EXPECT_FALSE(read_volume(folder / "v.h5").orientation);
}

TEST(VolumeFile, StoresWholeNumbersInTwoBytesAndOthersInFour) {
  const ScratchFolder folder;
  Volume volume = sample();
  volume.size = {40, 40, 40};
  volume.intensity.clear();
  std::mt19937_64 random(1);  // noise over all of int16 cannot be deflated
  for (int i = 0; i < 64'000; ++i)
    volume.intensity.push_back(static_cast<float>(random() & 0xFFFFu) - 32768.0f);
  write_volume(volume, folder / "v.h5");
  EXPECT_LT(std::filesystem::file_size(folder / "v.h5"), 64'000u * 2 + 8'000);
  EXPECT_EQ(read_volume(folder / "v.h5").intensity, volume.intensity);
  for (const float value : {0.5f, 32768.0f, -32769.0f}) {
    volume.intensity[5] = value;
    write_volume(volume, folder / "v.h5");
    EXPECT_GT(std::filesystem::file_size(folder / "v.h5"), 64'000u * 2 + 8'000);
    EXPECT_EQ(read_volume(folder / "v.h5").intensity, volume.intensity);
  }
}

TEST(VolumeFile, FailureLeavesTheOldFileAndNothingBeside) {
  const ScratchFolder folder;
  test::write_file(folder / "v.h5", "the old one");
  Volume volume = sample();
  volume.intensity[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_volume(volume, folder / "v.h5"), InputError);
  EXPECT_EQ(test::file_bytes(folder / "v.h5"), "the old one");
  EXPECT_FALSE(std::filesystem::exists(folder / "v.h5.part"));
}

// The disk takes no more than 20 kB, in a process of its own.
TEST(VolumeFile, AFullDiskIsSaidAndLeavesTheOldFile) {
  const ScratchFolder folder;
  test::write_file(folder / "v.h5", "the old one");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {20'000, 20'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    Volume volume = sample();
    volume.size = {40, 40, 40};
    std::mt19937_64 random(1);
    volume.intensity.clear();
    for (int i = 0; i < 64'000; ++i) volume.intensity.push_back(static_cast<float>(random() & 0xFFFFu));
    try {
      write_volume(volume, folder / "v.h5");
      _exit(1);
    } catch (const InputError&) {
      _exit(42);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(test::file_bytes(folder / "v.h5"), "the old one");
  EXPECT_FALSE(std::filesystem::exists(folder / "v.h5.part"));
}

TEST(VolumeFile, ReplacesAnOldFileWhole) {
  const ScratchFolder folder;
  test::write_file(folder / "v.h5", "the old one");
  write_volume(sample(), folder / "v.h5");
  EXPECT_EQ(read_volume(folder / "v.h5").intensity, sample().intensity);
  EXPECT_FALSE(std::filesystem::exists(folder / "v.h5.part"));
}

TEST(VolumeFile, CannotBeWrittenWhereThereIsNoPlace) {
  const ScratchFolder folder;
  test::write_file(folder / "file", "x");
  for (const std::string& path :
       {folder / "none/v.h5", folder / "file/v.h5", folder.path(), std::string("/proc/v.h5"), std::string()})
    EXPECT_THROW(write_volume(sample(), path), InputError) << path;
}

}  // namespace
}  // namespace palpate
