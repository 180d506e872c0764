// Meshes that other programs write.
#include "deploy/import/read_mesh_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/error/error.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

using testing::HasSubstr;

// Two tetrahedra on one face, the second inside out; a node of none; a triangle.
const std::string msh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n1\n3 7 \"liver\"\n$EndPhysicalNames\n"
    "$Entities\n1 0 1 1\n1 0 0 0 0\n5 0 0 0 1 1 0 0 0\n3 0 0 0 1 1 1 1 7 1 5\n$EndEntities\n"
    "$Nodes\n2 6 1 12\n0 1 0 1\n12\n9 9 9\n3 3 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 "
    "1\n$EndNodes\n"
    "$Elements\n2 3 1 3\n2 5 2 1\n1 1 2 3\n3 3 4 2\n2 1 2 3 4\n3 2 4 3 5\n$EndElements\n";
const std::string vtk_head =
    "# vtk DataFile Version 3.0\na title, with words\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 6 float\n0 0 0 1 0 0\n0 1 0 0 0 1 1 1 1\n9 9 9\n";
const std::string vtk = vtk_head +
                        "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 1 3 2 4\n\nCELL_TYPES 3\n5\n10\n10\n"
                        "CELL_DATA 3\nSCALARS s int 1\nLOOKUP_TABLE default\n1 2 3\n";
const std::string vtk5 = vtk_head +
                         "METADATA\nINFORMATION 0\n\nCELLS 4 11\nOFFSETS vtktypeint64\n0 3 7\n11\n"
                         "CONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3\n1 3 2 4\n\nCELL_TYPES 3\n5\n10\n10\n";
const std::string medit =
    "MeshVersionFormatted 2\n# a remark\nDimension\n3\nVertices\n6\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n1 1 "
    "1 1\n9 9 9 0\n"
    "Triangles\n1\n1 2 3 5\nTetrahedra\n2\n1 2 3 4 7\n2 4 3 5 7\nCorners\n1\n1\nEnd\n";

physics::MshContent read(const std::string& format, const std::string& text, double metres = 0.001) {
  if (format == "msh4") return parse_msh4(text, "m.msh", metres);
  if (format == "medit") return parse_medit(text, "m.mesh", metres);
  return parse_vtk_mesh(text, "m.vtk", metres);
}

struct Good {
  const char *name, *format;
  const std::string* text;
  int region;
};

class MeshFormat : public testing::TestWithParam<Good> {};

TEST_P(MeshFormat, GivesTheSameMesh) {
  const Good& good = GetParam();
  const physics::MshContent content = read(good.format, *good.text);
  EXPECT_EQ(content.mesh.nodes.size(), 5U);
  EXPECT_EQ(content.tidied.unused, 1U);
  EXPECT_EQ(content.other, 1U);
  ASSERT_EQ(content.mesh.tets.size(), 2U);
  EXPECT_EQ(content.mesh.region, (std::vector<int>{good.region, good.region}));
  double volume = 0;
  for (const auto& tet : content.mesh.tets) {
    EXPECT_GT(signed_volume(content.mesh, tet), 0);
    volume += signed_volume(content.mesh, tet);
  }
  EXPECT_NEAR(volume, 0.5e-9, 1e-20);  // 1/6 and 1/3 of a cubic millimetre
}

/// Cut anywhere it is a mistake, or gives nothing that is not in the file.
TEST_P(MeshFormat, CutAnywhereIsAMistakeOrSmaller) {
  const Good& good = GetParam();
  for (std::size_t n = 0; n < good.text->size(); ++n) {
    try {
      EXPECT_LE(read(good.format, good.text->substr(0, n)).mesh.tets.size(), 2U);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("m."));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormat,
                         testing::Values(Good{"Msh4", "msh4", &msh4, 7}, Good{"Vtk", "vtk", &vtk, 0},
                                         Good{"Vtk5", "vtk", &vtk5, 0}, Good{"Medit", "medit", &medit, 7}),
                         [](const auto& one) { return one.param.name; });

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MeshFormatMistake, IsNamedWithItsPlace) {
  struct Bad {
    const char* format;
    std::string text, expected;
  };
  const std::vector<Bad> all{
      {"vtk", with(vtk, "ASCII", "BINARY"), "m.vtk:3:1: a binary file"},
      {"vtk", with(vtk, "UNSTRUCTURED_GRID", "POLYDATA"), "m.vtk:4:9: \"POLYDATA\" where UNSTRUCTURED_GRID"},
      {"vtk", with(vtk, "5\n10\n10", "5\n10\n12"), "m.vtk:17:1: a cell of kind 12 with 4 nodes"},
      {"vtk", with(vtk, "4 1 3 2 4", "4 1 3 2 6"), "node 6 is not there"},
      {"vtk", with(vtk, "POINTS 6", "POINTS 600000"), "more than the rest of the file can hold"},
      {"vtk", with(vtk, "CELL_TYPES 3", "CELL_TYPES 2"), "2 kinds of 3 cells"},
      {"vtk", with(vtk5, "0 3 7\n11", "0 7 3\n11"), "offsets of cells that fall"},
      {"vtk", with(vtk, "0 1 0 0 0 1", "0 1 0 0 0 nan"), "\"nan\" is no coordinate"},
      {"medit", with(medit, "Dimension\n3", "Dimension\n2"), "m.mesh:4:1: a flat mesh"},
      {"medit", with(medit, "Triangles\n1\n1 2 3 5", "Hexahedra\n1\n1 2 3 4 5 6 1 2 0"),
       "Hexahedra; only tetrahedra"},
      {"medit", with(medit, "1 2 3 4 7", "1 2 3 3 7"), "a flat tetrahedron"},
      {"medit", with(medit, "Tetrahedra\n2", "Tetrahedra\n0"), "where a keyword should stand"},
      {"medit", with(medit, "Vertices\n6", "Tetrahedra\n1\n1 2 3 4 7\nVertices\n6"),
       "Tetrahedra before Vertices"},
      {"msh4", with(msh4, "$Nodes\n2", "$PartitionedEntities\n$EndPartitionedEntities\n$Nodes\n2"),
       "a mesh in partitions"},
      {"msh4", with(msh4, "4.1", "4.0"), "m.msh:2:1: \"4.0\" where 4.1"},
      {"msh4", with(msh4, "4.1 0", "4.1 1"), "m.msh:2:5: a binary file"},
      {"msh4", with(msh4, "3 3 4 2", "3 3 5 2"), "elements of kind 5; only tetrahedra"},
      {"msh4", with(msh4, "12\n9 9 9", "1\n9 9 9"), "node 1 is there twice"},
      {"msh4", with(msh4, "3 2 4 3 5", "3 2 4 3 6"), "node 6 is not there"},
      {"msh4", with(msh4, "$EndPhysicalNames\n", ""), "has no end"},
  };
  for (const Bad& bad : all) {
    try {
      read(bad.format, bad.text);
      ADD_FAILURE() << bad.expected << ": no complaint";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(bad.expected));
    }
  }
}

/// What other programs may write as well: signs, an empty title, cells of nothing.
TEST(MeshFormat, TakesWhatIsLegalThoughRare) {
  EXPECT_EQ(read("vtk", with(vtk, "a title, with words", "")).mesh.tets.size(), 2U);
  EXPECT_EQ(read("vtk", with(vtk, "POINTS 6 float\n0 0 0", "POINTS 6 float\n+0 +0.0 +0e+0")).mesh.tets.size(),
            2U);
  std::string empty = with(vtk, "CELLS 3 14\n", "CELLS 4 15\n0\n");
  empty = with(empty, "CELL_TYPES 3\n", "CELL_TYPES 4\n0\n");
  EXPECT_EQ(read("vtk", empty).other, 2U);
}

TEST(MeshFormatOfAFile, FollowsItsEndingAndOfGmshItsVersion) {
  const test::ScratchFolder folder;
  const auto file = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  EXPECT_EQ(read_mesh_format(file("a.vtk", vtk), 1).mesh.tets.size(), 2U);
  EXPECT_EQ(read_mesh_format(file("a.mesh", medit), 1).mesh.tets.size(), 2U);
  EXPECT_EQ(read_mesh_format(file("a.msh", msh4), 1).mesh.tets.size(), 2U);
  const std::string msh2 =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
      "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  EXPECT_EQ(read_mesh_format(file("b.msh", msh2), 1).mesh.tets.size(), 1U);
  EXPECT_EQ(read_mesh_format(file("A.VTK", vtk), 1).mesh.tets.size(), 2U);
  EXPECT_THROW(read_mesh_format(folder / "none.vtk", 1), InputError);
  EXPECT_FALSE(is_mesh_format("a.stl"));
}

}  // namespace
}  // namespace palpate
