#include "physics_node/collision/point_grid.h"

#include <algorithm>
#include <bit>

namespace palpate::physics {

PointGrid::PointGrid(std::size_t most)
    : bucket_mask_(static_cast<std::uint32_t>(std::bit_ceil(std::max<std::size_t>(2 * most, 16)) - 1)),
      head_(bucket_mask_ + std::size_t{1}, -1),
      entries_(most) {}

void PointGrid::clear(double size) noexcept {
  // Only the buckets in use: a large grid with few points is as quick as a small one.
  if (4 * n_ < head_.size()) {
    for (std::size_t n = 0; n < n_; ++n) head_[bucket_of(entries_[n].cell)] = -1;
  } else {
    std::fill(head_.begin(), head_.end(), -1);
  }
  n_ = 0;
  inverse_size_ = 1 / size;
}

void PointGrid::insert(std::uint32_t id, const Eigen::Vector3d& p) noexcept {
  if (n_ == entries_.size()) return;
  Entry& e = entries_[n_];
  e.cell = cell_of(p);
  e.id = id;
  std::int32_t& head = head_[bucket_of(e.cell)];
  e.next = head;
  head = static_cast<std::int32_t>(n_++);
}

}  // namespace palpate::physics
