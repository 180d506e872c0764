#pragma once
// Which cells of a lattice hang together while they are cut along their faces, and which node each of their corners is: for
// cells of finite elements what TetNet is for tetrahedra.
//
// Round a node as it was loaded its up to eight cells fall into fans: those that one comes to from each other through
// faces at the node that are still joined. Every fan has a node of its own. When a face that is opened parts a fan, the
// part with more cells keeps the node and the other takes a new one, a copy, which begins where the first is. No cell
// comes, goes or changes its shape, and each fan keeps its own share of mass.
// A cell is known by its lowest corner, in storage. Copies are numbered from the number of storage cells on.
// Source: Dick, Georgii & Westermann 2011, links between the cells of a grid.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/lattice/cell_steps.h"
#include "physics_node/lattice/node_split.h"

namespace palpate::physics {

class CellNet {
 public:
  using Corners = std::array<Index, 8>;  // bit 0 of the number is +x, bit 1 +y, bit 2 +z
  using Face = std::array<Index, 4>;
  static constexpr Index none = -1;
  static constexpr std::size_t n_faces = 6;  // -x +x -y +y -z +z

  /// Numbers of the corners of a face, anticlockwise from outside.
  static const std::array<std::size_t, 4>& corners_of_face(std::size_t face) noexcept;

  /// @param lattice  of voxels @param stiffness  above 0: there is a cell  (n_cells)
  /// @param most_copies  of nodes, of all there will ever be
  CellNet(const Lattice& lattice, std::span<const float> stiffness, std::size_t most_copies);

  bool has_cell(Index cell) const noexcept { return is_cell_[at(cell)] != 0; }
  std::span<const Index> cells() const noexcept { return cells_; }  // all, in storage order
  /// Cells that have a copy at a corner, in the order in which they came to; the others have nodes as loaded.
  std::span<const Index> parted() const noexcept { return parted_; }
  bool is_parted(Index cell) const noexcept { return record_[at(cell)] >= 0; }
  Corners corners(Index cell) const noexcept {
    return is_parted(cell) ? corners_[at(record_[at(cell)])] : loaded_corners(cell);
  }
  /// Of the n-th of parted().
  const Corners& parted_corners(std::size_t n) const noexcept { return corners_[n]; }
  Corners loaded_corners(Index cell) const noexcept { return steps_.corners(cell); }
  Face face(Index cell, std::size_t face) const noexcept;

  /// The cell on the other side of a face; none: there is none.
  Index beyond(Index cell, std::size_t face) const noexcept {
    const Index other = steps_.beside(cell, face);
    return has_cell(other) ? other : none;
  }
  bool is_open(Index cell, std::size_t face) const noexcept { return (open_[at(cell)] >> face & 1) != 0; }
  /// Cells with an open face, in the order in which they came to; each once.
  std::span<const Index> opened() const noexcept { return opened_; }
  /// An open face, between a cell and the next up an axis.
  struct OpenFace {
    Index cell = none;
    std::size_t axis = 0;
  };
  /// All of them, in the order in which they were opened.
  std::span<const OpenFace> open_faces() const noexcept { return open_faces_; }
  /// No more than these are ever opened.
  std::size_t most_open() const noexcept { return cuts_.capacity(); }
  /// Where a blade went between a cell and the next up an axis.
  const FaceCut& cut_at(Index cell, std::size_t axis) const noexcept {
    return is_open(cell, 2 * axis + 1) ? cuts_[at(cut_[3 * at(cell) + axis])] : nowhere;
  }
  /// Can something touch this face? An outer one, or an open one whose sides do not have the same nodes.
  bool is_exposed(Index cell, std::size_t face) const noexcept;

  /// Nodes as loaded and their copies now have numbers below this.
  Index n_loaded() const noexcept { return n_loaded_; }
  Index n_nodes() const noexcept { return n_loaded() + n_copies(); }
  Index n_copies() const noexcept { return static_cast<Index>(origin_.size()); }
  std::size_t most_copies() const noexcept { return most_copies_; }
  /// The node as loaded that this is, or is a copy of.
  Index origin(Index node) const noexcept {
    return node < n_loaded() ? node : origin_[at(node - n_loaded())];
  }
  /// Calls visit(cell, corner) for each cell that has this node, in a fixed order.
  template <class Visit>
  void each_corner(Index node, const Visit& visit) const noexcept {
    each_around(node, [&](Index cell, std::size_t corner) {
      if ((is_parted(cell) ? corners_[at(record_[at(cell)])][corner] : origin(node)) == node)
        visit(cell, corner);
    });
  }
  /// The same for all that have the node as loaded or a copy of it.
  template <class Visit>
  void each_around(Index node, const Visit& visit) const noexcept {
    const Index loaded = origin(node);
    for (std::size_t corner = 8; corner-- > 0;)
      if (const Index cell = with_corner(loaded, corner); has_cell(cell)) visit(cell, corner);
  }
  /// Is it the corner of a face that something can touch?
  bool is_exposed(Index node) const noexcept;
  /// Is it a copy, or has it one?
  bool has_split(Index node) const noexcept { return has_split_[at(origin(node))] != 0; }

  /// A new list of what splits.
  void begin() noexcept { splits_.clear(); }
  /// Opens the face between two cells. Allocates nothing. @param cut  on the way from a to b
  /// @return whether it was joined; false, too, where there is no room for more copies, which is counted
  bool open(Index a, Index b, const FaceCut& cut = {}) noexcept;
  std::span<const NodeSplit> splits() const noexcept { return splits_; }  // since begin(), in their order
  std::uint64_t left_out() const noexcept { return left_out_; }           // faces for which there was no room
  std::int64_t n_open() const noexcept { return n_open_; }
  std::uint64_t n_resets() const noexcept { return n_resets_; }
  /// Joins all again. @param joined  void(node): called afterwards for each that had split, as often as it had
  template <class Joined>
  void reset(const Joined& joined) noexcept {
    forget_cuts();
    for (const Index node : origin_) has_split_[at(node)] = 0;
    const std::size_t n = origin_.size();
    for (std::size_t i = 0; i < n; ++i) joined(origin_[i]);
    origin_.clear();
  }
  void reset() noexcept {
    reset([](Index) {});
  }

 private:
  static constexpr FaceCut nowhere{-1, {}};
  static std::size_t at(Index n) noexcept { return static_cast<std::size_t>(n); }
  /// The cell that has a node as loaded at one of its corners, if there is one.
  Index with_corner(Index node, std::size_t corner) const noexcept;
  void forget_cuts() noexcept;
  std::size_t face_between(Index a, Index b) const noexcept;
  void part(Index node, Index from) noexcept;
  void give(Index cell, std::size_t corner, Index copy) noexcept;

  Index n_loaded_;
  CellSteps steps_;
  std::size_t most_copies_ = 0;
  std::vector<std::uint8_t> is_cell_, open_;  // by storage cell; open_: bit f: its face f is
  std::vector<std::int32_t> cut_;             // 3 cell + axis: its number in cuts_
  std::vector<FaceCut> cuts_;
  std::vector<OpenFace> open_faces_;  // of each of cuts_
  std::vector<Index> cells_, opened_;
  std::vector<std::int32_t> record_;  // by storage cell: its number in parted_; -1: none
  std::vector<Index> parted_;
  std::vector<Corners> corners_;  // of each of parted_
  std::vector<Index> origin_;     // of each copy
  std::vector<std::uint8_t> has_split_;
  std::vector<NodeSplit> splits_;
  std::uint64_t left_out_ = 0, n_resets_ = 0;
  std::int64_t n_open_ = 0;
};

}  // namespace palpate::physics
