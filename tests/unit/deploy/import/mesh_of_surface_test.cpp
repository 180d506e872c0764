// Tetrahedra that fill a closed surface.
#include "deploy/import/mesh_of_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/error/error.h"
#include "common/math/units.h"
#include "physics_node/mesh/mesh_parts.h"
#include "physics_node/mesh/mesh_pinches.h"
#include "physics_node/mesh/mesh_quality.h"
#include "tests/unit/deploy/import/made_surfaces.h"

namespace palpate::test {
namespace {

SurfaceMesh filled(const TriangleSurface& surface, double edge) {
  return mesh_of_surface(close_surface(surface, "a.obj"), {.edge = edge}, "a.obj");
}

/// Vertices - edges + triangles of the outside: 2 for each part of it without a hole, 0 of a ring.
long euler_number(const physics::TetMesh& mesh) {
  const physics::OuterFaces faces = outer_faces(mesh);
  std::set<physics::Index> nodes;
  std::set<std::pair<physics::Index, physics::Index>> edges;
  for (const auto& t : faces.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      nodes.insert(t[n]);
      edges.insert(std::minmax(t[n], t[(n + 1) % 3]));
    }
  return static_cast<long>(nodes.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(faces.triangles.size());
}

/// Largest of outer nodes. @param distance  from the surface
template <class Distance>
double farthest_outer(const physics::TetMesh& mesh, const Distance& distance) {
  double far = 0;
  for (const auto& t : outer_faces(mesh).triangles)
    for (const physics::Index node : t)
      far = std::max(far, std::abs(distance(mesh.nodes[static_cast<std::size_t>(node)])));
  return far;
}

TEST(MeshOfSurface, HasTheTopologyAndThePlaceOfTheSurface) {
  const SurfaceMesh ball = filled(made_ball(0.02, Vec3(0.1, 0.2, 0.3)), 0.005);
  EXPECT_EQ(euler_number(ball.mesh), 2);
  EXPECT_EQ(ball.pieces, 1U);
  // Chords of the ball's own triangles are up to 0.03 mm inside of the sphere.
  EXPECT_LT(farthest_outer(ball.mesh, [](const Vec3& x) { return (x - Vec3(0.1, 0.2, 0.3)).norm() - 0.02; }),
            4e-5);
  const SurfaceMesh torus = filled(made_torus(0.03, 0.01), 0.003);
  EXPECT_EQ(euler_number(torus.mesh), 0);
  EXPECT_LT(
      farthest_outer(torus.mesh,
                     [](const Vec3& x) { return std::hypot(std::hypot(x.x(), x.y()) - 0.03, x.z()) - 0.01; }),
      1.2e-4);
  const SurfaceMesh shell = filled(both(made_ball(0.03), made_ball(0.015)), 0.005);
  EXPECT_EQ(euler_number(shell.mesh), 4);
  EXPECT_EQ(shell.pieces, 1U);
  EXPECT_NEAR(shell.filled, 4.0 / 3 * std::numbers::pi * (27e-6 - 3.375e-6), 0.02 * shell.filled);
}

/// The error of chords: a quarter of it at half the edge, or less.
TEST(MeshOfSurface, FillsMoreOfItWithSmallerTetrahedra) {
  const TriangleSurface surface = made_ball(0.02);
  const double volume = enclosed_volume(surface);
  const double coarse = 1 - filled(surface, 0.008).filled / volume,
               fine = 1 - filled(surface, 0.004).filled / volume;
  EXPECT_GT(fine, 0);
  EXPECT_LT(fine, 0.03);
  EXPECT_GT(coarse / fine, 3);
}

TEST(MeshOfSurface, IsOfGoodShape) {
  for (const TriangleSurface& surface : {made_ball(0.02), made_torus(0.03, 0.01), made_cube(0.03)}) {
    const physics::TetMesh mesh = filled(surface, 0.004).mesh;
    EXPECT_TRUE(pinches_of(mesh, outer_faces(mesh)).none());
    EXPECT_GT(deg_from_rad(dihedral_angles(mesh).least), 12);
    EXPECT_LT(deg_from_rad(dihedral_angles(mesh).largest), 158);
  }
}

TEST(MeshOfSurface, FillsWhatCutsThroughItselfOnce) {
  TriangleSurface ball = made_ball(0.02);
  ball.points[0] = Vec3(0.0001, 0.0002, 0.021);  // the lower pole a spike through the upper one
  const SurfaceMesh spiked = filled(ball, 0.002);
  EXPECT_EQ(outer_faces(spiked.mesh).of_more, 0U);
  EXPECT_TRUE(pinches_of(spiked.mesh, outer_faces(spiked.mesh)).none());
}

TEST(MeshOfSurface, SaysWhatCannotBeFilled) {
  const auto complaint = [](const TriangleSurface& surface, double edge) -> std::string {
    try {
      filled(surface, edge);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(
      complaint(made_ball(0.02), 0.05),
      testing::MatchesRegex("a.obj: tetrahedra of 50 mm are too coarse for this surface: they fill .* cm3 of "
                            "its 33.4; write a smaller --tetrahedra-mm"));
  EXPECT_EQ(complaint(made_cube(0.02), 1e-5),
            "a.obj: tetrahedra of 0.01 mm in a box of 20 x 20 x 20 mm are too many; write --tetrahedra-mm "
            "0.21 or more");
}

TEST(MeshOfSurface, IsTheSameEveryTime) {
  const physics::TetMesh one = filled(made_torus(0.03, 0.01), 0.004).mesh,
                         two = filled(made_torus(0.03, 0.01), 0.004).mesh;
  EXPECT_EQ(one.tets, two.tets);
  EXPECT_EQ(one.nodes, two.nodes);
}

}  // namespace
}  // namespace palpate::test
