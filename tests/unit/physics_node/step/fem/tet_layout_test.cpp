// Every tetrahedron is in one lane of one block, blocks are of one material and within their bounds, and lists find every part.

#include "physics_node/step/fem/tet_layout.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "physics_node/mesh/renumber.h"
#include "physics_node/mesh/tet_box.h"

namespace palpate::physics {
namespace {

TetModel two_materials(bool ordered) {
  TetModel model{.mesh = make_tet_box({.cells = {9, 8, 7}, .edge = 0.002, .jitter = 0.1}),
                 .materials = {{}, {}},
                 .held = {}};
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
    model.mesh.region[t] =
        model.mesh.nodes[static_cast<std::size_t>(model.mesh.tets[t][0])].x() < 0.009 ? 0 : 1;
  if (ordered) {
    renumber(model.mesh);
  } else {  // neighbours far apart
    std::vector<Index> order(model.mesh.tets.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = static_cast<Index>(n);
    std::ranges::shuffle(order, std::mt19937_64(2));
    const TetMesh before = model.mesh;
    for (std::size_t n = 0; n < order.size(); ++n) {
      model.mesh.tets[n] = before.tets[static_cast<std::size_t>(order[n])];
      model.mesh.region[n] = before.region[static_cast<std::size_t>(order[n])];
    }
  }
  return model;
}

class Layouts : public testing::TestWithParam<bool> {
 protected:
  TetModel model = two_materials(GetParam());
  TetLayout layout = lay_out(model);
};

TEST_P(Layouts, HaveEveryTetrahedronOnce) {
  std::multiset<Index> seen;
  for (const TetBlock& block : layout.blocks) {
    EXPECT_LE(block.n_batches * tet_lanes, most_block_tets);
    EXPECT_LE(block.n_parts, most_block_nodes);
    for (std::size_t at = block.first_batch * tet_lanes;
         at < (block.first_batch + block.n_batches) * tet_lanes; ++at) {
      for (std::size_t a = 0; a < 4; ++a) ASSERT_LT(layout.corner[4 * at + a], block.n_parts);
      if (layout.tet[at] < 0) continue;
      const auto t = static_cast<std::size_t>(layout.tet[at]);
      seen.insert(layout.tet[at]);
      EXPECT_EQ(static_cast<std::size_t>(model.mesh.region[t]), block.material);
      for (std::size_t a = 0; a < 4; ++a)
        EXPECT_EQ(layout.node[block.first_part + layout.corner[4 * at + a]], model.mesh.tets[t][a]);
    }
  }
  EXPECT_EQ(seen.size(), model.mesh.tets.size());
  EXPECT_EQ(std::set<Index>(seen.begin(), seen.end()).size(), model.mesh.tets.size());
}

TEST_P(Layouts, ListEveryPartOnceAndInOrder) {
  for (const PartLists* lists : {&layout.of_node, &layout.of_share}) {
    const auto& whose = lists == &layout.of_node ? layout.node : layout.share;
    std::size_t n = 0;
    for (std::size_t who = 0; who + 1 < lists->begin.size(); ++who)
      for (Index e = lists->begin[who]; e < lists->begin[who + 1]; ++e, ++n) {
        const Index part = lists->part[static_cast<std::size_t>(e)];
        EXPECT_EQ(whose[static_cast<std::size_t>(part)], static_cast<Index>(who));
        if (e > lists->begin[who]) {
          EXPECT_GT(part, lists->part[static_cast<std::size_t>(e) - 1]);
        }
      }
    EXPECT_EQ(n, layout.node.size());
  }
}

TEST_P(Layouts, GiveANodeBetweenMaterialsAShareInEach) {
  std::map<Index, std::set<std::size_t>> materials;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
    for (const Index node : model.mesh.tets[t])
      materials[node].insert(static_cast<std::size_t>(model.mesh.region[t]));
  std::size_t shares = 0, between = 0;
  for (const auto& [node, of] : materials) shares += of.size(), between += of.size() == 2 ? 1 : 0;
  EXPECT_GT(between, 10U);
  EXPECT_EQ(layout.node_of_share.size(), shares);
}

INSTANTIATE_TEST_SUITE_P(Orders, Layouts, testing::Bool());

TEST(Layout, OfAGoodOrderHasFewParts) {
  TetModel model{.mesh = make_tet_box({.cells = {19, 19, 19}}), .materials = {{}}, .held = {}};
  renumber(model.mesh);
  const TetLayout layout = lay_out(model);
  EXPECT_LT(static_cast<double>(layout.node.size()), 1.9 * static_cast<double>(model.mesh.nodes.size()));
  EXPECT_LT(layout.blocks.size(), 1.1 * static_cast<double>(model.mesh.tets.size()) / most_block_tets + 1);
}

}  // namespace
}  // namespace palpate::physics
