#include "physics_node/step/fem/tet_layout.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace palpate::physics {
namespace {

/// Tetrahedra of one block.
using Members = std::vector<Index>;

std::vector<Members> cut_into_blocks(const TetModel& model, std::vector<std::size_t>& materials) {
  std::vector<Index> order(model.mesh.tets.size());
  std::iota(order.begin(), order.end(), 0);
  const auto material_of = [&](Index t) { return model.mesh.region[static_cast<std::size_t>(t)]; };
  std::ranges::stable_sort(order, {}, material_of);
  std::vector<Members> blocks;
  std::vector<Index> seen_in(model.mesh.nodes.size(), -1);  // the last block that has this node
  std::size_t n_nodes = 0;
  for (const Index t : order) {
    const TetNodes all = nodes_of(model.mesh, static_cast<std::size_t>(t));
    const std::span corners(all.node.data(), all.n);
    const auto is_new = [&](Index node) {
      return seen_in[static_cast<std::size_t>(node)] + 1 != static_cast<Index>(blocks.size());
    };
    const auto fresh = static_cast<std::size_t>(std::ranges::count_if(corners, is_new));
    if (blocks.empty() || blocks.back().size() == most_block_tets || n_nodes + fresh > most_block_nodes ||
        material_of(blocks.back().back()) != material_of(t)) {
      blocks.emplace_back();
      materials.push_back(static_cast<std::size_t>(material_of(t)));
      n_nodes = 0;
    }
    for (const Index node : corners)
      if (is_new(node))
        seen_in[static_cast<std::size_t>(node)] = static_cast<Index>(blocks.size()) - 1, ++n_nodes;
    blocks.back().push_back(t);
  }
  return blocks;
}

void add_block(const TetModel& model, const Members& members, std::size_t material, TetLayout& layout) {
  Members nodes;
  for (const Index t : members)
    for (std::size_t a = 0; a < layout.n_nodes; ++a)
      nodes.push_back(nodes_of(model.mesh, static_cast<std::size_t>(t)).node[a]);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  TetBlock block{.first_batch = layout.n_batches(),
                 .n_batches = (members.size() + tet_lanes - 1) / tet_lanes,
                 .first_part = layout.node.size(),
                 .n_parts = nodes.size(),
                 .material = material};
  // Neighbours in the list lie in different batches, since they have nodes in common: a lane that waits for the sum of the one
  // before costs more than all the rest.
  for (std::size_t batch = 0; batch < block.n_batches; ++batch)
    for (std::size_t lane = 0; lane < tet_lanes; ++lane) {
      const std::size_t n = lane * block.n_batches + batch;
      const bool left_over = n >= members.size();
      layout.tet.push_back(left_over ? -1 : members[n]);
      const TetNodes of = left_over ? TetNodes{} : nodes_of(model.mesh, static_cast<std::size_t>(members[n]));
      for (std::size_t a = 0; a < layout.n_nodes; ++a) {
        const Index node = left_over ? nodes[0] : of.node[a];
        layout.corner.push_back(
            static_cast<std::uint16_t>(std::ranges::lower_bound(nodes, node) - nodes.begin()));
      }
    }
  layout.node.insert(layout.node.end(), nodes.begin(), nodes.end());
  layout.blocks.push_back(block);
}

/// @param of  whose each part is, all below n
PartLists lists_of(const std::vector<Index>& of, std::size_t n) {
  PartLists lists;
  lists.begin.assign(n + 1, 0);
  for (const Index who : of) ++lists.begin[static_cast<std::size_t>(who) + 1];
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.part.resize(of.size());
  std::vector<Index> next(lists.begin.begin(), lists.begin.end() - 1);
  for (std::size_t p = 0; p < of.size(); ++p)
    lists.part[static_cast<std::size_t>(next[static_cast<std::size_t>(of[p])]++)] = static_cast<Index>(p);
  return lists;
}

/// A node has a share in each material round it.
void number_shares(TetLayout& layout, std::size_t n_nodes) {
  std::vector<std::pair<Index, std::size_t>> shares;  // node and material
  for (const TetBlock& block : layout.blocks)
    for (std::size_t p = 0; p < block.n_parts; ++p)
      shares.emplace_back(layout.node[block.first_part + p], block.material);
  auto sorted = shares;
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const auto& share : shares)
    layout.share.push_back(static_cast<Index>(std::ranges::lower_bound(sorted, share) - sorted.begin()));
  for (const auto& [node, material] : sorted) {
    layout.node_of_share.push_back(node);
    layout.material_of_share.push_back(material);
  }
  layout.of_node = lists_of(layout.node, n_nodes);
  layout.of_share = lists_of(layout.share, sorted.size());
}

}  // namespace

TetLayout lay_out(const TetModel& model) {
  TetLayout layout;
  layout.n_nodes = model.mesh.middles.empty() ? 4 : most_tet_nodes;
  std::vector<std::size_t> materials;
  const auto blocks = cut_into_blocks(model, materials);
  for (std::size_t b = 0; b < blocks.size(); ++b) add_block(model, blocks[b], materials[b], layout);
  number_shares(layout, model.mesh.nodes.size());
  return layout;
}

}  // namespace palpate::physics
