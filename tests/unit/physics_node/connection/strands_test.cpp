// Where strands begin and end, and how stiff and tough they are.
#include "physics_node/connection/strands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace palpate::physics {
namespace {

/// A square of n x n facets of `edge` in the plane z, whose nodes are numbered from `first` on.
Surface sheet(int n, double edge, double z, Index first = 0) {
  Surface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      surface.rest.emplace_back(edge * i, edge * j, z);
      surface.cell.push_back(first + static_cast<Index>(surface.cell.size()));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      surface.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return surface;
}

const ConnectionSpec bed = [] {
  ConnectionSpec spec;
  spec.within = 0.004;
  spec.modulus = 5e3;
  spec.toughness = 20;
  return spec;
}();

TEST(Strands, OfTwoSheetsAreStraightAndOfTheirWholeArea) {
  const auto strands = make_strands(bed, sheet(4, 0.002, 0), sheet(4, 0.002, 0.003));
  ASSERT_EQ(strands.size(), 25u);
  double area = 0;
  for (const Strand& strand : strands) {
    area += strand.area;
    EXPECT_DOUBLE_EQ(strand.length, 0.003);
    EXPECT_DOUBLE_EQ(strand.k, 5e3 * strand.area / 0.003);
    EXPECT_NEAR(std::accumulate(strand.share.begin(), strand.share.end(), 0.0), 1, 1e-12);
    EXPECT_NEAR(0.5 * strand.k * strand.most_longer * strand.most_longer, 20 * strand.area, 1e-15);
  }
  EXPECT_NEAR(area, 64e-6, 1e-15);
}

/// The nearest place, by looking at all places of a fine grid over all triangles.
TEST(Strands, EndAtTheNearestPlace) {
  Surface from, to = sheet(3, 0.003, 0);
  for (std::size_t v = 0; v < to.rest.size(); ++v)
    to.rest[v].z() = 0.001 * std::sin(7.0 * static_cast<double>(v));
  from = sheet(5, 0.0021, 0.002);
  ConnectionSpec spec = bed;
  spec.within = 0.01;
  for (const Strand& strand : make_strands(spec, from, to)) {
    const Vec3 p = from.rest[static_cast<std::size_t>(strand.node)];
    Vec3 foot = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      foot += strand.share[c] * to.rest[static_cast<std::size_t>(strand.foot[c])];
    double nearest = HUGE_VAL;
    for (const auto& f : to.facets)
      for (const auto& t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}})
        for (int i = 0; i <= 60; ++i)
          for (int j = 0; i + j <= 60; ++j) {
            const double a = i / 60.0, b = j / 60.0;
            nearest = std::min(
                nearest, (a * to.rest[t[0]] + b * to.rest[t[1]] + (1 - a - b) * to.rest[t[2]] - p).norm());
          }
    EXPECT_LE((foot - p).norm(), nearest + 1e-12);
    EXPECT_GE((foot - p).norm(), nearest - 1e-4) << "a grid of 0.05 mm";
    for (const double share : strand.share) EXPECT_GE(share, 0);
  }
}

/// A reach of a hundredth of a micrometre beside facets of two millimetres.
TEST(Strands, OfAShortReachTakeNoMoreRoom) {
  ConnectionSpec spec = bed;
  spec.within = 1e-8;
  EXPECT_TRUE(make_strands(spec, sheet(4, 0.002, 0), sheet(4, 0.002, 0.001)).empty());
  EXPECT_EQ(make_strands(spec, sheet(4, 0.002, 0), sheet(4, 0.002, 0)).size(), 25u);
}

TEST(Strands, AreWhereSurfacesAreNearAndNoShorterThanATenthOfTheReach) {
  EXPECT_TRUE(make_strands(bed, sheet(4, 0.002, 0), sheet(4, 0.002, 0.0041)).empty());
  for (const Strand& strand : make_strands(bed, sheet(4, 0.002, 0), sheet(4, 0.002, 1e-6)))
    EXPECT_DOUBLE_EQ(strand.length, 0.0004);
  ConnectionSpec tough = bed;
  tough.toughness = 0;
  for (const Strand& strand : make_strands(tough, sheet(2, 0.002, 0), sheet(2, 0.002, 0.001)))
    EXPECT_TRUE(std::isinf(strand.most_longer));
}

/// Two nodes and a spring: w^2 = k (1 / m + 1 / M).
TEST(Strands, RaiseFrequenciesByNoLessThanTheyDo) {
  const Strand one{.node = 0, .foot = {0, 1, 2}, .share = {1, 0, 0}, .k = 100};
  EXPECT_DOUBLE_EQ(added_omega2({one}, 0, {2.0}), 400);
  EXPECT_DOUBLE_EQ(added_omega2({one}, 1, {5.0, 5.0, 5.0}), 1000);
  EXPECT_GE(std::max(added_omega2({one}, 0, {2.0}), added_omega2({one}, 1, {5.0, 5.0, 5.0})),
            100 * (2.0 + 5.0));
}

}  // namespace
}  // namespace palpate::physics
