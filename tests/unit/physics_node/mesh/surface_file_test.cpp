// The project's own file of a closed surface: comes back to the bit, and is believed in nothing.
#include "physics_node/mesh/surface_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "physics_node/mesh/mesh_file.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_sphere.h"

namespace palpate::physics {
namespace {

using testing::HasSubstr;

TEST(SurfaceFile, ComesBackToTheBit) {
  const test::ScratchFolder folder;
  const std::string path = folder / "s.h5";
  const TriangleMesh sphere = test::made_sphere(0.02, 2);
  write_surface(path, {sphere, "organ.stl"});
  EXPECT_TRUE(is_surface_file(path));
  EXPECT_FALSE(is_mesh_file(path));
  const SurfaceFile back = read_surface_file(path);
  EXPECT_EQ(back.mesh.nodes, sphere.nodes);
  EXPECT_EQ(back.mesh.triangles, sphere.triangles);
  EXPECT_EQ(back.source, "organ.stl");
  EXPECT_FALSE(is_surface_file(folder / "none.h5"));
  EXPECT_THROW(read_surface_file(folder / "none.h5"), InputError);
  EXPECT_THROW(write_surface(folder / "no/s.h5", {sphere, ""}), InputError);
}

TEST(SurfaceFile, OfAnotherKindIsNone) {
  const test::ScratchFolder folder;
  const std::string path = folder / "s.h5";
  Hdf5File(path, Hdf5File::Mode::create).set_text("format", "palpate mesh");
  EXPECT_FALSE(is_surface_file(path));
  EXPECT_THROW(read_surface_file(path), InputError);
}

struct SpoiltSurface {
  const char* name;
  std::function<void(TriangleMesh&)> spoil;
  const char* expected;
};

class SpoiltSurfaceFile : public testing::TestWithParam<SpoiltSurface> {};

TEST_P(SpoiltSurfaceFile, IsRefusedInOneLine) {
  const test::ScratchFolder folder;
  const std::string path = folder / "s.h5";
  TriangleMesh mesh = test::made_sphere(0.02, 1);
  GetParam().spoil(mesh);
  write_surface(path, {mesh, ""});
  try {
    read_surface_file(path);
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().expected));
    EXPECT_THAT(error.what(), HasSubstr(path));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, SpoiltSurfaceFile,
    testing::Values(
        SpoiltSurface{"nan",
                      [](TriangleMesh& m) { m.nodes[3].y() = std::numeric_limits<double>::quiet_NaN(); },
                      "not finite"},
        SpoiltSurface{"far", [](TriangleMesh& m) { m.nodes[3].y() = 1e9; }, "beyond 1000 m"},
        SpoiltSurface{"beyond", [](TriangleMesh& m) { m.triangles[5][1] = 1000000; }, "name node 1000000"},
        SpoiltSurface{"negative", [](TriangleMesh& m) { m.triangles[5][1] = -1; }, "name node -1"},
        SpoiltSurface{"hole", [](TriangleMesh& m) { m.triangles.pop_back(); },
                      "3 edges have not one triangle"},
        SpoiltSurface{"flat",
                      [](TriangleMesh& m) { m.nodes[m.triangles[0][0]] = m.nodes[m.triangles[0][1]]; },
                      "has no area"},
        SpoiltSurface{"unused", [](TriangleMesh& m) { m.nodes.emplace_back(1, 1, 1); },
                      "belongs to no triangle"},
        SpoiltSurface{"inside_out",
                      [](TriangleMesh& m) {
                        for (MeshTriangle& corners : m.triangles) std::swap(corners[0], corners[1]);
                      },
                      "inside out"}),
    [](const auto& all) { return all.param.name; });

}  // namespace
}  // namespace palpate::physics
