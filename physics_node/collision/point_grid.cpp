#include "physics_node/collision/point_grid.h"

#include <algorithm>
#include <bit>

namespace palpate::physics {
namespace {

std::uint32_t buckets_for(std::size_t points) {
  return static_cast<std::uint32_t>(std::bit_ceil(std::max<std::size_t>(2 * points, 16)));
}

}  // namespace

PointGrid::PointGrid(std::size_t most)
    : inserted_(most), arranged_(most), first_(buckets_for(most) + std::size_t{1}, 0) {}

void PointGrid::clear(const std::array<double, levels>& size) noexcept {
  n_ = 0;
  of_level_ = {};
  for (std::size_t level = 0; level < levels; ++level) inverse_size_[level] = 1 / size[level];
}

void PointGrid::insert(std::uint32_t id, std::uint32_t level, const Eigen::Vector3d& p) noexcept {
  if (n_ == inserted_.size()) return;
  ++of_level_[level];
  inserted_[n_++] = {p, cell_of(level, p), id & 0x3fffffffU, level & 3U};
}

void PointGrid::arrange() noexcept {
  // No more buckets than points need: a large grid with few points is as quick as a small one.
  const std::uint32_t buckets = buckets_for(n_);
  last_bucket_ = buckets - 1;
  std::fill_n(first_.begin(), buckets + std::size_t{1}, 0U);
  for (std::size_t n = 0; n < n_; ++n) ++first_[bucket_of(inserted_[n].level, inserted_[n].cell)];
  std::uint32_t sum = 0;
  for (std::size_t b = 0; b <= buckets; ++b) first_[b] = sum += b < buckets ? first_[b] : 0;
  // From the last to the first, so that first_ ends at the beginning of each bucket.
  for (std::size_t n = n_; n-- > 0;)
    arranged_[--first_[bucket_of(inserted_[n].level, inserted_[n].cell)]] = inserted_[n];
}

}  // namespace palpate::physics
