// Renumbering changes the order and nothing else, whatever the order was before.

#include "physics_node/mesh/renumber.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

/// The same mesh with nodes and tetrahedra in any order.
TetMesh shuffled(const TetMesh& mesh) {
  std::mt19937_64 dice(3);
  std::vector<Index> to(mesh.nodes.size()), order(mesh.tets.size());
  for (std::size_t n = 0; n < to.size(); ++n) to[n] = static_cast<Index>(n);
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = static_cast<Index>(n);
  std::ranges::shuffle(to, dice);
  std::ranges::shuffle(order, dice);
  TetMesh other;
  other.nodes.resize(mesh.nodes.size());
  for (std::size_t n = 0; n < to.size(); ++n) other.nodes[static_cast<std::size_t>(to[n])] = mesh.nodes[n];
  for (const Index t : order) {
    auto corners = mesh.tets[static_cast<std::size_t>(t)];
    for (Index& c : corners) c = to[static_cast<std::size_t>(c)];
    other.tets.push_back(corners);
    other.region.push_back(mesh.region[static_cast<std::size_t>(t)]);
  }
  return other;
}

TetMesh two_regions() {
  TetMesh mesh = make_tet_box({.cells = {6, 5, 7}, .edge = 0.003, .jitter = 0.1});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.region[t] = t < mesh.tets.size() / 2 ? 7 : 3;
  return mesh;
}

TEST(Renumber, GivesOneMeshWhateverTheOrderWas) {
  TetMesh first = two_regions(), second = shuffled(first);
  renumber(first);
  renumber(second);
  EXPECT_EQ(first.nodes, second.nodes);
  EXPECT_EQ(first.tets, second.tets);
  EXPECT_EQ(first.region, second.region);
}

TEST(Renumber, SaysWhereNodesWere) {
  const TetMesh before = shuffled(two_regions());
  TetMesh after = before;
  const auto was = renumber(after);
  ASSERT_EQ(was.size(), before.nodes.size());
  for (std::size_t n = 0; n < was.size(); ++n)
    EXPECT_EQ(after.nodes[n], before.nodes[static_cast<std::size_t>(was[n])]);
  EXPECT_TRUE(std::ranges::is_sorted(after.region)) << "tetrahedra of a region are together";
}

TEST(Renumber, BringsNeighboursTogether) {
  TetMesh mesh = shuffled(make_tet_box({.cells = {12, 12, 12}}));
  const auto apart = [&mesh] {
    double sum = 0;
    for (const auto& c : mesh.tets) sum += std::ranges::max(c) - std::ranges::min(c);
    return sum / static_cast<double>(mesh.tets.size());
  };
  const double before = apart();
  renumber(mesh);
  EXPECT_LT(apart(), 0.25 * before);
}

TEST(Renumber, BearsMeshesOfOnePlaceAndOfNone) {
  TetMesh none;
  EXPECT_TRUE(renumber(none).empty());
  TetMesh flat{.nodes = {Vec3::Ones(), Vec3::Ones(), Vec3::Ones(), Vec3::Ones()},
               .tets = {{0, 1, 2, 3}},
               .region = {0}};
  EXPECT_EQ(renumber(flat).size(), 4U);
}

}  // namespace
}  // namespace palpate::physics
