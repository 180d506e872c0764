#pragma once
// How often a closed surface goes round a place: what is inside of it.

#include <limits>
#include <vector>

#include "deploy/import/triangle_tree.h"

namespace palpate {

/// Winding numbers by the triangles that a ray along x meets. Triangles at one edge compute its crossing alike, so a ray slips through
/// no edge and no point between them.
class SurfaceWinding {
 public:
  /// @param surface  closed; kept by reference
  explicit SurfaceWinding(const TriangleSurface& surface) : surface_(surface), tree_(surface) {}

  /// Of a place that is not on the surface: 1 inside of one that is anticlockwise from outside, 0 outside, 2 where two overlap.
  int at(const Vec3& x) const {
    int sum = 0;
    for_each_met(x, [&](std::size_t, int turn) { sum += turn; });
    return sum;
  }
  /// Calls use(triangle, 1 or -1) for each that the ray from x on meets: 1 where it leaves.
  template <class Use>
  void for_each_met(const Vec3& x, const Use& use) const {
    Vec3 far = x;
    far.x() = std::numeric_limits<double>::max();
    tree_.for_each_in({x, far}, [&](std::size_t t) {
      const int turn = turn_of(t, x);
      if (turn != 0 && lies_beyond(t, x)) use(t, turn);
    });
  }
  const TriangleTree& tree() const noexcept { return tree_; }

 private:
  int turn_of(std::size_t triangle, const Vec3& x) const noexcept;
  bool lies_beyond(std::size_t triangle, const Vec3& x) const noexcept;

  const TriangleSurface& surface_;
  TriangleTree tree_;
};

}  // namespace palpate
