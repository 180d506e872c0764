#include "physics_node/body/deformable.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/scene/shape_spec.h"

namespace palpate::physics {
namespace {

/// Calls visit(i, j, k) for the filled cells within a Chebyshev radius. @return whether that was the whole image
template <class Visit>
bool for_each_filled_near(const Cells& cells, const Vec3i& centre, int radius, const Visit& visit) {
  const Vec3i lo = (centre.array() - radius).max(0);
  const Vec3i hi = (centre.array() + radius).min(cells.size.array() - 1);
  for (int k = lo.z(); k <= hi.z(); ++k)
    for (int j = lo.y(); j <= hi.y(); ++j)
      for (int i = lo.x(); i <= hi.x(); ++i)
        if (cells.filled[cells.index(i, j, k)] != 0) visit(i, j, k);
  return (lo.array() <= 0).all() && (hi.array() >= cells.size.array() - 1).all();
}

void mark_nearest(Cells& cells, const Vec3i& centre, int wanted) {
  using Found = std::pair<double, std::size_t>;  // distance [m], cell
  std::vector<Found> found;
  const auto n = static_cast<std::size_t>(wanted);
  // A cell outside the radius is further than (radius + 1) of the smallest spacing. Grow until that is beyond the
  // last one wanted.
  for (int radius = static_cast<int>(std::ceil(std::cbrt(wanted)));; radius *= 2) {
    found.clear();
    const bool whole = for_each_filled_near(cells, centre, radius, [&](int i, int j, int k) {
      const Vec3 away = cells.spacing.cwiseProduct((Vec3i(i, j, k) - centre).cast<double>());
      found.emplace_back(away.norm(), cells.index(i, j, k));
    });
    std::sort(found.begin(), found.end());
    const bool enough = found.size() >= n && found[n - 1].first < (radius + 1) * cells.spacing.minCoeff();
    if (enough || whole) break;
  }
  found.resize(std::min(found.size(), n));
  for (const auto& [distance, cell] : found) cells.deformable[cell] = 1;
}

}  // namespace

Vec3i gravity_cell(const Cells& cells) {
  // All cells weigh the same: the mean of their indices, in whole numbers until the end.
  Eigen::Matrix<std::int64_t, 3, 1> sum = Eigen::Matrix<std::int64_t, 3, 1>::Zero();
  std::int64_t count = 0;
  std::size_t n = 0;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j) {
      std::int64_t in_row = 0;
      for (int i = 0; i < cells.size.x(); ++i, ++n) {
        if (cells.filled[n] == 0) continue;
        ++in_row;
        sum.x() += i;
      }
      sum.y() += in_row * j;
      sum.z() += in_row * k;
      count += in_row;
    }
  return (sum.cast<double>() / static_cast<double>(count)).array().round().cast<int>();
}

void mark_deformable(Cells& cells, const DeformableRegion& region) {
  if (region.all) {
    cells.deformable = cells.filled;
    return;
  }
  cells.deformable.assign(cells.filled.size(), 0);
  const Vec3i centre = region.gravity_center
                           ? gravity_cell(cells)
                           : Vec3i(region.center_voxel[0], region.center_voxel[1], region.center_voxel[2]);
  if (region.nearest) {
    mark_nearest(cells, centre, *region.nearest);
  } else {
    for_each_filled_near(cells, centre, region.radius_voxels,
                         [&](int i, int j, int k) { cells.deformable[cells.index(i, j, k)] = 1; });
  }
}

}  // namespace palpate::physics
