#include "deploy/palpate/info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/record/volume.h"
#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {

using testing::HasSubstr;

Volume small_volume() {
  Volume volume;
  volume.size = {2, 3, 4};
  volume.spacing = {0.000957, 0.000957, 0.0015};
  volume.orientation = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 24; ++i) volume.intensity.push_back(static_cast<float>(i * 100 - 1000));
  volume.transfer = default_transfer(-1000, 1300);
  volume.source = "scan.inv3";
  volume.source_checksum = 0xabcdef;
  volume.source_size = {4, 6, 8};
  return volume;
}

TEST(Info, SaysWhatAVolumeHolds) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "v.h5").string();
  write_volume(small_volume(), path);
  ASSERT_TRUE(is_volume(path));
  const std::string text = info_volume(path);
  for (const char* words :
       {"2 x 3 x 4 cells (24)", "0.957 x 0.957 x 1.5 mm", "-1000 to 1300", "scan.inv3 (4 x 6 x 8 cells)",
        "0000000000abcdef", "x (1, 0, 0), y (0, 1, 0), z (0, 0, 1) in LPS"}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
}

TEST(Info, ListsTheDatasetsOfARecord) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "record.h5").string();
  const std::vector<double> numbers(12, 1.0);
  {
    Hdf5File file(path, Hdf5File::Mode::create);
    file.write("/frames/positions", {4, 3}, numbers.data());
    file.write("/time", {12}, numbers.data());
  }
  EXPECT_FALSE(is_volume(path));
  EXPECT_THAT(info_record(path), HasSubstr("4 x 3        /frames/positions\n12           /time\n"));
}

TEST(Info, RefusesAFileThatIsNotHdf5) {
  const test::TemporaryFolder folder;
  folder.write("v.h5", "text");
  EXPECT_THROW(is_volume((folder / "v.h5").string()), InputError);
  EXPECT_THROW(info_record((folder / "v.h5").string()), InputError);
}

/// A cube of gel and one tool. @param tool  its keys
std::string cube_with(const std::string& tool) {
  return R"([material.gel]
density_kg_per_m3 = 1000.0
modulus_kPa = 10
[[body]]
name = "cube"
shape = "box"
size_mm = [20, 20, 20]
lattice = "voxel"
spacing_mm = 5
material = "gel"
[[tool]]
device = "hand"
)" + tool +
         R"(
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 30], [3, 0, 0, 8]]
)";
}

TEST(Info, SaysWhatASceneHolds) {
  const test::TemporaryFolder folder;
  folder.write("cube.toml", "title = \"A cube\"\n" + cube_with("name = \"finger\""));
  const std::string text = info_scene((folder / "cube.toml").string());
  for (const char* words :
       {"A cube", "cube: box of 20 x 20 x 20 mm, voxel lattice of 5 mm, material gel",
        "gel: 1000 kg/m^3, modulus 10 kPa", "finger: radius 3 mm, 400 N/m, device hand (driver simulated)",
        "lasts        4 s"}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
}

/// From z = 30 to 8 mm in 3 s: the face at 10 mm is met after 20 / 22 of that. A path that ends above it never meets
/// it.
TEST(Info, SaysWhenAPathTouchesOrThatItNeverDoes) {
  const test::TemporaryFolder folder;
  std::string held = cube_with("name = \"finger\"");
  held.insert(held.find("material = \"gel\""), "fixed = [\"-z\"]\n");
  folder.write("held.toml", held);
  EXPECT_THAT(info_scene((folder / "held.toml").string()),
              HasSubstr("touch        finger meets cube after 2.727 s at (0, 0, 10) mm\n"));
  folder.write("above.toml", held.replace(held.find("[3, 0, 0, 8]"), 12, "[3, 0, 0, 11]"));
  EXPECT_THAT(info_scene((folder / "above.toml").string()),
              HasSubstr("touch        finger: its path never meets a body at rest\n"));
}

/// What physics would refuse is refused, and not a remark below figures of a scene that cannot run.
TEST(Info, RefusesASceneThatPhysicsCouldNotLoad) {
  const test::TemporaryFolder folder;
  folder.write("stick.toml",
               "[physics]\nintegrator = \"backward_euler\"\n" +
                   cube_with("name = \"rod\"\nshape = \"stick\"\nradius_mm = 4\nlength_mm = 40"));
  try {
    ADD_FAILURE() << info_scene((folder / "stick.toml").string());
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("backward_euler"));
  }
}

}  // namespace
}  // namespace palpate::deploy
