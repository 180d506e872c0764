// palpate import of surfaces, as a person runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "physics_node/mesh/mesh_file.h"
#include "physics_node/mesh/surface_file.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/image/small_images.h"
#include "tests/unit/deploy/import/made_surfaces.h"

namespace palpate::test {
namespace {

using testing::HasSubstr;

TEST(ImportSurface, SaysWhatItMadeAndWhatItMended) {
  const ScratchFolder folder;
  std::string quads = as_obj(made_cube(10));
  quads = quads.substr(0, quads.find("f "));
  quads += "f 3 4 2 1\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 6 8 4 2\n";  // the last one inwards
  write_file(folder / "a.obj", quads);
  const Outcome made =
      run_importer({folder / "a.obj", "--unit", "mm", "--tetrahedra-mm", "2", "--out", folder / "m.h5"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out,
              HasSubstr(" cm3 of the surface's 1 cm3, 6 polygons cut into triangles, 2 triangles turned, "
                        "written to "));
  const physics::MeshFile file = physics::read_mesh(folder / "m.h5");
  EXPECT_EQ(file.source, "a.obj");
  EXPECT_NEAR(volume_of(file.mesh), 1e-6, 0.05e-6);
  EXPECT_LT(box_of(file.mesh).max().maxCoeff(), 0.01 + 1e-8);
}

TEST(ImportSurface, KeepsItsTrianglesWhereAskedTo) {
  const ScratchFolder folder;
  write_file(folder / "a.obj", as_obj(made_ball(10)));
  const Outcome made =
      run_importer({folder / "a.obj", "--unit", "mm", "--surface", "--out", folder / "s.h5"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr(" triangles, "));
  const physics::SurfaceFile file = physics::read_surface_file(folder / "s.h5");
  EXPECT_EQ(file.mesh.triangles.size(), made_ball(10).triangles.size());
  EXPECT_EQ(file.source, "a.obj");
  EXPECT_NEAR(enclosed_volume(file.mesh), 4.19e-6, 0.02e-6);
  for (const auto& options : {std::vector<std::string>{"--surface", "--tetrahedra-mm", "2", "--out", "t.h5"},
                              std::vector<std::string>{"--surface", "--out", folder / "t.msh"}}) {
    std::vector<std::string> arguments = {folder / "a.obj", "--unit", "mm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_importer(arguments).code, 2);
  }
}

TEST(ImportSurface, RefusesMistakesInOneLineAndKeepsWhatIsThere) {
  const ScratchFolder folder;
  write_file(folder / "m.h5", "older");
  std::string open = as_obj(made_cube(10));
  write_file(folder / "open.obj", open.substr(0, open.rfind("f ")));
  write_file(folder / "huge.off", "OFF\n4000000000 1 0\n0 0 0\n3 0 0 0\n");
  write_file(
      folder / "huge.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 3000000000\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n");
  write_file(folder / "a.obj", as_obj(made_cube(10)));
  const auto expect = [&](const std::string& name, const std::vector<std::string>& options,
                          const std::string& says) {
    std::vector<std::string> arguments = {folder / name, "--out", folder / "m.h5"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_importer(arguments);
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(std::filesystem::file_size(folder / "m.h5"), 5U);
  };
  const std::vector<std::string> good = {"--unit", "mm", "--tetrahedra-mm", "2"};
  expect("open.obj", good,
         "open.obj: the surface is open: edges of one triangle: 3, the first at 10, 5, 10 mm; close its "
         "holes\n");
  expect("huge.off", good, "asks for more memory than");
  expect("huge.ply", good, "asks for more memory than");
  expect("none.obj", good, "none.obj: there is no such file; name a surface\n");
  expect("a.obj", {"--tetrahedra-mm", "2"}, "--unit: write --unit mm, cm or m");
  expect("a.obj", {"--unit", "mm"}, "--tetrahedra-mm: write how large the tetrahedra shall be");
  expect("a.obj", {"--unit", "mm", "--tetrahedra-mm", "2", "--keep", "1,2"},
         "is a surface; leave out what is of images");
  expect("a.obj", {"--unit", "mm", "--tetrahedra-mm", "2", "--largest"},
         "is a surface; leave out what is of images");
}

}  // namespace
}  // namespace palpate::test
