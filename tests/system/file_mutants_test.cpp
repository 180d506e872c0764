// Damaged records and volumes: whatever opens them ends by itself, with a line, and takes no memory for what
// is not there.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/support/guarded_run.h"
#include "tests/support/image/bytes.h"
#include "tests/support/mutate.h"
#include "tests/system/command_run.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using test::Guarded;

constexpr std::size_t superblock = 48;  // of a record [bytes]. HDF5 File Format Specification 3.0, II.A
constexpr double memory = 0.5e9;        // such small files need less than a fifth of it

class FileMutants : public CommandRun {
 protected:
  /// Runs `palpate WORDS` on a damaged file and looks how it ends. @return exit code
  int expect_sound_end(const std::vector<std::string>& words) {
    std::vector<std::string> all = {PALPATE};
    all.insert(all.end(), words.begin(), words.end());
    const Guarded run = test::run_guarded(all, folder / "log");
    EXPECT_FALSE(run.hung) << words[0];
    EXPECT_THAT(run.code, testing::AnyOf(0, 2)) << words[0] << ": " << run.text;
    EXPECT_LT(static_cast<double>(run.peak_bytes), memory) << words[0];
    if (run.code == 2) {
      EXPECT_EQ(std::count(run.text.begin(), run.text.end(), '\n'), 1) << run.text;
    }
    return run.code;
  }
};

constexpr const char* scene = R"(title = "Small"
[scene]
seconds = 0.05
[[body]]
name = "cube"
shape = "box"
size_mm = [8, 8, 8]
spacing_mm = 2
material = "gel"
[material.gel]
density_kg_per_m3 = 1000
modulus_kPa = 5
[floor]
height_mm = -10
[record]
what = ["positions", "forces", "energy"]
)";

TEST_F(FileMutants, OfARecordEndInfoAndReplay) {
  test::write_file(folder / "s.toml", scene);
  ASSERT_EQ(
      palpate("simulate " + (folder / "s.toml").string() + " --no-frames --out " + (folder / "out").string()),
      0)
      << log;
  const std::string whole = test::file_bytes(folder / "out/record.h5"), path = folder / "m.h5";
  test::write_file(path, whole);
  ASSERT_EQ(expect_sound_end({"info", path}), 0);
  ASSERT_EQ(expect_sound_end({"replay", path}), 0);
  // one byte of every place in the superblock, then anything anywhere
  for (std::size_t at = 0; at < superblock; ++at) {
    SCOPED_TRACE("superblock, byte " + std::to_string(at));
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at * 5 % 8)));
    test::write_file(path, bytes);
    EXPECT_EQ(expect_sound_end({"info", path}), 2);
    EXPECT_EQ(expect_sound_end({"replay", path}), 2);
    EXPECT_EQ(expect_sound_end({"info", "--mend", path}), 2);
  }
  for (std::uint64_t seed = 1; seed <= 120 - superblock; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::write_file(path, test::mutant(whole, seed, seed % 2 == 0 ? 4096 : SIZE_MAX));
    expect_sound_end({"info", path});
    expect_sound_end({"replay", path});
  }
}

TEST_F(FileMutants, OfAVolumeEndInfo) {
  const std::string path = folder / "v.h5";
  ASSERT_EQ(palpate("import --phantom aneurysm --size 20,20,10 --out " + path), 0) << log;
  const std::string whole = test::file_bytes(path);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::write_file(path, test::mutant(whole, seed, seed % 2 == 0 ? 4096 : SIZE_MAX));
    expect_sound_end({"info", path});
  }
}

}  // namespace
}  // namespace palpate
