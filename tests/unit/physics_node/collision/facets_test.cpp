#include "physics_node/collision/facets.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Recipe;

struct Case {
  const char* name;
  const char* lattice;
  std::string shape;
};

class ClosedSurface : public testing::TestWithParam<Case> {};

TEST_P(ClosedSurface, EveryEdgeOfAnUnbrokenBodyIsInAnEvenNumberOfFacets) {
  Recipe recipe;
  recipe.lattice = GetParam().lattice;
  recipe.shape = GetParam().shape;
  const auto moving = make_moving_body(test::body_of(recipe), Precision::double_);
  const Candidates candidates(*moving, false);
  const Facets facets(candidates);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::size_t loose = 0;
  for (const auto& k : facets.all()) {
    if (k[0] == k[1]) {
      ++loose;
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = k[i], b = k[(i + 1) % 3];
      EXPECT_TRUE(candidates.are_joined(a, b));
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  }
  EXPECT_EQ(loose, 0U);
  EXPECT_GT(edges.size(), 20U);
  for (const auto& [edge, count] : edges) EXPECT_EQ(count % 2, 0) << edge.first << " - " << edge.second;
}

INSTANTIATE_TEST_SUITE_P(Lattices, ClosedSurface,
                         testing::Values(Case{"fcc_sphere", "fcc", Recipe::sphere(40)},
                                         Case{"fcc_box", "fcc", Recipe::box(60, 50, 40)},
                                         Case{"voxel_box", "voxel", Recipe::box(50, 40, 30)},
                                         Case{"voxel_sphere", "voxel", Recipe::sphere(45)}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Facets, ALooseMassIsAFacetOfOnePoint) {
  Recipe recipe = test::pair_of_masses("mass_g = 1\nk1_N_per_m = 100");
  const auto moving = make_moving_body(test::body_of(recipe), Precision::double_);
  const Candidates candidates(*moving, false);
  const Facets facets(candidates);
  ASSERT_EQ(facets.all().size(), 2U);
  EXPECT_TRUE(facets.is_loose(0));
  EXPECT_EQ(facets.all()[1], (Facets::Corners{1, 1, 1}));
}

TEST(Candidates, AreTheMassesWithFewerElementsThanDeepInside) {
  const auto moving = make_moving_body(test::body_of({.shape = Recipe::sphere(50)}), Precision::single_);
  const Candidates candidates(*moving, false);
  std::size_t expected = 0;
  for (const Index cell : moving->body().lattice.masses)
    expected += __builtin_popcount(moving->mask(cell)) < 12 ? 1U : 0U;
  EXPECT_EQ(candidates.size(), expected);
  EXPECT_LT(candidates.size(), static_cast<std::size_t>(moving->body().lattice.n_masses()));
}

}  // namespace
}  // namespace palpate::physics
