// A mesh cut along a field: nothing is lost, both sides share nodes, and tetrahedra stay of good shape.
#include "deploy/import/split_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/math/units.h"
#include "deploy/import/stuffing.h"
#include "physics_node/mesh/mesh_pinches.h"
#include "physics_node/mesh/mesh_quality.h"

namespace palpate {
namespace {

physics::TetMesh ball_of_30_mm() {
  return stuff({.low = Vec3::Constant(-0.03), .high = Vec3::Constant(0.03), .edge = 0.008},
               [](const Vec3& x) { return 0.03 - x.norm(); });
}

struct Sides {
  double above = 0, below = 0;       // volumes [m^3]
  std::set<physics::Index> of_both;  // nodes
};

Sides sides_of(const physics::TetMesh& mesh, const SplitMesh& split) {
  Sides sides;
  std::set<physics::Index> above;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    (split.above[t] ? sides.above : sides.below) += signed_volume(mesh, mesh.tets[t]);
    if (split.above[t]) above.insert(mesh.tets[t].begin(), mesh.tets[t].end());
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const physics::Index node : mesh.tets[t])
      if (!split.above[t] && above.count(node) > 0) sides.of_both.insert(node);
  return sides;
}

TEST(SplitMesh, CutsABallInTwoWhereverThePlaneLies) {
  for (int n = 0; n < 12; ++n) {
    const Vec3 normal = Vec3(std::sin(n), std::cos(2.0 * n), std::sin(3.0 * n + 1)).normalized();
    const double height = 0.0015 * n;
    const auto field = [&](const Vec3& x) { return x.dot(normal) - height; };
    physics::TetMesh mesh = ball_of_30_mm();
    const double whole = volume_of(mesh);
    const std::size_t faces = outer_faces(mesh).triangles.size();
    const SplitMesh split = split_mesh(mesh, field);
    ASSERT_EQ(split.above.size(), mesh.tets.size());
    EXPECT_EQ(mesh.region.size(), mesh.tets.size());
    EXPECT_NEAR(volume_of(mesh), whole, 2e-3 * whole) << n;
    const Sides sides = sides_of(mesh, split);
    const double cap =
        std::pow(0.03 - height, 2) * (0.06 + height) / (4 * std::pow(0.03, 3));  // share of a ball
    EXPECT_NEAR(sides.above / whole, cap, 0.02) << n;
    // No face has lost its neighbour, and none has three.
    const physics::OuterFaces outer = outer_faces(mesh);
    EXPECT_EQ(outer.of_more, 0U) << n;
    EXPECT_GT(outer.triangles.size(), faces) << n;
    EXPECT_LT(outer.triangles.size(), 2 * faces) << n;
    EXPECT_TRUE(pinches_of(mesh, outer).none()) << n;
    EXPECT_EQ(n_pieces_of(mesh), 1U) << n;
    std::size_t on = 0;
    for (const physics::Index node : sides.of_both) {
      const double off = std::abs(field(mesh.nodes[static_cast<std::size_t>(node)]));
      on += off < 1e-8 ? 1 : 0;
      EXPECT_LT(off, 0.33 * 0.008) << n;
    }
    EXPECT_GT(on, 0.8 * static_cast<double>(sides.of_both.size())) << n;
    EXPECT_GT(deg_from_rad(dihedral_angles(mesh).least), 8) << n;
    EXPECT_LT(deg_from_rad(dihedral_angles(mesh).largest), 165) << n;
  }
}

TEST(SplitMesh, LeavesAMeshOnOneSideAsItIs) {
  physics::TetMesh mesh = ball_of_30_mm();
  mesh.region.back() = 7;
  const physics::TetMesh before = mesh;
  const SplitMesh split = split_mesh(mesh, [](const Vec3&) { return 0.0; });
  EXPECT_EQ(mesh.nodes, before.nodes);
  EXPECT_EQ(mesh.tets, before.tets);
  EXPECT_EQ(mesh.region, before.region);
  EXPECT_EQ(split.above, std::vector<bool>(mesh.tets.size(), true));
}

TEST(SplitMesh, KnowsWhatEachTetrahedronWasPartOf) {
  physics::TetMesh mesh = ball_of_30_mm();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.region[t] = static_cast<int>(t);
  const SplitMesh split = split_mesh(mesh, [](const Vec3& x) { return 0.015 - x.norm(); });
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    EXPECT_EQ(mesh.region[t], static_cast<int>(split.parent[t]));
  const double ball = 4.0 / 3 * 3.14159 * std::pow(0.015, 3);  // of which chords take some
  EXPECT_NEAR(sides_of(mesh, split).above, 0.94 * ball, 0.04 * ball);
}

/// Whichever way it is cut: the outside of both sides together encloses both.
TEST(SplitMesh, MakesBothSidesOfATetrahedronMeet) {
  std::uint32_t seed = 1;
  const auto random = [&seed] { return (seed = seed * 1664525U + 1013904223U) / 4294967296.0 - 0.5; };
  for (int n = 0; n < 3000; ++n) {
    physics::TetMesh mesh;
    for (int corner = 0; corner < 4; ++corner) mesh.nodes.emplace_back(random(), random(), random());
    mesh.tets = {{0, 1, 2, 3}};
    mesh.region = {0};
    tidy(mesh);
    const double volume = volume_of(mesh);
    if (volume < 0.01) continue;
    const Vec3 normal(random(), random(), random());
    split_mesh(mesh, [&](const Vec3& x) { return x.dot(normal); });
    double outside = 0;  // by the divergence theorem
    for (const auto& t : outer_faces(mesh).triangles) {
      const auto at = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(t[c])]; };
      outside += at(0).dot(at(1).cross(at(2))) / 6;
    }
    EXPECT_NEAR(outside, volume_of(mesh), 1e-12) << n;
    EXPECT_TRUE(pinches_of(mesh, outer_faces(mesh)).none()) << n;
    EXPECT_EQ(n_pieces_of(mesh), 1U) << n;
  }
}

}  // namespace
}  // namespace palpate
