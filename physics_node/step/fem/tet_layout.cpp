#include "physics_node/step/fem/tet_layout.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace palpate::physics {
namespace {

/// Tetrahedra of one block.
using Members = std::vector<Index>;

std::vector<Members> cut_into_blocks(const TetModel& model, std::size_t most_tets,
                                     std::vector<std::size_t>& materials) {
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
    if (blocks.empty() || blocks.back().size() == most_tets || n_nodes + fresh > most_block_nodes ||
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

/// @param with_room  for as many parts as all of its tetrahedra have corners
void add_block(const TetModel& model, const Members& members, std::size_t material, bool with_room,
               TetLayout& layout) {
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
  if (with_room) layout.node.resize(block.first_part + 4 * members.size(), nodes[0]);
  layout.blocks.push_back(block);
}

/// Calls visit(part) for each that is in use.
template <class Visit>
void each_part(const TetLayout& layout, const Visit& visit) {
  for (const TetBlock& block : layout.blocks)
    for (std::size_t p = block.first_part; p < block.first_part + block.n_parts; ++p) visit(p);
}

/// @param of  whose each part is, all below n, for which there is room
void list_parts(const TetLayout& layout, const std::vector<Index>& of, std::size_t n, PartLists& lists) {
  lists.begin.assign(n + 1, 0);
  each_part(layout, [&](std::size_t p) { ++lists.begin[static_cast<std::size_t>(of[p]) + 1]; });
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  // Each begin goes on to its end, which is the next one's begin.
  each_part(layout, [&](std::size_t p) {
    lists.part[static_cast<std::size_t>(lists.begin[static_cast<std::size_t>(of[p])]++)] =
        static_cast<Index>(p);
  });
  std::copy_backward(lists.begin.begin(), lists.begin.end() - 1, lists.begin.end());
  lists.begin[0] = 0;
}

PartLists room_for_lists(std::size_t n, std::size_t n_parts) {
  PartLists lists;
  lists.begin.reserve(n + 1);
  lists.part.resize(n_parts);
  return lists;
}

/// A node has a share in each material round it.
void number_shares(TetLayout& layout, std::size_t n_nodes, std::size_t most_copies) {
  std::vector<std::pair<Index, std::size_t>> shares;  // node and material
  for (const TetBlock& block : layout.blocks)
    for (std::size_t p = 0; p < block.n_parts; ++p)
      shares.emplace_back(layout.node[block.first_part + p], block.material);
  auto sorted = shares;
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::size_t most_materials = 0;
  for (const TetBlock& block : layout.blocks) most_materials = std::max(most_materials, block.material + 1);
  layout.most_shares = sorted.size() + most_copies * most_materials;
  layout.node_of_share.reserve(layout.most_shares);
  layout.material_of_share.reserve(layout.most_shares);
  layout.share.resize(layout.node.size(), 0);
  std::size_t next = 0;
  each_part(layout, [&](std::size_t p) {
    layout.share[p] = static_cast<Index>(std::ranges::lower_bound(sorted, shares[next++]) - sorted.begin());
  });
  for (const auto& [node, material] : sorted) {
    layout.node_of_share.push_back(node);
    layout.material_of_share.push_back(material);
  }
  layout.of_node = room_for_lists(n_nodes + most_copies, layout.node.size());
  layout.of_share = room_for_lists(layout.most_shares, layout.node.size());
  list_anew(layout, n_nodes);
}

/// The share of a copy in a material, made where there is none.
Index share_of_copy(TetLayout& layout, Index copy, std::size_t material) noexcept {
  for (std::size_t s = layout.node_of_share.size(); s-- > 0 && layout.node_of_share[s] == copy;)
    if (layout.material_of_share[s] == material) return static_cast<Index>(s);
  layout.node_of_share.push_back(copy);
  layout.material_of_share.push_back(material);
  return static_cast<Index>(layout.node_of_share.size() - 1);
}

}  // namespace

TetLayout lay_out(const TetModel& model, std::size_t most_copies) {
  TetLayout layout;
  layout.n_nodes = model.mesh.middles.empty() ? 4 : most_tet_nodes;
  std::vector<std::size_t> materials;
  const bool with_room = most_copies > 0;
  const auto blocks = cut_into_blocks(model, with_room ? most_cut_block_tets : most_block_tets, materials);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    add_block(model, blocks[b], materials[b], with_room, layout);
  number_shares(layout, model.mesh.nodes.size(), most_copies);
  return layout;
}

TetLanes::TetLanes(const TetLayout& layout) : block_(layout.n_batches()) {
  std::size_t n = 0;
  for (const Index tet : layout.tet) n += tet >= 0 ? 1 : 0;
  lane_.resize(n);
  for (std::size_t at = 0; at < layout.tet.size(); ++at)
    if (layout.tet[at] >= 0) lane_[static_cast<std::size_t>(layout.tet[at])] = at;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b)
    for (std::size_t n_th = 0; n_th < layout.blocks[b].n_batches; ++n_th)
      block_[layout.blocks[b].first_batch + n_th] = b;
}

void give_copy(TetLayout& layout, const TetLanes& lanes, const TetNet& net, Index copy) noexcept {
  net.each_corner(copy, [&](Index tet, std::size_t corner) {
    const std::size_t lane = lanes.lane(tet), b = lanes.block(lane);
    TetBlock& block = layout.blocks[b];
    const auto part_of = [&](Index node) {
      std::size_t p = block.n_parts;
      while (p > 0 && layout.node[block.first_part + p - 1] != node) --p;
      return p;  // behind it; 0: there is none
    };
    std::uint16_t& part = layout.corner[4 * lane + corner];
    std::size_t behind = part_of(copy);
    if (behind == 0) {
      const Index before = layout.node[block.first_part + part];
      bool stays = false;  // somebody in this block has the node as before
      net.each_corner(
          before, [&](Index other, std::size_t) { stays = stays || lanes.block(lanes.lane(other)) == b; });
      behind = stays ? ++block.n_parts : std::size_t{part} + 1;
      layout.node[block.first_part + behind - 1] = copy;
      layout.share[block.first_part + behind - 1] = share_of_copy(layout, copy, block.material);
    }
    part = static_cast<std::uint16_t>(behind - 1);
  });
}

void list_anew(TetLayout& layout, std::size_t n_nodes) noexcept {
  list_parts(layout, layout.node, n_nodes, layout.of_node);
  list_parts(layout, layout.share, layout.node_of_share.size(), layout.of_share);
}

}  // namespace palpate::physics
