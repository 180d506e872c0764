#pragma once
// Which elements of a mesh hang together while it is cut along their faces, and which node each of their corners is:
// tetrahedra, whose faces are triangles, or the triangles of a surface, whose faces are edges.
//
// Round a node as it was loaded its elements fall into fans: those that one comes to from each other through faces
// at the node that are still joined. Every fan has a node of its own. When a face that is opened parts a fan, the
// part with more elements keeps the node and the other takes a new one, a copy, which begins where the first is. So
// the two sides of an open face have corners of their own where the cut has gone on beyond them, and share those at
// its end; a face alone opens nothing. No element comes, goes or changes its shape, and each fan keeps its own
// share of mass.
// Source: Nienhuys & van der Stappen 2001, cuts along faces; fans: as the links of Dick, Georgii & Westermann 2011. Of
// surfaces: Mendoza & Laugier, facets that part, EQUATIONS C-24 and C-28.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/mesh/mesh_parts.h"
#include "physics_node/mesh/node_copies.h"

namespace palpate::physics {

/// What an element of N corners is: the corners of each of its faces, anticlockwise from outside, and which one each
/// does not have.
template <std::size_t N>
struct Simplex;
template <>
struct Simplex<4> {
  static constexpr auto faces = tet_faces;
  static constexpr std::array<std::size_t, 4> opposite = {3, 2, 0, 1};
};
template <>
struct Simplex<3> {
  static constexpr std::array<std::array<std::size_t, 2>, 3> faces = {{{0, 1}, {1, 2}, {2, 0}}};
  static constexpr std::array<std::size_t, 3> opposite = {2, 0, 1};
};

template <std::size_t N>
class SimplexNet : public NodeCopies {
 public:
  using Corners = std::array<Index, N>;
  using Face = std::array<Index, N - 1>;
  static constexpr Index none = -1;
  static constexpr std::size_t n_faces = N;
  static constexpr std::size_t most_around = 512;  // elements at a node

  /// @param elements  no face is of more than two @param most_copies  of nodes, of all there will ever be
  SimplexNet(const std::vector<Corners>& elements, std::size_t n_nodes, std::size_t most_copies);

  Index n_elements() const noexcept { return static_cast<Index>(corners_.size()); }
  const Corners& corners(Index element) const noexcept { return corners_[at(element)]; }
  /// Nodes of a face.
  Face face(Index element, std::size_t face) const noexcept {
    Face of;
    for (std::size_t c = 0; c < of.size(); ++c) of[c] = corners(element)[Simplex<N>::faces[face][c]];
    return of;
  }
  /// The element on the other side of a face as the mesh was loaded; none: it is an outer one.
  Index beyond(Index element, std::size_t face) const noexcept {
    const Index other = other_[N * at(element) + face];
    return other == none ? none : other / static_cast<Index>(N);
  }
  /// Which face of a it has in common with b; n_faces: none.
  std::size_t face_between(Index a, Index b) const noexcept;
  bool is_open(Index element, std::size_t face) const noexcept { return open_[N * at(element) + face] != 0; }
  /// The elements on both sides of each open face, in the order in which they were opened.
  std::span<const std::array<Index, 2>> open_faces() const noexcept { return open_faces_; }
  /// No more than these are ever opened.
  std::size_t most_open() const noexcept { return open_.size() / 2; }
  /// An outer face, or an open one whose sides do not have the same nodes: of a tetrahedron, one that something can
  /// touch.
  bool is_exposed(Index element, std::size_t face) const noexcept;

  /// Calls visit(element, corner) for each element that has this node, in rising order.
  template <class Visit>
  void each_corner(Index node, const Visit& visit) const noexcept {
    for (const std::uint32_t entry : star_of(origin(node)))
      if (corners_[entry / N][entry % N] == node)
        visit(static_cast<Index>(entry / N), std::size_t{entry % N});
  }
  /// The same for all that have the node as loaded or a copy of it.
  template <class Visit>
  void each_around(Index node, const Visit& visit) const noexcept {
    for (const std::uint32_t entry : star_of(origin(node)))
      visit(static_cast<Index>(entry / N), std::size_t{entry % N});
  }
  /// Is it the corner of an exposed face?
  bool is_exposed(Index node) const noexcept;

  /// A new list of what splits.
  void begin() noexcept { forget_splits(); }
  /// Opens the face between two elements. Allocates nothing.
  /// @return whether it was joined; false, too, where there is no room for more copies, which is counted
  bool open(Index a, Index b) noexcept;
  /// Joins all again.
  void reset() noexcept;

 private:
  static std::size_t at(Index n) noexcept { return static_cast<std::size_t>(n); }
  std::span<const std::uint32_t> star_of(Index loaded) const noexcept {
    return {star_.data() + star_begin_[at(loaded)], star_.data() + star_begin_[at(loaded) + 1]};
  }
  void join_faces();
  void part(Index node, Index from) noexcept;
  void flood(Index node, Index from) noexcept;

  std::vector<Corners> loaded_, corners_;
  std::vector<Index> other_;        // N element + face: the same of the other side
  std::vector<std::uint8_t> open_;  // of each face of each
  std::vector<std::array<Index, 2>> open_faces_;
  std::vector<std::size_t> star_begin_;
  std::vector<std::uint32_t> star_;  // N element + corner, of each node as loaded
  std::vector<std::uint32_t> seen_;  // of each element: the flood that reached it last
  std::uint32_t flood_ = 0;
  std::vector<Index> reached_;  // by the last flood
};

using TetNet = SimplexNet<4>;
using TriangleNet = SimplexNet<3>;

}  // namespace palpate::physics
