// The project's own file of tetrahedra: comes back to the bit, and is believed in nothing.
#include "physics_node/mesh/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "physics_node/mesh/tet_box.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::physics {
namespace {

using testing::HasSubstr;

TetMesh box_of_two_regions() {
  TetMesh mesh = make_tet_box({.cells = {2, 1, 1}, .edge = 0.01, .jitter = 0.1});
  tidy(mesh);
  mesh.region.assign(mesh.tets.size(), 3);
  mesh.region.back() = -7;
  return mesh;
}

TEST(MeshFile, ComesBackToTheBit) {
  const test::ScratchFolder folder;
  const std::string path = folder / "m.h5";
  const TetMesh mesh = box_of_two_regions();
  write_mesh(path, {mesh, "organ.vtk"});
  EXPECT_TRUE(is_mesh_file(path));
  const MeshFile back = read_mesh(path);
  EXPECT_EQ(back.mesh.nodes, mesh.nodes);
  EXPECT_EQ(back.mesh.tets, mesh.tets);
  EXPECT_EQ(back.mesh.region, mesh.region);
  EXPECT_EQ(back.source, "organ.vtk");
}

TEST(MeshFile, IsKnownByItsNameAndByWhatItSays) {
  const test::ScratchFolder folder;
  EXPECT_TRUE(is_mesh_file_name("a/b.h5"));
  EXPECT_TRUE(is_mesh_file_name("b.hdf5"));
  EXPECT_FALSE(is_mesh_file_name("b.msh"));
  const std::string path = folder / "other.h5";
  Hdf5File(path, Hdf5File::Mode::create).set_text("format", "palpate volume");
  EXPECT_FALSE(is_mesh_file(path));
  EXPECT_FALSE(is_mesh_file(folder / "none.h5"));
  EXPECT_THROW(read_mesh(folder / "none.h5"), InputError);
  EXPECT_THROW(write_mesh(folder / "no/m.h5", {box_of_two_regions(), ""}), InputError);
}

struct Hostile {
  const char* name;
  std::function<void(TetMesh&)> spoil;
  const char* expected;
};

class HostileMesh : public testing::TestWithParam<Hostile> {};

TEST_P(HostileMesh, IsRefusedInOneLine) {
  const test::ScratchFolder folder;
  const std::string path = folder / "m.h5";
  TetMesh mesh = box_of_two_regions();
  GetParam().spoil(mesh);
  write_mesh(path, {mesh, ""});
  try {
    read_mesh(path);
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().expected));
    EXPECT_THAT(error.what(), HasSubstr("import the mesh again"));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, HostileMesh,
    testing::Values(
        Hostile{"NodeTooLarge", [](TetMesh& m) { m.tets[0][1] = static_cast<Index>(m.nodes.size()); },
                "which is not there"},
        Hostile{"NodeNegative", [](TetMesh& m) { m.tets[0][1] = -1; }, "name node -1"},
        Hostile{"NotANumber", [](TetMesh& m) { m.nodes[2].y() = std::numeric_limits<double>::quiet_NaN(); },
                "not finite"},
        Hostile{"Infinite", [](TetMesh& m) { m.nodes[2].y() = std::numeric_limits<double>::infinity(); },
                "not finite"},
        Hostile{"TooFar", [](TetMesh& m) { m.nodes[2].z() = 1e9; }, "beyond 1000 m"},
        Hostile{"InsideOut", [](TetMesh& m) { std::swap(m.tets[1][0], m.tets[1][1]); }, "inside out"},
        Hostile{"Flat", [](TetMesh& m) { m.tets[1][0] = m.tets[1][1]; }, "flat"},
        Hostile{"Unused", [](TetMesh& m) { m.nodes.emplace_back(0, 0, 0); }, "belongs to no tetrahedron"},
        Hostile{"RegionsShort", [](TetMesh& m) { m.region.pop_back(); }, "of different length"},
        Hostile{"Empty", [](TetMesh& m) { m = {}; }, "rows of"}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace palpate::physics
