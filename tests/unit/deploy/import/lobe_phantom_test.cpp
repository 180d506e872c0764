// The made lobe: tetrahedra that are good for stepping, and a file that comes back.
#include "deploy/import/lobe_phantom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/math/units.h"
#include "physics_node/mesh/mesh_parts.h"
#include "physics_node/mesh/mesh_quality.h"
#include "physics_node/mesh/read_msh.h"
#include "physics_node/mesh/write_msh.h"

namespace palpate {
namespace {

TEST(LobePhantom, HasGoodTetrahedra) {
  const physics::TetMesh mesh = lobe_phantom();
  EXPECT_EQ(mesh.tets.size(), 6336u);
  EXPECT_EQ(mesh.nodes.size(), 1428u);
  const physics::DihedralAngles angles = physics::dihedral_angles(mesh);
  EXPECT_GT(deg_from_rad(angles.least), 18);
  EXPECT_LT(deg_from_rad(angles.largest), 148);
  const physics::OuterFaces outer = physics::outer_faces(mesh);
  EXPECT_EQ(outer.of_more, 0u);
  EXPECT_EQ(outer.triangles.size(), 2u * 2 * (16 * 11 + 16 * 6 + 11 * 6));
  double volume = 0;
  for (const auto& corners : mesh.tets) {
    EXPECT_GT(physics::signed_volume(mesh, corners), 15e-9);
    volume += physics::signed_volume(mesh, corners);
  }
  EXPECT_NEAR(volume, 322e-6, 5e-6);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.nodes) box.extend(x);
  EXPECT_LT((box.sizes() - Vec3(0.120, 0.0855, 0.0477)).cwiseAbs().maxCoeff(), 0.0005);
}

TEST(LobePhantom, ComesBackFromItsFileWithoutAMend) {
  const physics::TetMesh mesh = lobe_phantom();
  const physics::MshContent back = physics::parse_msh(physics::msh_text(mesh, lobe_unit), "lobe", lobe_unit);
  EXPECT_EQ(back.mesh.tets, mesh.tets);
  EXPECT_EQ(back.tidied.turned + back.tidied.unused, 0u);
}

}  // namespace
}  // namespace palpate
