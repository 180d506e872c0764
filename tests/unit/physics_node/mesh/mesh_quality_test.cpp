#include "physics_node/mesh/mesh_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

TEST(DihedralAngles, OfAnEquilateralTetrahedronAreAlike) {
  TetMesh mesh;
  mesh.nodes = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  const DihedralAngles angles = dihedral_angles(mesh);
  EXPECT_NEAR(angles.least, std::acos(1.0 / 3), 1e-12);
  EXPECT_NEAR(angles.largest, std::acos(1.0 / 3), 1e-12);
}

TEST(DihedralAngles, OfACubeInSixAreThoseOfItsPlanes) {
  const DihedralAngles angles = dihedral_angles(make_tet_box({.cells = {2, 2, 2}}));
  EXPECT_NEAR(angles.least, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(angles.largest, std::numbers::pi / 2, 1e-12);
}

TEST(DihedralAngles, OfASliverAreNearNothingAndHalfATurn) {
  TetMesh mesh;
  mesh.nodes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 1e-3}, {0, -1, 1e-3}};
  mesh.tets = {{0, 1, 2, 3}};
  const DihedralAngles angles = dihedral_angles(mesh);
  EXPECT_LT(angles.least, 0.003);
  EXPECT_GT(angles.largest, std::numbers::pi - 0.003);
}

TEST(SmallestAltitude, IsThatOverTheLargestFace) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {1, 1, 0.5}};
  mesh.tets = {{0, 1, 2, 3}};
  EXPECT_NEAR(smallest_altitude(mesh), 0.5, 1e-12);
}

}  // namespace
}  // namespace palpate::physics
