// Boxes of tetrahedra fill their box, meet face to face, and keep doing so when their inner nodes are jittered.

#include "physics_node/mesh/tet_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace palpate::physics {
namespace {

class Boxes : public testing::TestWithParam<std::tuple<CubeSplit, double>> {
 protected:
  TetBox box{
      .cells = {4, 3, 5}, .edge = 0.002, .split = std::get<0>(GetParam()), .jitter = std::get<1>(GetParam())};
  TetMesh mesh = make_tet_box(box);
};

TEST_P(Boxes, FillTheirBox) {
  EXPECT_EQ(mesh.nodes.size(), 5U * 4U * 6U);
  EXPECT_EQ(mesh.tets.size(), (box.split == CubeSplit::five ? 5U : 6U) * 60U);
  double volume = 0;
  for (const auto& corners : mesh.tets) {
    EXPECT_GT(signed_volume(mesh, corners), 0.02 * std::pow(box.edge, 3));
    EXPECT_FALSE(is_flat(mesh, corners));
    volume += signed_volume(mesh, corners);
  }
  EXPECT_NEAR(volume, 60 * std::pow(box.edge, 3), 1e-12 * volume);
}

TEST_P(Boxes, MeetFaceToFace) {
  std::map<std::array<Index, 3>, int> faces;
  for (const auto& c : mesh.tets)
    for (std::size_t away = 0; away < 4; ++away) {
      std::array<Index, 3> face{c[(away + 1) % 4], c[(away + 2) % 4], c[(away + 3) % 4]};
      std::ranges::sort(face);
      ++faces[face];
    }
  const auto once = std::ranges::count_if(faces, [](const auto& face) { return face.second == 1; });
  EXPECT_EQ(once, 2 * 2 * (4 * 3 + 3 * 5 + 4 * 5)) << "two triangles a square of the outside";
  EXPECT_TRUE(std::ranges::all_of(faces, [](const auto& face) { return face.second <= 2; }));
}

INSTANTIATE_TEST_SUITE_P(Splits, Boxes,
                         testing::Combine(testing::Values(CubeSplit::five, CubeSplit::six),
                                          testing::Values(0, 0.15)));

TEST(TetBox, JitterMovesInnerNodesOnly) {
  const TetMesh even = make_tet_box({.cells = {3, 3, 3}}),
                odd = make_tet_box({.cells = {3, 3, 3}, .jitter = 0.1});
  int moved = 0;
  for (std::size_t n = 0; n < even.nodes.size(); ++n) {
    EXPECT_LE((even.nodes[n] - odd.nodes[n]).cwiseAbs().maxCoeff(), 0.1);
    if (even.nodes[n] != odd.nodes[n]) ++moved;
  }
  EXPECT_EQ(moved, 8);
}

}  // namespace
}  // namespace palpate::physics
