#include "render_node/model/surface_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

using test::voxel_surface;

test::VoxelSurface ball(int n) {
  const double middle = (n - 1) / 2.0, radius = n / 2.0 - 1;
  return voxel_surface(
      {n, n, n}, {1, 1, 1}, {-n / 2.0, -n / 2.0, -n / 2.0},
      [=](int i, int j, int k) { return std::hypot(i - middle, j - middle, k - middle) < radius; },
      [](int, int, int) { return 0xffffffffU; });
}

double worst_degrees(const test::VoxelSurface& surface, const SurfaceNormals& normals) {
  double worst = 0;
  for (std::size_t v = 0; v < surface.position.size(); ++v) {
    const auto& p = surface.position[v];
    const Eigen::Vector3f radial = Eigen::Vector3f(p[0], p[1], p[2]).normalized();
    const float along = std::min(1.0F, normals.normals()[v].dot(radial));
    worst = std::max(worst, std::acos(static_cast<double>(along)) * 57.29578);
  }
  return worst;
}

TEST(SurfaceNormals, PointOutwardsAndAreUnit) {
  const auto surface = ball(24);
  SurfaceNormals normals;
  normals.rebuild(surface.position, surface.corners);
  for (std::size_t v = 0; v < surface.position.size(); ++v) {
    const auto& p = surface.position[v];
    EXPECT_NEAR(normals.normals()[v].norm(), 1.0F, 1e-5F);
    EXPECT_GT(normals.normals()[v].dot(Eigen::Vector3f(p[0], p[1], p[2])), 0.0F);
  }
}

TEST(SurfaceNormals, SmoothingBringsAVoxelBallNearerToABall) {
  const auto surface = ball(40);
  SurfaceNormals raw(0), smooth;
  raw.rebuild(surface.position, surface.corners);
  smooth.rebuild(surface.position, surface.corners);
  EXPECT_GT(worst_degrees(surface, raw), 30.0);
  EXPECT_LT(worst_degrees(surface, smooth), 15.0);
}

TEST(SurfaceNormals, AreExactOnAPlane) {
  const auto surface = test::cube_surface(20, 1.0, 0xffffffffU);
  SurfaceNormals normals(3);
  normals.rebuild(surface.position, surface.corners);
  for (std::size_t v = 0; v < surface.position.size(); ++v) {
    const auto& p = surface.position[v];
    if (p[2] < 0.49F || std::abs(p[0]) > 0.2F || std::abs(p[1]) > 0.2F) continue;
    EXPECT_NEAR(normals.normals()[v].z(), 1.0F, 1e-6F);
  }
}

TEST(SurfaceNormals, TakeATriangleThatRepeatsItsLastCorner) {
  const std::vector<Array3f> position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Corners> corners = {{0, 1, 2, 2}};
  SurfaceNormals normals(0);
  normals.rebuild(position, corners);
  for (const auto& n : normals.normals()) EXPECT_EQ(n, Eigen::Vector3f::UnitZ());
}

TEST(SurfaceNormals, AnUpdateGivesTheSameBitsAsARebuild) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto surface = ball(20);
    SurfaceNormals updated;
    updated.rebuild(surface.position, surface.corners);
    std::mt19937_64 random(seed);
    std::vector<std::uint32_t> moved;
    for (std::uint32_t v = 0; v < surface.position.size(); ++v) {
      if (random() % 50 != 0) continue;
      moved.push_back(v);
      surface.position[v][2] += 0.3F * static_cast<float>(random() % 1000) / 1000.0F;
    }
    const auto changed = updated.update(surface.position, surface.corners, moved);
    EXPECT_LE(changed.size(), surface.position.size());
    SurfaceNormals rebuilt;
    rebuilt.rebuild(surface.position, surface.corners);
    for (std::size_t v = 0; v < surface.position.size(); ++v) {
      ASSERT_EQ(updated.normals()[v], rebuilt.normals()[v]) << "seed " << seed << ", vertex " << v;
    }
  }
}

}  // namespace
}  // namespace palpate::render
