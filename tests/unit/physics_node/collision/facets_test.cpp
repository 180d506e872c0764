#include "physics_node/collision/facets.h"
#include "physics_node/step/body_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

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

TEST_P(ClosedSurface, EveryEdgeIsInAnEvenNumberOfBoundaryFacets) {
  Recipe recipe;
  recipe.lattice = GetParam().lattice;
  recipe.shape = GetParam().shape;
  const auto moving = make_body_model(test::body_of(recipe), Precision::double_);
  const Candidates candidates(*moving, true);
  const Facets facets(candidates);
  std::set<Facets::Corners> known(facets.all().begin(), facets.all().end());
  const Lattice& lattice = moving->body().lattice;
  const auto mask = [&](Index cell) { return moving->adjacency().live_elements(cell); };
  const auto patterns = triangle_patterns(lattice);
  std::map<std::pair<Index, Index>, int> edges;
  for (const Index cell : lattice.masses)
    for (const TrianglePattern& triangle : patterns[static_cast<std::size_t>(lattice.row_kind(cell))]) {
      if (!holds(triangle.edges[0], cell, mask) || !is_boundary(triangle, cell, mask)) continue;
      const std::array<Index, 3> k{cell, cell + triangle.corner[0], cell + triangle.corner[1]};
      EXPECT_TRUE(known.count({static_cast<std::uint32_t>(candidates.at_cell(k[0])),
                               static_cast<std::uint32_t>(candidates.at_cell(k[1])),
                               static_cast<std::uint32_t>(candidates.at_cell(k[2]))}));
      for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(k[i], k[(i + 1) % 3])];
    }
  EXPECT_GT(edges.size(), 20U);
  for (const auto& [edge, count] : edges) EXPECT_EQ(count % 2, 0) << edge.first << " - " << edge.second;
}

INSTANTIATE_TEST_SUITE_P(Lattices, ClosedSurface,
                         testing::Values(Case{"fcc_sphere", "fcc", Recipe::sphere(40)},
                                         Case{"fcc_box", "fcc", Recipe::box(60, 50, 40)},
                                         Case{"voxel_box", "voxel", Recipe::box(50, 40, 30)},
                                         Case{"voxel_sphere", "voxel", Recipe::sphere(45)}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(Facets, ALooseMassIsAFacetOfOnePoint) {
  Recipe recipe = test::pair_of_masses("mass_g = 1\nk1_N_per_m = 100");
  const auto moving = make_body_model(test::body_of(recipe), Precision::double_);
  const Candidates candidates(*moving, false);
  const Facets facets(candidates);
  ASSERT_EQ(facets.all().size(), 2U);
  EXPECT_TRUE(facets.is_loose(0));
  EXPECT_EQ(facets.all()[1], (Facets::Corners{1, 1, 1}));
}

TEST(Candidates, AreTheMassesWithFewerElementsThanDeepInside) {
  const auto moving = make_body_model(test::body_of({.shape = Recipe::sphere(50)}), Precision::single_);
  const Candidates candidates(*moving, false);
  std::size_t expected = 0;
  for (const Index cell : moving->body().lattice.masses)
    expected += __builtin_popcount(moving->adjacency().live_elements(cell)) < 12 ? 1U : 0U;
  EXPECT_EQ(candidates.size(), expected);
  EXPECT_LT(candidates.size(), static_cast<std::size_t>(moving->body().lattice.n_masses()));
}

}  // namespace
}  // namespace palpate::physics
