#include "physics_node/mesh/mesh_pinches.h"

#include <gtest/gtest.h>

#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

Pinches pinches(const TetMesh& mesh) { return pinches_of(mesh, outer_faces(mesh)); }

/// Two tetrahedra that share so many of their corners.
TetMesh two_that_share(std::size_t n) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}, {-1, 0, -1}, {-1, -1, 0}, {3, 3, 3}};
  mesh.tets = {{0, 1, 2, 3}, {}};
  for (std::size_t a = 0; a < 4; ++a) mesh.tets[1][a] = static_cast<Index>(a < n ? a : 4 + a - n);
  mesh.region = {0, 0};
  tidy(mesh);
  return mesh;
}

TEST(Pinches, HasNoneWhereTetrahedraShareFaces) {
  EXPECT_TRUE(pinches(make_tet_box({.cells = {3, 2, 2}})).none());
  EXPECT_TRUE(pinches(two_that_share(0)).none());
  EXPECT_TRUE(pinches(two_that_share(3)).none());
}

TEST(Pinches, FindsASharedEdgeAndASharedCorner) {
  const Pinches edge = pinches(two_that_share(2));
  EXPECT_EQ(edge.edges, 1U);
  EXPECT_EQ(edge.nodes, 0U) << "its ends are counted with it";
  EXPECT_LT((edge.where - Vec3(0.5, 0, 0)).norm(), 1e-12);
  const Pinches corner = pinches(two_that_share(1));
  EXPECT_EQ(corner.edges, 0U);
  EXPECT_EQ(corner.nodes, 1U);
  EXPECT_LT(corner.where.norm(), 1e-12);
}

TEST(Pieces, HangTogetherOverFacesAlone) {
  EXPECT_EQ(n_pieces_of(make_tet_box({.cells = {3, 2, 2}})), 1U);
  EXPECT_EQ(n_pieces_of(two_that_share(3)), 1U);
  for (const std::size_t n : {0U, 1U, 2U}) EXPECT_EQ(n_pieces_of(two_that_share(n)), 2U) << n;
  EXPECT_EQ(pieces_of(two_that_share(2)), (std::vector<Index>{0, 1}));
  EXPECT_EQ(n_pieces_of({}), 0U);
}

}  // namespace
}  // namespace palpate::physics
