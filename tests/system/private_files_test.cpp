// What is made of a patient's image is as private as the image, and nothing that a person put into the folder is touched.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <vector>

#include "common/report/json_file.h"
#include "tests/support/image/bytes.h"
#include "tests/system/command_run.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene = R"(
[scene]
seconds = 0.06
[[body]]
name = "organ"
shape = "volume"
file = "v.h5"
keep = [50, 150]
material = "gel"
[material.gel]
density_kg_per_m3 = 1000
modulus_kPa = 5
[[tool]]
name = "tip"
shape = "point"
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]
[render]
size_px = [64, 48]
rate_Hz = 1000
most_frames = 10
[record]
what = ["positions", "forces", "energy"]
)";

class PrivateFiles : public CommandRun {
 protected:
  void SetUp() override {
    CommandRun::SetUp();
    before_ = umask(0022);
    fs::permissions(folder, fs::perms(0755));  // a temporary folder is private, and all in it would be
    test::write_file(folder / "a.raw", std::string(6 * 6 * 6, 'd'));
    test::write_file(folder / "s.toml", scene);
  }
  void TearDown() override {
    umask(before_);
    CommandRun::TearDown();
  }
  static mode_t mode_of(const fs::path& file) {
    struct stat facts {};
    EXPECT_EQ(stat(file.c_str(), &facts), 0) << file;
    return facts.st_mode & 0777;
  }
  int import_raw() {
    return palpate("import " + (folder / "a.raw").string() +
                   " --size 6,6,6 --spacing-mm 2,2,2 --type uint8 --out " + (folder / "v.h5").string());
  }
  int simulate() {
    return palpate("simulate " + (folder / "s.toml").string() + " --out " + (folder / "out").string());
  }
  /// All files in the folder of the run.
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out"))
      if (entry.is_regular_file()) found.push_back(entry.path());
    return found;
  }

 private:
  mode_t before_ = 0;
};

TEST_F(PrivateFiles, AreThoseMadeOfAPrivateImage) {
  ASSERT_EQ(chmod((folder / "a.raw").c_str(), 0600), 0);
  ASSERT_EQ(import_raw(), 0) << log;
  EXPECT_EQ(mode_of(folder / "v.h5"), 0600u);
  ASSERT_EQ(simulate(), 0) << log;
  EXPECT_GT(files().size(), 12u);  // record and its companions, summary, traces, plots, pictures
  for (const auto& file : files()) EXPECT_EQ(mode_of(file), 0600u) << file;
  // plots drawn again, and the session run again from its record
  ASSERT_EQ(palpate("plot " + (folder / "out").string()), 0) << log;
  ASSERT_EQ(palpate("replay " + (folder / "out/record.h5").string() + " --frames --out " +
                    (folder / "out/again").string()),
            0)
      << log;
  EXPECT_TRUE(fs::exists(folder / "out/again/record.h5"));
  fs::create_directories(folder / "out/shown");
  ASSERT_EQ(
      palpate("export " + (folder / "out/record.h5").string() + " --out " + (folder / "out/shown").string()),
      0)
      << log;
  for (const auto& file : files()) EXPECT_EQ(mode_of(file), 0600u) << file;
}

/// The image is open to all who reach it, and nobody does.
TEST_F(PrivateFiles, AreThoseMadeOfAnImageInAPrivateFolder) {
  fs::create_directories(folder / "mine");
  fs::rename(folder / "a.raw", folder / "mine/a.raw");
  ASSERT_EQ(chmod((folder / "mine").c_str(), 0700), 0);
  ASSERT_EQ(palpate("import " + (folder / "mine/a.raw").string() +
                    " --size 6,6,6 --spacing-mm 2,2,2 --type uint8 --out " + (folder / "v.h5").string()),
            0)
      << log;
  EXPECT_EQ(mode_of(folder / "v.h5"), 0600u);
  ASSERT_EQ(simulate(), 0) << log;
  for (const auto& file : files()) EXPECT_EQ(mode_of(file), 0600u) << file;
}

TEST_F(PrivateFiles, AreOpenWhereTheImageIs) {
  ASSERT_EQ(import_raw(), 0) << log;
  EXPECT_EQ(mode_of(folder / "v.h5"), 0644u);
  ASSERT_EQ(simulate(), 0) << log;
  for (const auto& file : files()) EXPECT_EQ(mode_of(file), 0644u) << file;
}

TEST_F(PrivateFiles, AndLinksAndAPersonsPicturesStayAsTheyAre) {
  ASSERT_EQ(import_raw(), 0) << log;
  const fs::path out = folder / "out";
  fs::create_directories(out / "frames");
  const std::vector<std::string> links = {"record.h5", "summary.json", "tool_tip.csv", "energy.csv",
                                          "force.png", "energy.png",   "record.pvd"};
  for (const auto& name : links) {
    test::write_file(folder / ("mine_" + name), "mine");
    fs::create_symlink(folder / ("mine_" + name), out / name);
  }
  test::write_file(out / "frames/frame_00001.png", "mine");
  test::write_file(out / "frames/holiday.png", "mine");
  for (int run = 0; run < 2; ++run) {
    ASSERT_EQ(simulate(), 0) << log;
    for (const auto& name : links) {
      EXPECT_EQ(test::file_bytes(folder / ("mine_" + name)), "mine") << name;
      EXPECT_FALSE(fs::is_symlink(out / name)) << name;
    }
    EXPECT_EQ(test::file_bytes(out / "frames/frame_00001.png"), "mine");
    EXPECT_EQ(test::file_bytes(out / "frames/holiday.png"), "mine");
  }
  // 60 pictures were due, ten may lie there
  const auto render = read_json((out / "summary.json").string())["render"];
  const auto pictures = std::distance(fs::directory_iterator(out / "frames"), {}) - 2;
  EXPECT_LE(pictures, 10);
  EXPECT_GE(pictures, 5);
  EXPECT_EQ(render["frames"].get<long>(), pictures);
  EXPECT_EQ(render["frames_left_out"].get<long>(), 60 - pictures);
  EXPECT_EQ(render["frames_every"].get<int>(), 8);
  EXPECT_THAT(log, testing::HasSubstr(
                       "10 pictures of 200 MB may lie there (most_frames, most_frames_MB of [render])"));
}

}  // namespace
}  // namespace palpate
