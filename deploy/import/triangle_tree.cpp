#include "deploy/import/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace palpate {

TriangleTree::TriangleTree(const TriangleSurface& surface) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Eigen::AlignedBox3d box;
    for (std::size_t n = 0; n < 3; ++n) box.extend(surface.corner(t, n));
    triangle_boxes_.push_back(box);
  }
  order_.resize(triangle_boxes_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) add(0, order_.size());
}

std::size_t TriangleTree::add(std::size_t first, std::size_t end) {
  const std::size_t node = boxes_.size();
  Eigen::AlignedBox3d box;
  for (std::size_t t = first; t < end; ++t) box.extend(triangle_boxes_[order_[t]]);
  boxes_.push_back(box);
  ranges_.emplace_back(first, end);
  right_.push_back(0);
  if (end - first <= leaf) return node;
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = first + (end - first) / 2;
  const auto at = [&](std::size_t t) { return order_.begin() + static_cast<std::ptrdiff_t>(t); };
  std::nth_element(at(first), at(middle), at(end), [&](std::size_t a, std::size_t b) {
    const double of_a = triangle_boxes_[a].center()[axis], of_b = triangle_boxes_[b].center()[axis];
    return of_a != of_b ? of_a < of_b : a < b;
  });
  add(first, middle);
  right_[node] = add(middle, end);
  return node;
}

}  // namespace palpate
