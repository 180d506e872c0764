#pragma once
// Points hashed by the cell of space that they are in, to find those near a place. On some levels, each with
// cells of its own size: those that are looked for nearby do not pay for the few that are looked for far
// around. Source: Ericson, Real-Time Collision Detection, 7.2 (hierarchical grids).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace palpate::physics {

class PointGrid {
 public:
  static constexpr std::uint32_t levels = 4;

  /// @param most  points that will ever be in it; memory is taken here and never again
  explicit PointGrid(std::size_t most);

  /// Forgets all points. @param size  of cells, by level [m]
  void clear(const std::array<double, levels>& size) noexcept;
  /// @param id  less than 2^30; @param level  less than `levels`
  void insert(std::uint32_t id, std::uint32_t level, const Eigen::Vector3d& p) noexcept;
  /// Puts what was inserted in order, points of a cell beside each other; before anything is visited.
  void arrange() noexcept;

  /// Calls visit(id, p) for every point of a level in the box [lo, hi], in a fixed order.
  template <class Visit>
  void visit_box(std::uint32_t level, const Eigen::Vector3d& lo, const Eigen::Vector3d& hi,
                 const Visit& visit) const {
    if (of_level_[level] == 0) return;
    const Eigen::Vector3i a = cell_of(level, lo), b = cell_of(level, hi);
    if ((b - a + Eigen::Vector3i::Ones()).cast<double>().prod() > static_cast<double>(n_)) {
      for (std::size_t n = 0; n < n_; ++n)
        if (arranged_[n].level == level && is_between(arranged_[n].p, lo, hi))
          visit(arranged_[n].id, arranged_[n].p);
      return;
    }
    for (int z = a.z(); z <= b.z(); ++z)
      for (int y = a.y(); y <= b.y(); ++y)
        for (int x = a.x(); x <= b.x(); ++x) {
          const std::uint32_t bucket = bucket_of(level, {x, y, z});
          for (std::uint32_t n = first_[bucket]; n < first_[bucket + 1]; ++n) {
            const Entry& e = arranged_[n];
            // A bucket may hold points of other cells, which are visited from there.
            if (is_between(e.p, lo, hi) && e.level == level && e.cell == Eigen::Vector3i(x, y, z))
              visit(e.id, e.p);
          }
        }
  }

 private:
  struct Entry {
    Eigen::Vector3d p;
    Eigen::Vector3i cell;
    std::uint32_t id : 30;
    std::uint32_t level : 2;
  };
  static bool is_between(const Eigen::Vector3d& p, const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
    return p.x() >= lo.x() && p.x() <= hi.x() && p.y() >= lo.y() && p.y() <= hi.y() && p.z() >= lo.z() &&
           p.z() <= hi.z();
  }
  Eigen::Vector3i cell_of(std::uint32_t level, const Eigen::Vector3d& p) const {
    return (p * inverse_size_[level]).array().floor().max(-1e9).min(1e9).cast<int>();
  }
  std::uint32_t bucket_of(std::uint32_t level, const Eigen::Vector3i& c) const {
    const auto mix = level * 2654435769U ^ static_cast<std::uint32_t>(c.x()) * 73856093U ^
                     static_cast<std::uint32_t>(c.y()) * 19349663U ^
                     static_cast<std::uint32_t>(c.z()) * 83492791U;
    return mix & last_bucket_;
  }

  std::array<double, levels> inverse_size_{1, 1, 1, 1};
  std::array<std::size_t, levels> of_level_{};  // points
  std::uint32_t last_bucket_ = 0;
  std::size_t n_ = 0;
  std::vector<Entry> inserted_, arranged_;  // (n_)
  std::vector<std::uint32_t> first_;        // of each bucket, in arranged_
};

}  // namespace palpate::physics
