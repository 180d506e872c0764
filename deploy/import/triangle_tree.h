#pragma once
// Which triangles are in a box: a tree of boxes, each cut in two at the median.

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "deploy/import/triangle_surface.h"

namespace palpate {

class TriangleTree {
 public:
  explicit TriangleTree(const TriangleSurface& surface);

  /// Calls use(triangle) for each whose box meets `box`, edges included. The order is the same every time.
  template <class Use>
  void for_each_in(const Eigen::AlignedBox3d& box, const Use& use) const {
    if (boxes_.empty()) return;
    std::array<std::size_t, 64>
        waiting;  // a node for each level, and the tree is as deep as a number has bits
    std::size_t n = 0;
    waiting[n++] = 0;
    while (n > 0) {
      const std::size_t node = waiting[--n];
      if (!boxes_[node].intersects(box)) continue;
      const auto [first, end] = ranges_[node];
      if (end - first > leaf) {
        waiting[n++] = right_[node];
        waiting[n++] = node + 1;
        continue;
      }
      for (std::size_t t = first; t < end; ++t)
        if (triangle_boxes_[order_[t]].intersects(box)) use(order_[t]);
    }
  }

 private:
  static constexpr std::size_t leaf = 4;  // triangles

  std::size_t add(std::size_t first, std::size_t end);

  std::vector<Eigen::AlignedBox3d> triangle_boxes_, boxes_;  // of each triangle; of each node of the tree
  std::vector<std::size_t> order_;                           // triangles, node by node
  std::vector<std::pair<std::size_t, std::size_t>> ranges_;  // of each node, in that order
  std::vector<std::size_t> right_;                           // the second half; the first comes next
};

}  // namespace palpate
