#pragma once
// Points hashed by the cell of space that they are in, to find those near a place.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace palpate::physics {

class PointGrid {
 public:
  /// @param most  points that will ever be in it; memory is taken here and never again
  explicit PointGrid(std::size_t most);

  /// Forgets all points. @param size  of a cell [m]
  void clear(double size) noexcept;
  void insert(std::uint32_t id, const Eigen::Vector3d& p) noexcept;
  bool empty() const { return n_ == 0; }

  /// Calls visit(id) for every point in the cells that the box [lo, hi] touches, in a fixed order.
  template <class Visit>
  void visit_box(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const Visit& visit) const {
    const Eigen::Vector3i a = cell_of(lo), b = cell_of(hi);
    if ((b - a + Eigen::Vector3i::Ones()).cast<double>().prod() > static_cast<double>(head_.size())) {
      for (std::size_t n = 0; n < n_; ++n) visit(entries_[n].id);
      return;
    }
    for (int z = a.z(); z <= b.z(); ++z)
      for (int y = a.y(); y <= b.y(); ++y)
        for (int x = a.x(); x <= b.x(); ++x)
          for (std::int32_t n = head_[bucket_of({x, y, z})]; n >= 0;
               n = entries_[static_cast<std::size_t>(n)].next) {
            const Entry& e = entries_[static_cast<std::size_t>(n)];
            if (e.cell.x() == x && e.cell.y() == y && e.cell.z() == z) visit(e.id);
          }
  }

 private:
  struct Entry {
    Eigen::Vector3i cell;
    std::uint32_t id;
    std::int32_t next;
  };
  Eigen::Vector3i cell_of(const Eigen::Vector3d& p) const {
    return (p * inverse_size_).array().floor().max(-1e9).min(1e9).cast<int>();
  }
  std::size_t bucket_of(const Eigen::Vector3i& c) const {
    const auto mix = static_cast<std::uint32_t>(c.x()) * 73856093U ^
                     static_cast<std::uint32_t>(c.y()) * 19349663U ^
                     static_cast<std::uint32_t>(c.z()) * 83492791U;
    return mix & bucket_mask_;
  }

  double inverse_size_ = 1;
  std::uint32_t bucket_mask_ = 0;
  std::size_t n_ = 0;
  std::vector<std::int32_t> head_;  // of each bucket, -1: empty
  std::vector<Entry> entries_;      // (n_)
};

}  // namespace palpate::physics
