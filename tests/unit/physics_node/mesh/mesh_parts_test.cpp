#include "physics_node/mesh/mesh_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <set>

#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

TetMesh box(CubeSplit split, bool second_order) {
  TetMesh mesh = make_tet_box({.cells = {3, 2, 2}, .edge = 0.5, .split = split, .jitter = 0.1});
  if (second_order) add_middles(mesh);
  return mesh;
}

const Vec3& at(const TetMesh& mesh, Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

class MeshParts : public testing::TestWithParam<std::tuple<CubeSplit, bool>> {
 protected:
  TetMesh mesh = std::apply(box, GetParam());
};
INSTANTIATE_TEST_SUITE_P(Boxes, MeshParts,
                         testing::Combine(testing::Values(CubeSplit::five, CubeSplit::six), testing::Bool()));

TEST_P(MeshParts, OuterFacesAreClosedLookOutwardsAndHoldTheVolume) {
  const OuterFaces outer = outer_faces(mesh);
  EXPECT_EQ(outer.of_more, 0u);
  const std::size_t parts = std::get<1>(GetParam()) ? 4 : 1;
  EXPECT_EQ(outer.triangles.size(), parts * 2 * 2 * (3 * 2 + 3 * 2 + 2 * 2));
  double volume = 0, area = 0;
  std::map<std::pair<Index, Index>, int> edges;
  for (const auto& [a, b, c] : outer.triangles) {
    volume += at(mesh, a).dot(at(mesh, b).cross(at(mesh, c))) / 6;
    area += (at(mesh, b) - at(mesh, a)).cross(at(mesh, c) - at(mesh, a)).norm() / 2;
    ++edges[{a, b}], ++edges[{b, c}], ++edges[{c, a}];
  }
  EXPECT_NEAR(volume, 1.5 * 1 * 1, 1e-12);
  EXPECT_NEAR(area, 2 * (1.5 + 1.5 + 1), 1e-12);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((edges.count({edge.second, edge.first})), 1u) << "an open edge";
  }
}

TEST_P(MeshParts, FilledTetrahedraFillTheVolumeOnce) {
  double volume = 0;
  for (const auto& corners : filled_tets(mesh)) volume += std::abs(signed_volume(mesh, corners));
  EXPECT_NEAR(volume, 1.5, 1e-12);
  EXPECT_EQ(filled_tets(mesh).size(), mesh.tets.size() * (std::get<1>(GetParam()) ? 8 : 1));
}

TEST_P(MeshParts, NeighboursAreThoseOfACommonTetrahedron) {
  const NodeLists lists = neighbours_of(mesh);
  std::vector<std::set<Index>> expected(mesh.nodes.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::vector<Index> nodes(mesh.tets[t].begin(), mesh.tets[t].end());
    if (!mesh.middles.empty()) nodes.insert(nodes.end(), mesh.middles[t].begin(), mesh.middles[t].end());
    for (const Index a : nodes)
      for (const Index b : nodes)
        if (a != b) expected[static_cast<std::size_t>(a)].insert(b);
  }
  for (Index n = 0; n < static_cast<Index>(mesh.nodes.size()); ++n) {
    const auto list = lists.of(n);
    EXPECT_EQ(std::vector<Index>(list.begin(), list.end()),
              std::vector<Index>(expected[static_cast<std::size_t>(n)].begin(),
                                 expected[static_cast<std::size_t>(n)].end()));
  }
}

TEST(OuterFaces, OfAMeshThatGoesThroughItselfAreCounted) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 1, 5}};
  mesh.region = {0, 0, 0};
  EXPECT_EQ(outer_faces(mesh).of_more, 1u);
}

TEST(PartsOfFirst, AreListedByTheirFirstCorner) {
  const std::vector<MeshTriangle> parts = {{0, 1, 2}, {0, 2, 3}, {2, 3, 4}};
  const NodeLists lists = parts_of_first(5, parts);
  EXPECT_EQ(lists.of(0).size(), 2u);
  EXPECT_TRUE(lists.of(1).empty());
  ASSERT_EQ(lists.of(2).size(), 1u);
  EXPECT_EQ(lists.of(2).front(), 2);
  EXPECT_TRUE(lists.of(4).empty());
}

}  // namespace
}  // namespace palpate::physics
