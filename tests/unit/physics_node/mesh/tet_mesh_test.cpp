// A mesh of second order has one node in the middle of each edge, which neighbours share, and keeps them when it is renumbered.

#include "physics_node/mesh/tet_mesh.h"

#include <gtest/gtest.h>

#include <set>

#include "physics_node/mesh/renumber.h"
#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

TEST(AddMiddles, PutsOneNodeOnEachEdge) {
  TetMesh mesh = make_tet_box({.cells = {3, 2, 4}, .edge = 0.002, .jitter = 0.1});
  std::set<std::pair<Index, Index>> edges;
  for (const auto& corners : mesh.tets)
    for (const auto& [a, b] : tet_edges) edges.insert(std::minmax(corners[a], corners[b]));
  const std::size_t corners_alone = mesh.nodes.size();
  add_middles(mesh);
  EXPECT_EQ(mesh.nodes.size(), corners_alone + edges.size());
  renumber(mesh);
  ASSERT_EQ(mesh.middles.size(), mesh.tets.size());
  const auto at = [&mesh](Index n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const Vec3 middle = 0.5 * (at(mesh.tets[t][tet_edges[e][0]]) + at(mesh.tets[t][tet_edges[e][1]]));
      EXPECT_LT((at(mesh.middles[t][e]) - middle).norm(), 1e-15);
    }
}

}  // namespace
}  // namespace palpate::physics
