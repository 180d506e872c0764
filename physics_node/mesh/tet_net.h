#pragma once
// Which tetrahedra of a mesh hang together while it is cut along their faces, and which node each of their corners is.
//
// Round a node as it was loaded its tetrahedra fall into fans: those that one comes to from each other through faces
// at the node that are still joined. Every fan has a node of its own. When a face that is opened parts a fan, the
// part with more tetrahedra keeps the node and the other takes a new one, a copy, which begins where the first is. So
// the two sides of an open face have corners of their own where the cut has gone on beyond them, and share those at
// its end; a face alone opens nothing. No tetrahedron comes, goes or changes its shape, and each fan keeps its own
// share of mass.
// Source: Nienhuys & van der Stappen 2001, cuts along faces; fans: as the links of Dick, Georgii & Westermann 2011.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics_node/lattice/node_split.h"
#include "physics_node/mesh/mesh_parts.h"

namespace palpate::physics {

class TetNet {
 public:
  using Corners = std::array<Index, 4>;
  static constexpr Index none = -1;
  static constexpr std::size_t most_around = 512;  // tetrahedra at a node

  /// @param mesh  of first order, no face of more than two tetrahedra @param most_copies  of nodes, of all there will ever be
  TetNet(const TetMesh& mesh, std::size_t most_copies);

  Index n_tets() const noexcept { return static_cast<Index>(corners_.size()); }
  const Corners& corners(Index tet) const noexcept { return corners_[at(tet)]; }
  /// Nodes of a face, anticlockwise from outside.
  MeshTriangle face(Index tet, std::size_t face) const noexcept {
    const auto& k = tet_faces[face];
    const Corners& of = corners(tet);
    return {of[k[0]], of[k[1]], of[k[2]]};
  }
  /// The tetrahedron on the other side of a face as the mesh was loaded; none: it is an outer one.
  Index beyond(Index tet, std::size_t face) const noexcept {
    const Index other = other_[4 * at(tet) + face];
    return other == none ? none : other / 4;
  }
  bool is_open(Index tet, std::size_t face) const noexcept { return open_[4 * at(tet) + face] != 0; }
  /// Can something touch this face? An outer one, or an open one whose sides do not have the same nodes.
  bool is_exposed(Index tet, std::size_t face) const noexcept;

  /// Nodes as loaded, and those in use now, whose numbers are below this.
  Index n_loaded() const noexcept { return n_loaded_; }
  Index n_nodes() const noexcept { return n_loaded_ + n_copies(); }
  Index n_copies() const noexcept { return static_cast<Index>(origin_.size()); }
  std::size_t most_copies() const noexcept { return most_copies_; }
  /// The node as loaded that this is, or is a copy of.
  Index origin(Index node) const noexcept { return node < n_loaded_ ? node : origin_[at(node - n_loaded_)]; }
  /// Calls visit(tet, corner) for each tetrahedron that has this node, in rising order.
  template <class Visit>
  void each_corner(Index node, const Visit& visit) const noexcept {
    for (const std::uint32_t entry : star_of(origin(node)))
      if (corners_[entry / 4][entry % 4] == node)
        visit(static_cast<Index>(entry / 4), std::size_t{entry % 4});
  }
  /// The same for all that have the node as loaded or a copy of it.
  template <class Visit>
  void each_around(Index node, const Visit& visit) const noexcept {
    for (const std::uint32_t entry : star_of(origin(node)))
      visit(static_cast<Index>(entry / 4), std::size_t{entry % 4});
  }
  /// Is it the corner of a face that something can touch?
  bool is_exposed(Index node) const noexcept;
  /// Is it a copy, or has it one?
  bool has_split(Index node) const noexcept { return has_split_[at(origin(node))] != 0; }

  /// A new list of what splits.
  void begin() noexcept { splits_.clear(); }
  /// Opens the face between two tetrahedra. Allocates nothing.
  /// @return whether it was joined; false, too, where there is no room for more copies, which is counted
  bool open(Index a, Index b) noexcept;
  std::span<const NodeSplit> splits() const noexcept { return splits_; }  // since begin(), in their order
  std::uint64_t left_out() const noexcept { return left_out_; }           // faces for which there was no room
  std::int64_t n_open() const noexcept { return n_open_; }
  /// Joins all again.
  void reset() noexcept;

 private:
  static std::size_t at(Index n) noexcept { return static_cast<std::size_t>(n); }
  std::span<const std::uint32_t> star_of(Index loaded) const noexcept {
    return {star_.data() + star_begin_[at(loaded)], star_.data() + star_begin_[at(loaded) + 1]};
  }
  std::size_t face_between(Index a, Index b) const noexcept;
  void part(Index node, Index from) noexcept;
  void flood(Index node, Index from) noexcept;

  Index n_loaded_ = 0;
  std::size_t most_copies_ = 0;
  std::vector<Corners> loaded_, corners_;
  std::vector<Index> other_;        // 4 tet + face: the same of the other side
  std::vector<std::uint8_t> open_;  // of each face of each
  std::vector<std::size_t> star_begin_;
  std::vector<std::uint32_t> star_;  // 4 tet + corner, of each node as loaded
  std::vector<Index> origin_;        // of each copy
  std::vector<std::uint8_t> has_split_;
  std::vector<NodeSplit> splits_;
  std::vector<std::uint32_t> seen_;  // of each tetrahedron: the flood that reached it last
  std::uint32_t flood_ = 0;
  std::vector<Index> reached_;  // by the last flood
  std::uint64_t left_out_ = 0;
  std::int64_t n_open_ = 0;
};

}  // namespace palpate::physics
