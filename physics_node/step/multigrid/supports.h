#pragma once
// Nodes of a level that planes hold along their normals, in one Newton iteration.

#include <vector>

#include "physics_node/step/multigrid/coarsen.h"
#include "physics_node/step/multigrid/level.h"
#include "physics_node/step/plane_contact.h"

namespace palpate::physics {

/// A held direction is one in which a node does not move: the smoother's block leaves it out, and vectors have no part along it. The
/// next level holds a coarse node where the shares of the fine ones that are held make a whole node: the nodes of a face that lies
/// on a floor, or one node that is a coarse one. What it leaves out costs conjugate gradients an iteration or two.
/// Contract: allocates and throws nothing after construction.
class Supports {
 public:
  Supports() = default;
  explicit Supports(Index n_nodes) : of_(static_cast<std::size_t>(n_nodes), 0) {}

  void set(std::size_t node, PlaneSet planes) noexcept { of_[node] = planes; }
  PlaneSet of(std::size_t node) const noexcept { return of_[node]; }
  /// Those of a coarse plane from those of the finer level. @param up  see CoarserLevel
  void carry_up(const Supports& fine, const ShareTable& up, const GridPlane& plane) noexcept;

  /// Takes from the vectors of a plane's nodes what is held of them.
  template <class Real>
  void take_from(Three<Real>& three, const GridPlane& plane, std::span<const Plane> planes) const noexcept {
    for (Index i = plane.first; i < plane.last; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (of_[n] == 0) continue;
      const Vec3 part = directions_of(of_[n], planes).part_of(vector_of(three, i));
      for (std::size_t a = 0; a < 3; ++a)
        three[a][n] -= static_cast<Real>(part[static_cast<Eigen::Index>(a)]);
    }
  }
  /// The inverse blocks of a plane's nodes, without what is held.
  template <class Real>
  void hold_blocks(const LevelContext<Real>& m, const GridPlane& plane,
                   std::span<const Plane> planes) const noexcept {
    for (Index i = plane.first; i < plane.last; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (of_[n] != 0) hold_block(directions_of(of_[n], planes), m.inverse, n);
    }
  }

 private:
  std::vector<PlaneSet> of_;  // by node
};

}  // namespace palpate::physics
