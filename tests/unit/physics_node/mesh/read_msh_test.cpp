// Meshes of Gmsh come in as they are; what cannot be meant is refused in one line that says where.

#include "physics_node/mesh/read_msh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "common/error/error.h"
#include "common/file/scratch_folder.h"
#include "physics_node/mesh/tet_box.h"
#include "tests/support/mutate.h"

namespace palpate::physics {
namespace {

const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string four_nodes = "$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n$EndNodes\n";

std::string with_elements(const std::string& lines, int n) {
  return head + four_nodes + "$Elements\n" + std::to_string(n) + "\n" + lines + "$EndElements\n";
}

/// A mesh as Gmsh writes it, with the faces of its outside left out and one point kept.
std::string msh_of(const TetMesh& mesh) {
  std::string text = head + "$PhysicalNames\n1\n3 1 \"tissue\"\n$EndPhysicalNames\n$Nodes\n" +
                     std::to_string(mesh.nodes.size()) + "\n";
  const auto add = [&text](auto... entries) {
    ((text += std::to_string(entries) + " "), ...), text.back() = '\n';
  };
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    add(n + 1, mesh.nodes[n].x(), mesh.nodes[n].y(), mesh.nodes[n].z());
  text += "$EndNodes\n$Elements\n" + std::to_string(mesh.tets.size() + 1) + "\n1 15 2 0 1 1\n";
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& c = mesh.tets[t];
    add(t + 2, 4, 2, mesh.region[t], 1, c[0] + 1, c[1] + 1, c[2] + 1, c[3] + 1);
  }
  return text + "$EndElements\n";
}

std::string complaint_about(const std::string& text) {
  try {
    parse_msh(text, "liver.msh");
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaints().size(), 1U);
    EXPECT_EQ(error.complaints()[0].find('\n'), std::string::npos);
    return error.complaints()[0];
  }
  ADD_FAILURE() << "was read";
  return "";
}

TEST(ReadMsh, ReadsWhatWasWritten) {
  TetMesh mesh = make_tet_box({.cells = {3, 2, 2}});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.region[t] = t % 2 == 0 ? 4 : 9;
  const MshContent read = parse_msh(msh_of(mesh), "box.msh", 0.001);
  ASSERT_EQ(read.mesh.nodes.size(), mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    EXPECT_LT((read.mesh.nodes[n] - 0.001 * mesh.nodes[n]).norm(), 1e-15);
  EXPECT_EQ(read.mesh.tets, mesh.tets);
  EXPECT_EQ(read.mesh.region, mesh.region);
  EXPECT_EQ(read.other, 1U);
  EXPECT_EQ(read.tidied.turned, 0U);
  EXPECT_EQ(read.tidied.unused, 0U);
}

TEST(ReadMsh, TakesAFileAndSaysWhenItCannot) {
  const ScratchFolder folder;
  const auto path = folder.path() / "box.msh";
  std::ofstream(path) << msh_of(make_tet_box({}));
  EXPECT_EQ(read_msh(path.string()).mesh.tets.size(), 6U);
  EXPECT_THROW(read_msh((folder.path() / "none.msh").string()), InputError);
  EXPECT_THROW(read_msh(folder.path().string()), InputError) << "a folder";
}

TEST(ReadMsh, TurnsNegativeVolumesAndDropsUnusedNodes) {
  const std::string five = "$Nodes\n5\n10 0 0 0\n15 9 9 9\n20 1 0 0\n30 0 1 0\n40 0 0 1\n$EndNodes\n";
  const MshContent read =
      parse_msh(head + five + "$Elements\n1\n1 4 2 3 1 10 30 20 40\n$EndElements\n", "one.msh");
  EXPECT_EQ(read.tidied.turned, 1U);
  EXPECT_EQ(read.tidied.unused, 1U);
  EXPECT_EQ(read.mesh.nodes.size(), 4U);
  EXPECT_EQ(read.mesh.region, std::vector<int>{3});
  EXPECT_NEAR(signed_volume(read.mesh, read.mesh.tets[0]), 1.0 / 6, 1e-15);
}

TEST(ReadMsh, TakesUnitsThatAreFiniteAndPlacesThatAreInAnyUnit) {
  std::string text = msh_of(make_tet_box({}));
  for (const double metres : {0.0, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_THROW(parse_msh(text, "box.msh", metres), InputError);
  EXPECT_THROW(parse_msh(text, "box.msh", 1e4), InputError) << "10 km";
  text.replace(text.find("0.000000 0.000000 0.000000"), 8, "inf     ");
  EXPECT_THROW(parse_msh(text, "box.msh", 1e-306), InputError);
}

TEST(ReadMsh, ReadsLinesThatEndAsWindowsWritesThem) {
  std::string text;
  for (const char c : msh_of(make_tet_box({}))) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(parse_msh(text, "box.msh").mesh.tets.size(), 6U);
}

struct Mistake {
  std::string name, text, complaint;
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreOneLineThatSaysWhere) {
  EXPECT_THAT(complaint_about(GetParam().text), testing::HasSubstr(GetParam().complaint));
}

std::vector<Mistake> all_mistakes() {
  const std::string tet = "1 4 2 1 1 10 20 30 40\n";
  const auto swap_in = [](std::string text, const std::string& old, const std::string& fresh) {
    return text.replace(text.find(old), old.size(), fresh);
  };
  const std::string good = with_elements(tet, 1);
  return {
      {"Empty", "", "liver.msh:1:1: the end where $MeshFormat"},
      {"Foreign", "solid cube\n", "liver.msh:1:1: \"solid\" where $MeshFormat"},
      {"NewerVersion", swap_in(good, "2.2", "4.1"), "liver.msh:2:1: \"4.1\" is another version"},
      {"Binary", swap_in(good, "2.2 0", "2.2 1"), "liver.msh:2:5: a binary file"},
      {"WordBetweenSections", swap_in(good, "$Nodes", "stray\n$Nodes"),
       "liver.msh:4:1: \"stray\" stands between"},
      {"NodeCountNegative", swap_in(good, "$Nodes\n4", "$Nodes\n-4"),
       "liver.msh:5:1: \"-4\" is no number of nodes"},
      {"NodeCountHuge", swap_in(good, "$Nodes\n4", "$Nodes\n999999999999999999999"), "liver.msh:5:1: "},
      {"NodeCountBeyondTheFile", swap_in(good, "$Nodes\n4", "$Nodes\n19999999"),
       "more than the rest of the file"},
      {"NodeCountTooHigh", swap_in(good, "$Nodes\n4", "$Nodes\n5"),
       "liver.msh:10:1: \"$EndNodes\" is no number"},
      {"NodeCountTooLow", swap_in(good, "$Nodes\n4", "$Nodes\n3"), "liver.msh:9:1: \"40\" where $EndNodes"},
      {"NodeNumberZero", swap_in(good, "10 0 0 0", "0 0 0 0"), "liver.msh:6:1: \"0\" is no number of a node"},
      {"NodeTwice", swap_in(good, "20 1 0 0", "10 1 0 0"), "node 10 is there twice"},
      {"CoordinateNan", swap_in(good, "20 1 0 0", "20 1 nan 0"), "liver.msh:7:6: \"nan\" is no coordinate"},
      {"CoordinateInfinite", swap_in(good, "20 1 0 0", "20 1 0 -inf"),
       "liver.msh:7:8: \"-inf\" is no coordinate"},
      {"CoordinateFar", swap_in(good, "20 1 0 0", "20 1e300 0 0"),
       "liver.msh:7:4: \"1e300\" is no coordinate"},
      {"CoordinateOverflows", swap_in(good, "20 1 0 0", "20 1e999 0 0"),
       "liver.msh:7:4: \"1e999\" is no coordinate"},
      {"CoordinateMissing", swap_in(good, "20 1 0 0", "20 1 0"), "liver.msh:7:7: the end is no coordinate"},
      {"CoordinateAWord", swap_in(good, "20 1 0 0", "20 1.5mm 0 0"), "\"1.5mm\" is no coordinate"},
      {"NodesTwice", head + four_nodes + four_nodes, "a second $Nodes"},
      {"ElementsFirst", head + "$Elements\n0\n$EndElements\n", "liver.msh:4:1: $Elements before $Nodes"},
      {"ElementsTwice", good + "$Elements\n0\n$EndElements\n", "a second $Elements"},
      {"NoElements", head + four_nodes, "no tetrahedron"},
      {"FacesOnly", with_elements("1 2 2 1 1 10 20 30\n", 1), "no tetrahedron"},
      {"NodeUnknown", swap_in(good, "30 40\n$EndElements", "30 41\n$EndElements"),
       "liver.msh:13:20: node 41 is not in $Nodes"},
      {"NodeTwiceInOne", with_elements("1 4 2 1 1 10 20 30 30\n", 1), "a flat tetrahedron"},
      {"Hexahedron", with_elements("1 5 2 1 1 10 20 30 40 10 20 30 40\n", 1),
       "liver.msh:13:3: a hexahedron;"},
      {"SecondOrder", with_elements("1 11 2 1 1 10 20 30 40 1 2 3 4 5 6\n", 1),
       "a tetrahedron with 10 nodes"},
      {"KindUnknown", with_elements("1 93 2 1 1 10\n", 1), "an element of kind 93"},
      {"TagsHuge", with_elements("1 4 2000000000 1 1 10 20 30 40\n", 1),
       "\"2000000000\" is no number of tags"},
      {"NodeMissing", with_elements("1 4 2 1 1 10 20 30\n", 1), "the end is no number of a node"},
      {"BreaksOff", good.substr(0, good.size() - 25), "liver.msh:"},
      {"SectionWithoutEnd", head + "$Periodic\n1\n2\n", "liver.msh:4:1: \"$Periodic\" has no end"},
  };
}
INSTANTIATE_TEST_SUITE_P(All, Mistakes, testing::ValuesIn(all_mistakes()),
                         [](const auto& mistake) { return mistake.param.name; });

TEST(ReadMsh, BearsDamagedFiles) {
  const std::string good = msh_of(make_tet_box({.cells = {2, 2, 1}}));
  int refused = 0;
  constexpr int n = 20'000;
  for (int seed = 0; seed < n; ++seed) {
    const std::string text = seed % 4 == 0 ? good.substr(0, static_cast<std::size_t>(seed) % good.size())
                                           : test::mutant(good, static_cast<std::uint64_t>(seed));
    try {
      const MshContent read = parse_msh(text, "damaged.msh");
      for (const auto& corners : read.mesh.tets) {
        for (const Index node : corners) ASSERT_LT(static_cast<std::size_t>(node), read.mesh.nodes.size());
        ASSERT_GT(signed_volume(read.mesh, corners), 0);
      }
      ASSERT_EQ(read.mesh.region.size(), read.mesh.tets.size());
      for (const Vec3& x : read.mesh.nodes) ASSERT_TRUE(x.allFinite());
    } catch (const InputError& error) {
      ++refused;
      ASSERT_TRUE(std::string(error.what()).starts_with("damaged.msh:")) << error.what();
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(refused, n / 4);
  EXPECT_LT(refused, n) << "a digit more or less is still a mesh";
}

}  // namespace
}  // namespace palpate::physics
