#pragma once
// The nodes of a mesh that is cut: those as loaded, and copies that have the numbers after them.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/lattice/node_split.h"

namespace palpate::physics {

class NodeCopies {
 public:
  /// Nodes as loaded, and those in use now, whose numbers are below this.
  Index n_loaded() const noexcept { return n_loaded_; }
  Index n_nodes() const noexcept { return n_loaded_ + n_copies(); }
  Index n_copies() const noexcept { return static_cast<Index>(origin_.size()); }
  std::size_t most_copies() const noexcept { return most_copies_; }
  /// The node as loaded that this is, or is a copy of.
  Index origin(Index node) const noexcept {
    return node < n_loaded_ ? node : origin_[static_cast<std::size_t>(node - n_loaded_)];
  }
  /// Is it a copy, or has it one?
  bool has_split(Index node) const noexcept {
    return has_split_[static_cast<std::size_t>(origin(node))] != 0;
  }
  std::span<const NodeSplit> splits() const noexcept { return splits_; }  // of the last list, in their order
  std::uint64_t left_out() const noexcept { return left_out_; }           // faces for which there was no room
  std::int64_t n_open() const noexcept { return n_open_; }                // faces

 protected:
  NodeCopies(std::size_t n_nodes, std::size_t most_copies)
      : n_loaded_(static_cast<Index>(n_nodes)), most_copies_(most_copies), has_split_(n_nodes, 0) {
    origin_.reserve(most_copies);
    splits_.reserve(most_copies);
  }
  void forget_splits() noexcept { splits_.clear(); }
  /// Is there room for as many copies? Else that is counted. Once there was, a face is open.
  bool open_one(std::size_t copies) noexcept {
    if (most_copies_ - origin_.size() < copies) return ++left_out_, false;
    return ++n_open_, true;
  }
  /// @return the new node
  Index copy(Index node) noexcept {
    const Index origin = this->origin(node), copy = n_nodes();
    origin_.push_back(origin);
    has_split_[static_cast<std::size_t>(origin)] = 1;
    splits_.push_back({node, copy});
    return copy;
  }
  void forget_copies() noexcept {
    has_split_.assign(has_split_.size(), 0);
    origin_.clear();
    splits_.clear();
    n_open_ = 0;
  }

 private:
  Index n_loaded_ = 0;
  std::size_t most_copies_ = 0;
  std::vector<Index> origin_;  // of each copy
  std::vector<std::uint8_t> has_split_;
  std::vector<NodeSplit> splits_;
  std::uint64_t left_out_ = 0;
  std::int64_t n_open_ = 0;
};

}  // namespace palpate::physics
