#pragma once
// What of a tetrahedron is on one side of a surface that crosses its edges: one to three tetrahedra, from a table.
//
// Source: F. Labelle, J. R. Shewchuk 2007. Deviation: a face with four corners is cut along its shorter diagonal, not by parity.

#include <algorithm>
#include <array>

#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

/// @tparam Points  has, of points of a type that it names Point: sign(p), 1 on the side that is kept, 0 on the surface, -1 beyond it;
///   node(p), the node of the mesh at a point; node(p, q), that where the surface crosses an edge; mesh(), to which tetrahedra are added
template <class Points>
class TetCut {
 public:
  using Index = physics::Index;
  using Point = typename Points::Point;

  /// @param open  there is nothing beyond the surface: how its own four-cornered sides are cut is free
  TetCut(Points& points, bool open) : points_(points), open_(open) {}

  /// Adds what is kept of one tetrahedron.
  void cut(std::array<Point, 4> points) {
    std::ranges::stable_sort(points, [&](Point a, Point b) { return points_.sign(a) > points_.sign(b); });
    const auto count = [&](int s) {
      return std::ranges::count_if(points, [&](Point p) { return points_.sign(p) == s; });
    };
    const auto in = count(1), out = count(-1);
    if (in == 0) return;
    std::array<Index, 4> tet{};
    if (out == 0 || in == 1) {  // whole, or the corner at the one
      for (std::size_t n = 0; n < 4; ++n)
        tet[n] = points_.sign(points[n]) < 0 ? points_.node(points[0], points[n]) : points_.node(points[n]);
      points_.mesh().tets.push_back(tet);
      return;
    }
    const Index a = points_.node(points[0]), b = points_.node(points[1]);
    if (out == 1 && in == 2) {  // two, one on the surface: a pyramid over a b and what they cut off
      const Index c = points_.node(points[2]), ad = points_.node(points[0], points[3]),
                  bd = points_.node(points[1], points[3]);
      const bool from_a = cut_along(a, bd, b, ad);
      points_.mesh().tets.push_back({c, a, b, from_a ? bd : ad});
      points_.mesh().tets.push_back({c, ad, bd, from_a ? a : b});
      return;
    }
    if (out == 1) {  // three: all but the fourth's corner
      const std::array<Index, 3> above{a, b, points_.node(points[2])};
      std::array<Index, 3> below{};
      for (std::size_t n = 0; n < 3; ++n) below[n] = points_.node(points[n], points[3]);
      std::array<bool, 3> down{};
      for (std::size_t n = 0; n < 3; ++n) {
        const std::size_t m = (n + 1) % 3;
        down[n] = cut_along(above[n], below[m], above[m], below[n]);
      }
      return add_prism(above, below, down);
    }
    // Two and two: a wedge with the edge a b, whose one side lies in the surface.
    const std::array<Index, 3> above{a, points_.node(points[0], points[2]),
                                     points_.node(points[0], points[3])};
    const std::array<Index, 3> below{b, points_.node(points[1], points[2]),
                                     points_.node(points[1], points[3])};
    std::array<bool, 3> down{};
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t m = (n + 1) % 3;
      down[n] = cut_along(above[n], below[m], above[m], below[n]);
    }
    if (open_ && down[0] == down[1] && down[1] == down[2]) down[1] = !down[1];
    add_prism(above, below, down);
  }

 private:
  Vec3 place(Index node) const { return points_.mesh().nodes[static_cast<std::size_t>(node)]; }

  /// Of the four-cornered face a b d c (a-d and b-c its diagonals): is it cut from a to d? Both sides of the face say the same.
  bool cut_along(Index a, Index d, Index b, Index c) const {
    const double one = (place(d) - place(a)).squaredNorm(), other = (place(c) - place(b)).squaredNorm();
    return one != other ? one < other : std::min(a, d) < std::min(b, c);
  }

  /// Of three nodes above and three below; the diagonal of each side goes down from the first (true) or from the second.
  void add_prism(const std::array<Index, 3>& above, const std::array<Index, 3>& below,
                 std::array<bool, 3> down) {
    // A node that two diagonals meet in; there is none where they go round.
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t m = (n + 1) % 3, l = (n + 2) % 3;
      const bool from_above = down[n] && !down[l];  // n to m, and n to l
      const bool from_below = !down[n] && down[l];
      if (!from_above && !from_below) continue;
      const auto& own = from_above ? above : below;
      const auto& far = from_above ? below : above;
      points_.mesh().tets.push_back({own[n], far[n], far[m], far[l]});
      // Side m l, whose diagonal goes from the m of one to the l of the other.
      const bool m_own = down[m] == from_above;
      points_.mesh().tets.push_back({own[n], own[m], own[l], m_own ? far[l] : far[m]});
      points_.mesh().tets.push_back({own[n], far[m], far[l], m_own ? own[m] : own[l]});
      return;
    }
    // The diagonals go round: a node in the middle sees every face.
    Vec3 middle = Vec3::Zero();
    for (std::size_t n = 0; n < 3; ++n) middle += (place(above[n]) + place(below[n])) / 6;
    const auto c = static_cast<Index>(points_.mesh().nodes.size());
    points_.mesh().nodes.push_back(middle);
    points_.mesh().tets.push_back({c, above[0], above[1], above[2]});
    points_.mesh().tets.push_back({c, below[0], below[1], below[2]});
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t m = (n + 1) % 3;
      points_.mesh().tets.push_back({c, above[n], above[m], down[n] ? below[m] : below[n]});
      points_.mesh().tets.push_back({c, below[n], below[m], down[n] ? above[n] : above[m]});
    }
  }

  Points& points_;
  bool open_;
};

}  // namespace palpate
