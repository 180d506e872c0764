#include "render_node/model/surface_chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

void expect_boxes_round_their_triangles(const Surface& surface, const SurfaceChunks& chunks) {
  for (std::size_t c = 0; c < chunks.runs().size(); ++c) {
    Eigen::AlignedBox3f box;
    for (std::size_t i = 0; i < chunks.runs()[c].n; ++i)
      box.extend(Eigen::Vector3f(surface.position[chunks.indices()[chunks.runs()[c].first + i]].data()));
    EXPECT_EQ(box.min(), chunks.boxes()[c].min());
    EXPECT_EQ(box.max(), chunks.boxes()[c].max());
  }
}

TEST(SurfaceChunks, HoldEveryTriangleOnceInRunsWithoutGaps) {
  auto cube = test::cube_surface(20, 0.1, 0xff96b4e6U);
  cube.corners.push_back({0, 0, 0, 0});  // a mass
  cube.corners.push_back({0, 1, 1, 1});  // an element
  cube.corners.push_back({0, 1, 2, 2});  // a triangle
  cube.rgba.insert(cube.rgba.end(), 3, 0xff96b4e6U);
  const Surface surface = test::surface_of(cube);
  SurfaceChunks chunks;
  chunks.build(surface);
  std::multiset<Triangle> found, there;
  for (std::size_t i = 0; i < chunks.indices().size(); i += 3)
    found.insert({chunks.indices()[i], chunks.indices()[i + 1], chunks.indices()[i + 2]});
  for (const Corners& c : surface.corners) {
    if (is_loose(c)) continue;
    there.insert({c[0], c[1], c[2]});
    if (c[2] != c[3]) there.insert({c[0], c[2], c[3]});
  }
  EXPECT_EQ(found, there);
  std::size_t end = 0;
  for (const auto& run : chunks.runs()) {
    EXPECT_EQ(run.first, end);
    EXPECT_GT(run.n, 0U);
    end += run.n;
  }
  EXPECT_EQ(end, chunks.indices().size());
  EXPECT_GT(chunks.runs().size(), 40U);
  expect_boxes_round_their_triangles(surface, chunks);
}

TEST(SurfaceChunks, FollowWhatMoves) {
  Surface surface = test::surface_of(test::cube_surface(20, 0.1, 0xff96b4e6U));
  SurfaceChunks chunks;
  chunks.build(surface);
  std::mt19937 random(1);
  std::vector<std::uint32_t> moved;
  for (std::uint32_t v = 0; v < surface.position.size(); ++v) {
    if (surface.position[v][0] < 0.04F || surface.position[v][2] < 0.04F) continue;
    surface.position[v][1] += 0.01F;
    moved.push_back(v);
  }
  std::ranges::shuffle(moved, random);
  chunks.follow(surface, moved);
  expect_boxes_round_their_triangles(surface, chunks);
  EXPECT_GT(chunks.changed().size(), 0U);
  EXPECT_LT(chunks.changed().size(), chunks.runs().size() / 3);
  const std::set<std::uint32_t> each(chunks.changed().begin(), chunks.changed().end());
  EXPECT_EQ(each.size(), chunks.changed().size()) << "each once";
  // All chunks with a vertex that moved, and no other.
  for (std::uint32_t c = 0; c < chunks.runs().size(); ++c) {
    const auto first = chunks.indices().begin() + static_cast<std::ptrdiff_t>(chunks.runs()[c].first);
    const bool has = std::any_of(first, first + static_cast<std::ptrdiff_t>(chunks.runs()[c].n),
                                 [&](std::uint32_t v) { return std::ranges::count(moved, v) > 0; });
    EXPECT_EQ(has, each.contains(c));
  }
  chunks.follow(surface, {});
  EXPECT_TRUE(chunks.changed().empty());
}

/// Whatever is left out shows its back to the eye; and about a third of a ball is.
TEST(SurfaceChunks, FaceAwayWithAllTheirTriangles) {
  Surface ball = test::surface_of(test::cube_surface(40, 0.1, 0xff96b4e6U));
  for (Array3f& p : ball.position) {
    const Eigen::Vector3f round = 0.05F * Eigen::Vector3f(p.data()).normalized();
    p = {round.x(), round.y(), round.z()};
  }
  Surface cube = test::surface_of(test::cube_surface(20, 0.1, 0xff96b4e6U));
  std::mt19937 random(2);
  std::uniform_real_distribution<float> anywhere(-1, 1);
  for (const Surface* surface : {&ball, &cube}) {
    SurfaceChunks chunks;
    chunks.build(*surface);
    for (int n = 0; n < 40; ++n) {
      Eigen::Vector3f eye(anywhere(random), anywhere(random), anywhere(random));
      eye *= (0.1F + 0.01F * static_cast<float>(n)) / eye.norm();
      std::size_t away = 0;
      for (std::size_t c = 0; c < chunks.runs().size(); ++c) {
        if (!chunks.faces_away(c, eye)) continue;
        ++away;
        for (std::size_t i = 0; i < chunks.runs()[c].n; i += 3) {
          std::array<Eigen::Vector3f, 3> p;
          for (std::size_t k = 0; k < 3; ++k)
            p[k] =
                Eigen::Vector3f(surface->position[chunks.indices()[chunks.runs()[c].first + i + k]].data());
          EXPECT_LE((p[1] - p[0]).cross(p[2] - p[0]).dot(eye - p[0]), 0);
        }
      }
      EXPECT_GT(3 * away, surface == &ball ? chunks.runs().size() : 0) << eye.transpose();
    }
  }
}

TEST(SurfaceChunks, OfNothingAreNone) {
  SurfaceChunks chunks;
  Surface surface;
  chunks.build(surface);
  EXPECT_TRUE(chunks.runs().empty());
  chunks.follow(surface, {});
  EXPECT_TRUE(chunks.changed().empty());
}

}  // namespace
}  // namespace palpate::render
