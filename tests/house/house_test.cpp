// The house keeps its rules, and each rule catches its breach when one is planted in a copy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "tests/house/house_rules.h"
#include "tests/house/planted_house.h"

namespace palpate::house {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

fs::path source_root() {
  const char* root = std::getenv("PALPATE_SOURCE");
  return root == nullptr ? fs::current_path() : fs::path(root);
}

TEST(House, KeepsItsRules) {
  const auto root = source_root();
  ASSERT_GT(read_house(root).size(), 50u) << root << " is not the house";
  for (const auto& breach : house_breaches(root)) ADD_FAILURE() << breach;
}

TEST_F(PlantedHouse, RefusesIncludesAgainstTheDirection) {
  EXPECT_THAT(
      breach("physics_node/a.cpp", "\n#include \"haptic_node/device/x.h\"\n"),
      StartsWith(
          "physics_node/a.cpp:2: includes \"haptic_node/device/x.h\"; nodes never include each other"));
  EXPECT_THAT(breach("render_node/gl/a.h", "#include <physics_node/x.h>\n"),
              HasSubstr("nodes never include"));
  EXPECT_THAT(breach("haptic_node/a.h", "#  include \"render_node/x.h\"\n"),
              HasSubstr("nodes never include"));
  EXPECT_THAT(breach("common/a.h", "#include \"physics_node/x.h\"\n"),
              HasSubstr("common may not know physics_node"));
  EXPECT_THAT(breach("common/a.h", "#include \"deploy/x.h\"\n"), HasSubstr("common may not know deploy"));
  EXPECT_THAT(breach("idl/a.h", "#include \"common/x.h\"\n"), HasSubstr("idl may not know common"));
  EXPECT_THAT(breach("haptic_node/a.cpp", "#include \"tests/support/x.h\"\n"),
              HasSubstr("may not know tests"));
  EXPECT_THAT(breach("deploy/a.cpp", "#include \"bench/x.h\"\n"), HasSubstr("deploy may not know bench"));
  EXPECT_THAT(breach("physics_node/a.cpp", "#include \"body.h\"\n"),
              HasSubstr("write the path from the root"));
}

TEST_F(PlantedHouse, LetsIncludesFollowTheDirection) {
  EXPECT_TRUE(is_fine("tests/unit/a.cpp", "#include \"physics_node/x.h\"\n#include \"haptic_node/x.h\"\n"));
  EXPECT_TRUE(
      is_fine("deploy/palpate/a.cpp", "#include \"render_node/x.h\"\n#include \"deploy/import/x.h\"\n"));
  EXPECT_TRUE(is_fine("common/report/a.cpp", "#include \"palpate_commit.h\"\n// #include \"deploy/x.h\"\n"));
}

/// Inside its door a header is fine; in any other room it is one breach that names the door.
struct DoorCase {
  std::string header, inside, outside, named;
};
void PrintTo(const DoorCase& door, std::ostream* out) { *out << door.header << " in " << door.outside; }

class PlantedDoor : public PlantedHouse, public testing::WithParamInterface<DoorCase> {};

TEST_P(PlantedDoor, IsTheOnlyOne) {
  const auto& door = GetParam();
  const auto text = "// a file\n#include <" + door.header + ">\n";
  EXPECT_TRUE(is_fine(door.inside, text));
  EXPECT_THAT(breach(door.outside, text), StartsWith(door.outside + ":2: includes <" + door.header + ">; " +
                                                     door.named + " has its door in "));
}

INSTANTIATE_TEST_SUITE_P(
    House, PlantedDoor,
    testing::Values(
        DoorCase{"dds/dds.h", "common/wire/topic.h", "common/record/a.h", "DDS"},
        DoorCase{"dds/dds.h", "haptic_node/wire.cpp", "haptic_node/loop/a.cpp", "DDS"},
        DoorCase{"palpate.h", "common/wire/topic.cpp", "render_node/view/a.cpp", "DDS"},
        DoorCase{"hdf5.h", "common/record/a.cpp", "physics_node/a.cpp", "HDF5"},
        DoorCase{"png.h", "common/record/png_file.cpp", "common/record/volume.cpp", "PNG"},
        DoorCase{"png.h", "render_node/image/png_file.cpp", "deploy/import/main.cpp", "PNG"},
        DoorCase{"libdeflate.h", "render_node/image/packed_rows.cpp", "render_node/image/png_file.cpp",
                 "libdeflate"},
        DoorCase{"toml++/toml.h", "common/scene/a.cpp", "common/record/a.cpp", "toml++"},
        DoorCase{"toml++/toml.h", "common/scene/b.h", "tests/unit/a.cpp", "toml++"},
        DoorCase{"GLFW/glfw3.h", "render_node/ui/a.cpp", "render_node/view/a.cpp", "GL"},
        DoorCase{"epoxy/gl.h", "render_node/gl/a.cpp", "deploy/palpate/a.cpp", "GL"},
        DoorCase{"imgui.h", "render_node/ui/a.cpp", "render_node/main.cpp", "GL"},
        DoorCase{"EGL/egl.h", "render_node/gl/a.cpp", "common/time/a.cpp", "GL"},
        DoorCase{"itkImage.h", "deploy/import/read_itk.cpp", "deploy/import/read_raw.cpp", "ITK"},
        DoorCase{"archive.h", "deploy/import/a.cpp", "deploy/palpate/a.cpp", "libarchive"},
        DoorCase{"dlfcn.h", "haptic_node/device/a.cpp", "haptic_node/loop/a.cpp", "dlopen"},
        DoorCase{"dlfcn.h", "deploy/palpate/doctor.cpp", "deploy/palpate/run.cpp", "dlopen"},
        DoorCase{"dlfcn.h", "haptic_node/drivers/kit/a.cpp", "haptic_node/drivers/openhaptics/a.cpp",
                 "dlopen"},
        DoorCase{"spnav.h", "haptic_node/drivers/spacenav/a.cpp", "haptic_node/loop/a.cpp", "libspnav"},
        DoorCase{"igtlMessageHeader.h", "haptic_node/drivers/openigtlink/a.cpp", "common/a.cpp",
                 "OpenIGTLink"},
        DoorCase{"benchmark/benchmark.h", "bench/kernel/a.cpp", "tests/a.cpp", "Google Benchmark"},
        DoorCase{"nlohmann/json.hpp", "common/report/a.h", "haptic_node/proxy/a.h", "JSON"},
        DoorCase{"nlohmann/json.hpp", "haptic_node/loop/haptic_summary.h", "common/time/a.h", "JSON"}));

TEST_F(PlantedHouse, RefusesLongFiles) {
  std::string lines;
  for (int i = 0; i < 400; ++i) lines += "int x;\n";
  EXPECT_TRUE(is_fine("common/a.cpp", lines));
  EXPECT_THAT(breach("common/a.cpp", lines + "int y;\n"),
              StartsWith("common/a.cpp:401: a file of 401 lines"));
  EXPECT_THAT(breach("common/CMakeLists.txt", lines + "\n"), HasSubstr("401 lines"));
  EXPECT_TRUE(is_fine("LICENSE", lines + lines));
}

TEST_F(PlantedHouse, RefusesPromises) {
  EXPECT_THAT(breach("common/a.cpp",
                     "\n\n// TO"
                     "DO later\n"),
              StartsWith("common/a.cpp:3: "));
  EXPECT_THAT(breach("docs/a.md",
                     "FIX"
                     "ME\n"),
              HasSubstr("do it, or leave it out"));
}

TEST_F(PlantedHouse, RefusesFlagsThatChangeTheBits) {
  EXPECT_THAT(breach("cmake/a.cmake",
                     "add_compile_options(-f"
                     "fast-math)\n"),
              HasSubstr("changes the bits"));
  EXPECT_THAT(breach("CMakePresets.json",
                     "{\"a\": \"-O"
                     "fast\"}\n"),
              HasSubstr("changes the bits"));
}

TEST_F(PlantedHouse, RefusesPathsOfOneMachine) {
  EXPECT_THAT(breach("deploy/a.sh",
                     "cd /wo"
                     "rk/main\n"),
              HasSubstr("a path of one machine"));
  EXPECT_THAT(breach("README.md",
                     "in `/ho"
                     "me/somebody/x`\n"),
              HasSubstr("a path of one machine"));
  EXPECT_THAT(breach("bench/a.py",
                     "open('/tm"
                     "p/hapticlab/x')\n"),
              HasSubstr("a path of one machine"));
  EXPECT_TRUE(is_fine("docs/a.md", "homework/work/x, $HOME/x and /tmp/palpate_x\n"));
}

TEST_F(PlantedHouse, RefusesDataAndBinaries) {
  for (const auto* name :
       {"a.nii", "a.nii.gz", "a.dcm", "scenes/data/a.h5", "deploy/liba.so", "liba.so.1.2", "x.raw"})
    EXPECT_THAT(breach(name, "text"), HasSubstr("a data or built file")) << name;
  EXPECT_THAT(breach("deploy/tool", std::string("\x7f"
                                                "ELF\0\0",
                                                6)),
              HasSubstr("only PNG pictures may be binary"));
  EXPECT_TRUE(is_fine("docs/a.png", std::string("\x89PNG\0", 5)));
  EXPECT_THAT(breach("docs/a.md", std::string(1024 * 1024 + 1, 'a')), HasSubstr("above 1 MiB"));
}

/// The planted house has common/math, and gets common/message, which the list excuses.
TEST_F(PlantedHouse, RefusesRoomsWithoutUnitTests) {
  plant("tests/unit/common/math/sum_test.cpp", "// a test\n");
  plant("tests/unit/common/time/clock_test.cpp", "// a test\n");
  plant("common/message/limits.h", "#pragma once\n");
  EXPECT_TRUE(is_fine("common/time/clock.h", "// a clock\n"));
  EXPECT_THAT(
      breach("common/weather/rain.h", "// rain\n"),
      StartsWith("common/weather:1: a room without unit tests; write tests/unit/common/weather/*_test.cpp"));
  plant("tests/house/mirror_rules.cpp", "// the list\n");
  EXPECT_FALSE(is_fine("tests/unit/common/message/limits_test.cpp", "// excused, and tested\n"));
}

TEST_F(PlantedHouse, RefusesFieldsOfALatticeOutsideItsRooms) {
  const std::string reads = "const auto left = lattice.mask[0];\n",
                    computes = "const auto b = a + offset[d];\n";
  EXPECT_EQ(breach("physics_node/fragments/flood.cpp", reads),
            "physics_node/fragments/flood.cpp:1: \"mask\" is of a lattice; ask Adjacency, TopologyEvents or "
            "the boundary");
  EXPECT_THAT(breach("physics_node/step/leap.h", computes), HasSubstr("\"offset[\" is of a lattice"));
  for (const char* room : {"lattice", "body", "boundary", "step/lattice"})
    EXPECT_TRUE(is_fine("physics_node/" + std::string(room) + "/leap.cpp", reads + computes)) << room;
  EXPECT_TRUE(is_fine("render_node/gl/leap.cpp", reads));
}

TEST_F(PlantedHouse, RefusesWideInterfaces) {
  const auto face = [](int n) {
    std::string text = "class Face {\n";
    for (int i = 0; i < n; ++i) text += "  virtual int f" + std::to_string(i) + "() = 0;\n";
    return text + "};\n";
  };
  EXPECT_TRUE(is_fine("physics_node/step/face.h", face(12) + face(12)));
  EXPECT_EQ(breach("physics_node/step/face.h", face(13)),
            "physics_node/step/face.h:14: Face has more than 12 virtual members; split it by who uses them");
}

TEST_F(PlantedHouse, LooksAwayFromWhatGitIgnores) {
  EXPECT_TRUE(is_fine("build/ready/a.o", "x"));
  EXPECT_TRUE(is_fine("data/cranium.h5", "x"));
  EXPECT_FALSE(is_fine("scenes/data/cranium.h5", "x"));
}

}  // namespace
}  // namespace palpate::house
