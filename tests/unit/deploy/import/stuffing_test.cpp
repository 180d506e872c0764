// Tetrahedra that fill a field: closed, of good shape, on its surface, wherever the lattice lies.
#include "deploy/import/stuffing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "common/math/units.h"
#include "physics_node/mesh/mesh_pinches.h"
#include "physics_node/mesh/mesh_quality.h"

namespace palpate {
namespace {

using physics::TetMesh;

constexpr double radius = 0.03;  // [m]
const Vec3 middle(0.011, -0.007, 0.005);

double in_ball(const Vec3& x) { return radius - (x - middle).norm(); }
/// A ring with a hole of a third of its breadth.
double in_ring(const Vec3& x) { return 0.012 - std::hypot(std::hypot(x.x(), x.y()) - 0.024, x.z()); }

StuffingLattice lattice(double edge, const Vec3& shift = Vec3::Zero()) {
  return {.low = Vec3::Constant(-0.05), .high = Vec3::Constant(0.05), .edge = edge, .shift = shift};
}

/// Vertices - edges + triangles of the surface: 2 of a ball, 0 of a ring.
long euler(const TetMesh& mesh) {
  const physics::OuterFaces faces = outer_faces(mesh);
  std::set<physics::Index> nodes;
  std::set<std::pair<physics::Index, physics::Index>> edges;
  for (const auto& triangle : faces.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      nodes.insert(triangle[n]);
      edges.insert(std::minmax(triangle[n], triangle[(n + 1) % 3]));
    }
  return static_cast<long>(nodes.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(faces.triangles.size());
}

Vec3 shift_of(int n) {  // spread, and some in the planes of symmetry
  if (n < 4) return Vec3::Constant(n / 4.0);
  const Vec3 far = n * Vec3(0.819, 0.671, 0.550);
  return far - far.array().floor().matrix();
}

TEST(Stuffing, IsClosedAndOfGoodShapeWhereverTheLatticeLies) {
  for (int n = 0; n < 24; ++n) {
    const TetMesh mesh = stuff(lattice(0.012, shift_of(n)), in_ball);
    EXPECT_TRUE(pinches_of(mesh, outer_faces(mesh)).none()) << n;
    EXPECT_EQ(outer_faces(mesh).of_more, 0U) << n;
    EXPECT_EQ(euler(mesh), 2) << n;
    EXPECT_EQ(n_pieces_of(mesh), 1U) << n;
    const physics::DihedralAngles angles = dihedral_angles(mesh);
    EXPECT_GT(deg_from_rad(angles.least), 12) << n;
    EXPECT_LT(deg_from_rad(angles.largest), 158) << n;
    const TetMesh ring = stuff(lattice(0.008, shift_of(n)), in_ring);
    EXPECT_TRUE(pinches_of(ring, outer_faces(ring)).none()) << n;
    EXPECT_EQ(euler(ring), 0) << n;
    EXPECT_GT(deg_from_rad(dihedral_angles(ring).least), 11) << n;
  }
}

TEST(Stuffing, HasItsSurfaceOnTheField) {
  const TetMesh mesh = stuff(lattice(0.009), in_ball);
  for (const auto& triangle : outer_faces(mesh).triangles)
    for (const physics::Index node : triangle)
      EXPECT_NEAR(in_ball(mesh.nodes[static_cast<std::size_t>(node)]), 0, 1e-9);
}

TEST(Stuffing, ComesToTheVolumeWithTheSquareOfTheEdge) {
  const double ball = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  const double coarse = volume_of(stuff(lattice(0.012), in_ball)) / ball - 1;
  const double fine = volume_of(stuff(lattice(0.006), in_ball)) / ball - 1;
  EXPECT_LT(coarse, -0.02);  // of chords
  EXPECT_GT(coarse, -0.08);
  EXPECT_NEAR(fine / coarse, 0.25, 0.06);
}

TEST(Stuffing, GivesTheSameBitsTwiceAndNothingOfNothing) {
  const TetMesh one = stuff(lattice(0.01), in_ring), other = stuff(lattice(0.01), in_ring);
  EXPECT_EQ(one.tets, other.tets);
  EXPECT_TRUE(std::ranges::equal(one.nodes, other.nodes));
  EXPECT_TRUE(stuff(lattice(0.01), [](const Vec3&) { return -1.0; }).tets.empty());
}

/// A face that runs through points of the lattice: their field is neither above nor below.
TEST(Stuffing, TakesASurfaceThroughThePointsOfTheLattice) {
  const double edge = 0.01;
  const auto in_slab = [&](const Vec3& x) {
    return std::min(edge - std::abs(x.z()), 0.03 - x.head<2>().norm());
  };
  StuffingLattice spec{.low = Vec3(-0.03, -0.03, -0.01), .high = Vec3(0.03, 0.03, 0.01), .edge = edge};
  const TetMesh mesh = stuff(spec, in_slab);
  EXPECT_TRUE(pinches_of(mesh, outer_faces(mesh)).none());
  EXPECT_NEAR(volume_of(mesh), std::numbers::pi * 0.03 * 0.03 * 0.02,
              0.1 * std::numbers::pi * 0.03 * 0.03 * 0.02);
  EXPECT_GT(deg_from_rad(dihedral_angles(mesh).least), 8);
}

}  // namespace
}  // namespace palpate
