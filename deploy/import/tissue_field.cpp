#include "deploy/import/tissue_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics_node/body/cells.h"

namespace palpate {

TissueField::TissueField(const Volume& volume, double keep_min, double keep_max, bool largest, double grain) {
  physics::Cells cells;
  cells.size = {volume.size[0], volume.size[1], volume.size[2]};
  cells.filled.resize(volume.n_cells());
  const bool mirrored = volume.is_left_handed();
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const double cell = static_cast<double>(volume.at(mirrored ? volume.size[0] - 1 - i : i, j, k));
        cells.filled[cells.index(i, j, k)] = cell >= keep_min && cell <= keep_max ? 1 : 0;
      }
  if (largest) keep_largest_component(cells);

  share_.size = volume.size;
  share_.spacing = volume.spacing;
  share_.intensity.assign(cells.filled.begin(), cells.filled.end());
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  std::size_t kept = 0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        if (!cells.is_filled(i, j, k)) continue;
        ++kept;
        const Eigen::Vector3d corner = Eigen::Vector3d(i, j, k).cwiseProduct(volume.spacing);
        low_ = low_.cwiseMin(corner);
        high_ = high_.cwiseMax(corner + volume.spacing);
      }
  tissue_ = static_cast<double>(kept) * volume.spacing.prod();
  std::array<int, 3> boxes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = volume.size[axis] * volume.spacing[static_cast<Eigen::Index>(axis)];
    boxes[axis] = std::clamp(static_cast<int>(std::lround(length / grain)), 1, volume.size[axis]);
  }
  share_ = resample(share_, boxes);
}

double TissueField::of(int i, int j, int k) const noexcept {
  const bool inside =
      i >= 0 && j >= 0 && k >= 0 && i < share_.size[0] && j < share_.size[1] && k < share_.size[2];
  return inside ? static_cast<double>(share_.at(i, j, k)) : 0.0;
}

double TissueField::at(const Eigen::Vector3d& x) const noexcept {
  std::array<int, 3> cell{};
  std::array<double, 3> part{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double middle =
        x[static_cast<Eigen::Index>(axis)] / share_.spacing[static_cast<Eigen::Index>(axis)] - 0.5;
    const double whole = std::floor(std::clamp(middle, -2.0, share_.size[axis] + 1.0));
    cell[axis] = static_cast<int>(whole);
    part[axis] = std::clamp(middle - whole, 0.0, 1.0);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> of_corner = cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool up = (corner >> axis & 1) != 0;
      weight *= up ? part[axis] : 1 - part[axis];
      of_corner[axis] += up ? 1 : 0;
    }
    if (weight > 0) sum += weight * of(of_corner[0], of_corner[1], of_corner[2]);
  }
  return sum;
}

}  // namespace palpate
