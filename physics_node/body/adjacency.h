#pragma once
// Which nodes of a body hang together: who is joined to whom by an element that lives.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "physics_node/lattice/cell_net.h"
#include "physics_node/lattice/lattice.h"
#include "physics_node/mesh/simplex_net.h"

namespace palpate::physics {

/// A view of what a body steps: it follows every break, and costs nothing to copy.
class Adjacency {
 public:
  /// Of nothing.
  Adjacency() = default;
  /// Of the body as it was loaded. @param lattice  outlives this
  explicit Adjacency(const Lattice& lattice) : Adjacency(lattice, lattice.mask) {}
  /// @param live  elements of every storage cell; outlives this  (n_cells)
  /// @param cells  of finite elements that may be cut, else null; outlives this
  Adjacency(const Lattice& lattice, std::span<const Mask> live, const CellNet* cells = nullptr)
      : lattice_(&lattice), live_(live), cells_(cells) {}
  /// Of a mesh, in which nothing breaks. @param lists  outlives this
  explicit Adjacency(const NodeLists& lists) : lists_(&lists) {}
  /// Of a mesh that may be cut. @param lists, net  of it; outlive this
  Adjacency(const NodeLists& lists, const TetNet& net) : lists_(&lists), net_(&net), copies_(&net) {}
  Adjacency(const NodeLists& lists, const TriangleNet& net)
      : lists_(&lists), triangles_(&net), copies_(&net) {}

  /// Calls visit(neighbour) for each node that a live element joins to this one, in an order that depends on the body
  /// alone; where a mesh or cells may be cut for some of them more than once.
  template <class Visit>
  void each_neighbour(Index node, const Visit& visit) const noexcept {
    if (net_ != nullptr) return each_in(*net_, node, visit);
    if (triangles_ != nullptr) return each_in(*triangles_, node, visit);
    if (lists_ != nullptr) {
      for (const Index other : lists_->of(node)) visit(other);
      return;
    }
    if (cells_ != nullptr) return each_in(*cells_, node, visit);
    const auto& offset = lattice_->offset[static_cast<std::size_t>(lattice_->row_kind(node))];
    for (Mask left = live_elements(node) & element_bits; left != 0; left &= left - 1)
      visit(node + offset[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  bool are_joined(Index a, Index b) const noexcept {
    if (lists_ != nullptr && copies_ == nullptr) return std::ranges::binary_search(lists_->of(a), b);
    if (copies_ != nullptr || cells_ != nullptr) {
      bool joined = false;
      each_neighbour(a, [&](Index other) { joined = joined || other == b; });
      return joined;
    }
    const auto& offset = lattice_->offset[static_cast<std::size_t>(lattice_->row_kind(a))];
    for (Mask left = live_elements(a) & element_bits; left != 0; left &= left - 1)
      if (a + offset[static_cast<std::size_t>(std::countr_zero(left))] == b) return true;
    return false;
  }
  /// How many it is joined to; of a mesh as loaded.
  int degree(Index node) const noexcept {
    if (lists_ != nullptr) return static_cast<int>(lists_->of(node).size());
    return std::popcount(live_elements(node) & element_bits);
  }
  /// Is an element gone that joined it to another when the body was loaded, or a cell that it was a corner of? Or has the
  /// node of a mesh split?
  bool has_lost(Index node) const noexcept {
    if (copies_ != nullptr) return copies_->has_split(node);
    if (cells_ != nullptr && cells_->has_split(node)) return true;
    return lists_ == nullptr && live_elements(node) != lattice_->mask[static_cast<std::size_t>(node)];
  }
  /// The live elements of a node as a record keeps them: a bit for each, which means the same in every body built from the
  /// same [[body]]. 0 of a mesh: nothing of it breaks.
  Mask live_elements(Index node) const noexcept {
    if (lists_ != nullptr) return Mask{0};
    return live_[static_cast<std::size_t>(cells_ != nullptr ? cells_->origin(node) : node)];
  }
  /// The same of every storage cell: for makers of what only a lattice has  (n_cells)
  std::span<const Mask> of_all() const noexcept { return live_; }

  /// Has a cell at a node a copy of another? Then it is the cells that know who its neighbours are.
  bool is_at_cut(Index node) const noexcept {
    if (cells_ == nullptr || cells_->n_copies() == 0) return false;
    bool any = false;
    cells_->each_around(node, [&](Index cell, std::size_t) { any = any || cells_->is_parted(cell); });
    return any;
  }

 private:
  template <class Net, class Visit>
  static void each_in(const Net& net, Index node, const Visit& visit) noexcept {
    net.each_corner(node, [&](Index element, std::size_t) {
      for (const Index other : net.corners(element))
        if (other != node) visit(other);
    });
  }

  const Lattice* lattice_ = nullptr;
  std::span<const Mask> live_;
  const NodeLists* lists_ = nullptr;        // of a mesh, as loaded; else null
  const TetNet* net_ = nullptr;             // of a mesh of tetrahedra that may be cut; else null
  const TriangleNet* triangles_ = nullptr;  // of a surface of springs that may be; else null
  const NodeCopies* copies_ = nullptr;      // of either; else null
  const CellNet* cells_ = nullptr;          // of cells that may be; else null
};

}  // namespace palpate::physics
