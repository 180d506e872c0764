// Surfaces as other programs write them.
#include "deploy/import/read_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/error/error.h"
#include "deploy/import/closed_surface.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/unit/deploy/import/made_surfaces.h"

namespace palpate::test {
namespace {

using testing::EndsWith;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

SurfaceContent read_bytes(const std::string& name, const std::string& bytes, double metres = 0.001) {
  const ScratchFolder folder;
  std::ofstream(folder / name, std::ios::binary) << bytes;
  return read_surface(folder / name, metres);
}

TEST(ReadSurface, GivesTheSameOfAllFormats) {
  const TriangleSurface ball = made_ball(12, Vec3(3, 4, 5), 10);
  for (const auto& [name, bytes] :
       std::vector<std::pair<std::string, std::string>>{{"a.obj", as_obj(ball)},
                                                        {"a.STL", as_stl(ball)},
                                                        {"b.stl", as_binary_stl(ball)},
                                                        {"a.ply", as_ply(ball)},
                                                        {"a.off", as_off(ball)}}) {
    EXPECT_TRUE(is_surface_format(name));
    const SurfaceContent content = read_bytes(name, bytes);
    ASSERT_EQ(content.surface.triangles.size(), ball.triangles.size()) << name;
    for (std::size_t t = 0; t < ball.triangles.size(); ++t)
      for (std::size_t n = 0; n < 3; ++n)
        EXPECT_LT((content.surface.corner(t, n) - 1e-3 * ball.corner(t, n)).norm(), 1e-8) << name;
    EXPECT_EQ(content.polygons + content.other, 0U) << name;
    EXPECT_NEAR(close_surface(content.surface, name).volume, 1e-9 * enclosed_volume(ball), 1e-12) << name;
  }
  EXPECT_FALSE(is_surface_format("a.msh"));
}

TEST(ReadSurface, HasTheUnitThatIsGiven) {
  EXPECT_NEAR(enclosed_volume(read_bytes("a.off", as_off(made_cube(2)), 0.01).surface), 8e-6, 1e-12);
}

TEST(ReadSurface, CutsPolygonsAndLeavesOutLines) {
  // A face with a corner that points inwards: a fan from its first corner would go outside.
  const std::string prism =
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 0 0 1\nv 4 0 1\nv 4 4 1\nv 2 1 1\nv 0 4 1\n"
      "f 5 4 3 2 1\nf 6 7 8 9 10\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\nl 1 2\n";
  const SurfaceContent content = read_bytes("a.obj", prism, 1);
  EXPECT_EQ(content.polygons, 7U);
  EXPECT_EQ(content.other, 1U);
  EXPECT_EQ(content.surface.triangles.size(), 16U);
  EXPECT_NEAR(close_surface(content.surface, "a.obj").volume, 10, 1e-6);
}

TEST(ReadSurface, ReadsNoFileThatTheSurfaceNames) {
  EXPECT_EQ(
      read_bytes("a.obj", "mtllib /dev/zero\nusemtl a\n" + as_obj(made_cube(1))).surface.triangles.size(),
      12U);
}

TEST(ReadSurface, SaysWhatIsWrong) {
  const TriangleSurface cube = made_cube(10);
  const std::string obj = as_obj(cube), off = as_off(cube), binary = as_binary_stl(cube);
  const std::string not_finite =
      "has a point that is not finite, or beyond 1000 m; is its unit another, or is it damaged?";
  const auto as_it = [](const std::string& kind, const std::string& why) {
    return "cannot be read as " + kind + " (assimp: " + why + "); fetch a whole copy, or save it anew";
  };
  struct Bad {
    std::string name, bytes, says;
  };
  for (const Bad& bad : std::vector<Bad>{
           {"a.obj", "", "is empty; fetch a whole copy"},
           {"a.obj", "a text about something else",
            "has no triangle; a surface has faces, not points and lines alone"},
           {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n",
            "has no triangle; a surface has faces, not points and lines alone"},
           {"a.obj", replaced(obj, "v 10 10 10", "v nan 10 10"), not_finite},
           {"a.obj", replaced(obj, "v 10 10 10", "v 1e39 10 10"), not_finite},
           {"a.obj", replaced(obj, "v 10 10 10", "v 2e6 10 10"), not_finite},
           {"a.obj", replaced(obj, "f 2 8 6", "f 2 8 60"), as_it(".obj", "OBJ: vertex index out of range")},
           {"a.off", replaced(off, "3 1 7 5", "3 1 7 50"),
            as_it(".off", "OFF: Vertex index is out of range")},
           {"a.off", replaced(off, "10 10 10", "10 nan 10"), not_finite},
           {"a.ply", replaced(as_ply(cube), "3 1 7 5", "3 1 7 50"),
            "a triangle names a point that is not there; fetch a whole copy"},
           {"a.ply", replaced(as_ply(cube), "end_header", "end_he9der"),
            "its header has no end, a line end_header; fetch a whole copy"},
           {"a.stl", binary.substr(0, binary.size() - 30),
            as_it(".stl", "Failed to determine STL storage representation for it")},
           {"a.stl", replaced(binary, std::string("\x0c\0\0\0", 4), std::string("\xff\xff\xff\xee", 4)),
            as_it(".stl", "Failed to determine STL storage representation for it")},
           {"a.stl", "{\"asset\":{\"version\":\"2.0\"}}",
            as_it(".stl", "Failed to determine STL storage representation for it")}}) {
    try {
      read_bytes(bad.name, bad.bytes);
      ADD_FAILURE() << bad.says;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), EndsWith("/" + bad.name + ": " + bad.says));
    }
  }
  EXPECT_THROW(read_surface("/nowhere/a.obj", 1), InputError);
  EXPECT_THROW(read_surface("/", 1), InputError);
}

}  // namespace
}  // namespace palpate::test
