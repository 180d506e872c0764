// Closed surfaces of triangles: their edges, what they enclose, and where they come from.
#include "physics_node/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics_node/mesh/tet_box.h"
#include "tests/support/physics/made_sphere.h"

namespace palpate::physics {
namespace {

TEST(TriangleMesh, OfASphereIsClosedAndFollowsEuler) {
  const TriangleMesh sphere = test::made_sphere(0.02, 3);
  const auto edges = edges_of(sphere);
  EXPECT_EQ(sphere.triangles.size(), 1280u);
  EXPECT_EQ(sphere.nodes.size() - edges.size() + sphere.triangles.size(), 2u);
  EXPECT_EQ(open_edges(sphere), 0u);
  EXPECT_NEAR(enclosed_volume(sphere), 4 * std::numbers::pi / 3 * std::pow(0.02, 3), 3e-2 * 3.35e-5);
  double area = 0;
  for (const MeshTriangle& corners : sphere.triangles) area += area_of(sphere, corners);
  EXPECT_NEAR(area, 4 * std::numbers::pi * 4e-4, 0.02 * area);
}

TEST(TriangleMesh, EnclosesTheSameWhereverItLies) {
  TriangleMesh sphere = test::made_sphere(0.02, 2);
  const double volume = enclosed_volume(sphere);
  for (Vec3& x : sphere.nodes) x += Vec3(10, -20, 30);
  EXPECT_NEAR(enclosed_volume(sphere), volume, 1e-9 * volume);
  for (MeshTriangle& corners : sphere.triangles) std::swap(corners[0], corners[1]);
  EXPECT_NEAR(enclosed_volume(sphere), -volume, 1e-9 * volume) << "inside out";
}

TEST(TriangleMesh, EveryEdgeKnowsBothItsTriangles) {
  const TriangleMesh sphere = test::made_sphere(1, 1);
  for (const MeshEdge& edge : edges_of(sphere)) {
    EXPECT_LT(edge.node[0], edge.node[1]);
    EXPECT_NE(edge.triangle[0], edge.triangle[1]);
    for (const Index t : edge.triangle)
      for (const Index node : edge.node) {
        const MeshTriangle& corners = sphere.triangles[static_cast<std::size_t>(t)];
        EXPECT_EQ(std::count(corners.begin(), corners.end(), node), 1);
      }
  }
}

TEST(TriangleMesh, AHoleAnExtraTriangleAndATurnedOneAreOpen) {
  TriangleMesh sphere = test::made_sphere(1, 1);
  const TriangleMesh whole = sphere;
  sphere.triangles.pop_back();
  EXPECT_EQ(open_edges(sphere), 3u);
  sphere = whole;
  sphere.triangles.push_back(sphere.triangles.front());
  EXPECT_EQ(open_edges(sphere), 3u);
  sphere = whole;
  std::swap(sphere.triangles.front()[0], sphere.triangles.front()[1]);
  EXPECT_EQ(open_edges(sphere), 3u);
}

TEST(TriangleMesh, OfTetrahedraIsTheirOuterFacesAndNoOtherNodes) {
  const TetMesh box = make_tet_box({.cells = {3, 3, 3}, .edge = 0.01, .jitter = 0});
  const TriangleMesh outer = outer_surface(box);
  EXPECT_EQ(outer.triangles.size(), 6u * 9u * 2u);
  EXPECT_EQ(outer.nodes.size(), 64u - 8u);
  EXPECT_EQ(open_edges(outer), 0u);
  EXPECT_NEAR(enclosed_volume(outer), 27e-6, 1e-15);
}

TEST(TriangleMesh, WithoutAreaIsFlat) {
  TriangleMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-7, 0}, {0.5, 1e-3, 0}};
  EXPECT_TRUE(is_flat(mesh, {0, 1, 2}));
  EXPECT_FALSE(is_flat(mesh, {0, 1, 3}));
  EXPECT_TRUE(is_flat(mesh, {0, 0, 3}));
}

}  // namespace
}  // namespace palpate::physics
