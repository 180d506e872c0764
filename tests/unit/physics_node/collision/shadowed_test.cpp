#include "physics_node/collision/shadowed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics_node/collision/pair_search.h"
#include "physics_node/collision/point_triangle.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Dice;

struct Line {
  std::array<PairEnd, 4> end{};
  Vec3 weight = Vec3::Zero();
  double distance = 0;
  Vec3 at = Vec3::Zero();
};

struct Mesh {
  std::vector<Vec3> corner;
  std::vector<std::array<std::uint32_t, 3>> facet;
  Triangle triangle(std::size_t f) const {
    return {corner[facet[f][0]], corner[facet[f][1]], corner[facet[f][2]]};
  }
};

/// A square of n x n cells of 1 m, two facets each, at the heights given.
template <class Height>
Mesh sheet(std::uint32_t n, const Height& height) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) mesh.corner.emplace_back(i, j, height(i, j));
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.facet.push_back((i + j) % 2 == 0 ? std::array{a, b, d} : std::array{a, b, c});
      mesh.facet.push_back((i + j) % 2 == 0 ? std::array{a, d, c} : std::array{b, d, c});
    }
  return mesh;
}

/// Of the mass `n` of body 0 with all facets of a mesh, which is body 1.
std::vector<Line> lines_of(const Mesh& mesh, const Vec3& p, std::uint32_t n = 0) {
  std::vector<Line> lines;
  for (std::size_t f = 0; f < mesh.facet.size(); ++f) {
    const ClosestPoint nearest = closest_point(p, mesh.triangle(f));
    const auto& k = mesh.facet[f];
    lines.push_back({{PairEnd{0, n}, PairEnd{1, k[0]}, PairEnd{1, k[1]}, PairEnd{1, k[2]}},
                     nearest.weight,
                     nearest.distance,
                     p - nearest.away});
  }
  return lines;
}

/// Where the lines end that remain.
std::vector<Vec3> ends_left(const std::vector<Line>& lines) {
  std::vector<Vec3> ends;
  for (std::size_t n = 0; n < lines.size(); ++n)
    if (!is_shadowed(std::span<const Line>(lines), n)) ends.push_back(lines[n].at);
  return ends;
}

TEST(Shadowed, OverAPlaneOnlyTheLineAcrossRemains) {
  Dice dice(3);
  const Mesh mesh = sheet(4, [](auto, auto) { return 0.0; });
  for (int n = 0; n < 300; ++n) {
    const Vec3 p(dice.between(0.1, 3.9), dice.between(0.1, 3.9), dice.between(0.01, 1.5));
    const auto ends = ends_left(lines_of(mesh, p));
    ASSERT_EQ(ends.size(), 1u) << "seed 3, case " << n;
    ASSERT_LT((ends[0] - Vec3(p.x(), p.y(), 0)).norm(), 1e-12);
  }
}

TEST(Shadowed, OverACornerAndAnEdgeAllFacetsRoundItRemain) {
  const Mesh mesh = sheet(4, [](auto, auto) { return 0.0; });
  for (const Vec3& p : {Vec3(2, 2, 0.4), Vec3(2, 1.3, 0.4), Vec3(1.5, 1.5, 0.4)}) {
    const auto ends = ends_left(lines_of(mesh, p));
    EXPECT_GE(ends.size(), 2u);
    for (const Vec3& end : ends) EXPECT_LT((end - Vec3(p.x(), p.y(), 0)).norm(), 1e-12);
  }
}

TEST(Shadowed, BeyondARidgeTheRidgeItselfIsTouchedAndInAGrooveBothSidesAre) {
  const auto roof = [](double slope) {
    return sheet(4, [slope](auto i, auto) { return slope * std::abs(i - 2.0); });
  };
  for (const Vec3& end : ends_left(lines_of(roof(-1), {2.1, 1.7, 0.8})))
    EXPECT_LT((end - Vec3(2, 1.7, 0)).norm(), 1e-12);
  const auto groove = ends_left(lines_of(roof(1), {2.1, 1.7, 0.8}));
  EXPECT_EQ(groove.size(), 2u);
}

/// The law: a line remains where and only where its end is a local minimum of the distance from the surface, here from points of all
/// facets round it.
TEST(Shadowed, WhatRemainsAreTheLocalMinimaOfTheDistance) {
  Dice dice(5);
  int left = 0, shadowed = 0;
  for (int n = 0; n < 40; ++n) {
    const Mesh mesh = sheet(3, [&](auto, auto) { return dice.between(-0.4, 0.4); });
    const Vec3 p(dice.between(0.5, 2.5), dice.between(0.5, 2.5), dice.between(0.5, 1.2));
    const auto lines = lines_of(mesh, p);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      double gained = 0;  // by the best step of 1 um on the surface
      for (std::size_t f = 0; f < mesh.facet.size(); ++f) {
        if (closest_point(lines[k].at, mesh.triangle(f)).distance > 1e-12) continue;
        const Vec3 there = p - closest_point(p, mesh.triangle(f)).away;
        const Vec3 way = there - lines[k].at;
        if (way.norm() < 1e-9) continue;
        const Vec3 near = lines[k].at + std::min(1e-6, way.norm()) * way.normalized();
        gained = std::max(gained, lines[k].distance - (p - near).norm());
      }
      const bool is_shadow = is_shadowed(std::span<const Line>(lines), k);
      EXPECT_EQ(is_shadow, gained > 0) << "seed 5, mesh " << n << ", facet " << k << ": " << gained;
      ++(is_shadow ? shadowed : left);
    }
  }
  EXPECT_GT(left, 40);
  EXPECT_GT(shadowed, 200);
}

TEST(Shadowed, NoMassIsInTheShadowOfWhatAnotherMassOrBodyMeets) {
  const Mesh mesh = sheet(4, [](auto, auto) { return 0.0; });
  auto lines = lines_of(mesh, {1.7, 1.6, 0.5}, 0);
  const std::size_t one = lines.size();
  std::size_t oblique = 0;
  while (!is_shadowed(std::span<const Line>(lines), oblique)) ++oblique;
  const Line line = lines[oblique];
  lines = lines_of(mesh, {1.7, 1.6, 0.5}, 1);
  lines.push_back(line);
  EXPECT_FALSE(is_shadowed(std::span<const Line>(lines), one)) << "of another mass";
  lines.back() = line;
  lines.back().end[0] = {0, 1};
  EXPECT_TRUE(is_shadowed(std::span<const Line>(lines), one));
  for (std::size_t k = 1; k < 4; ++k) lines.back().end[k].body = 2;
  EXPECT_FALSE(is_shadowed(std::span<const Line>(lines), one)) << "with another body";
}

}  // namespace
}  // namespace palpate::physics
