// A mesh as others see and touch it: its surface, the nodes and triangles that can be met, and what is inside it.
#include <gtest/gtest.h>

#include <set>

#include "physics_node/boundary/boundary.h"
#include "physics_node/boundary/exposed_nodes.h"
#include "physics_node/boundary/exposed_triangles.h"
#include "physics_node/boundary/filled_volumes.h"
#include "physics_node/boundary/loose_parts.h"
#include "tests/support/physics/mesh_worlds.h"
#include "tests/support/physics/surface_volume.h"

namespace palpate::physics::test {
namespace {

class MeshSurface : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    moving = make_body_model(body_of(mesh_box({4, 3, 2}, 0.01, GetParam())), Precision::double_);
  }
  std::unique_ptr<BodyModel> moving;
  static constexpr double volume = 0.04 * 0.03 * 0.02;
  std::size_t parts() const { return std::string(GetParam()) == "second_order" ? 4 : 1; }
};
INSTANTIATE_TEST_SUITE_P(Elements, MeshSurface, testing::Values("plain", "nodal_pressure", "second_order"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(MeshSurface, HoldsTheVolumeOfTheBody) {
  Surface surface = make_surface(*moving, std::nullopt, 0xFF112233);
  EXPECT_EQ(surface.facets.size(), parts() * 2 * 2 * (4 * 3 + 4 * 2 + 3 * 2));
  EXPECT_EQ(surface.n_moving(), surface.n_vertices());
  EXPECT_NEAR(volume_inside(surface), volume, 1e-9 * volume + 1e-14);
  EXPECT_EQ(surface.rgba.front(), 0xFF112233);
  add_loose_parts(moving->body(), LiveElements(*moving), std::nullopt, 0, surface);
  EXPECT_EQ(count_loose(surface), 0u);
}

TEST_P(MeshSurface, FollowsTheNodes) {
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  const Index node = surface.cell[5];
  moving->place(node, {0.001, 0.002, 0.003}, Vec3::Zero());
  EXPECT_LT((surface.position(5, *moving) - surface.rest[5] - Vec3(0.001, 0.002, 0.003)).norm(), 1e-15);
}

TEST_P(MeshSurface, IsMetAtTheSameNodesAndTriangles) {
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  const ExposedNodes exposed(moving->body(), true);
  const std::set<Index> of_surface(surface.cell.begin(), surface.cell.end());
  for (const Index node : moving->body().nodes())
    EXPECT_EQ(exposed.contains(node, moving->adjacency()), of_surface.count(node) == 1);
  const ExposedTriangles triangles(moving->body());
  std::size_t n = 0;
  for (const Index node : moving->body().nodes()) {
    std::size_t of_node = 0;
    triangles.each(
        node, moving->adjacency(), [](Index) { return true; }, [&](Index, Index) { ++of_node; });
    EXPECT_LE(of_node, triangles.most(1));
    n += of_node;
  }
  EXPECT_EQ(n, surface.facets.size());
}

TEST_P(MeshSurface, IsTouchedAtItsFacets) {
  const Boundary boundary(*moving, 0.04, true);
  std::vector<std::uint32_t> near;
  boundary.facets_near({0, 0, 0.01}, 0.006, *moving, near);
  ASSERT_FALSE(near.empty());
  for (const std::uint32_t facet : near) {
    EXPECT_TRUE(boundary.is_triangle(facet));
    EXPECT_GT(boundary.rest_area(facet).z(), 0) << "faces up";
    EXPECT_GE(boundary.mass(facet, 0), 0);
  }
}

TEST_P(MeshSurface, IsFilledByItsTetrahedra) {
  const FilledVolumes volumes(*moving);
  double sum = 0;
  for (const Index node : moving->body().nodes())
    volumes.each(node, [&](const std::array<Vec3, 4>& x) {
      sum += std::abs((x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]))) / 6;
    });
  EXPECT_NEAR(sum, volume, 1e-9 * volume + 1e-14);
}

}  // namespace
}  // namespace palpate::physics::test
