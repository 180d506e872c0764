#include "deploy/import/stack_slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"

namespace palpate {
namespace {

constexpr double evenness = 0.1;   // of a step: scanners are not better than 1 %, a missing slice is 100 %
constexpr double straight = 0.02;  // of a step, sideways: about one degree

std::string name_of(const Slice& slice) { return std::filesystem::path(slice.file).filename().string(); }

Eigen::Vector3d normal_of(const Slice& slice) {
  return slice.volume.orientation.value_or(Eigen::Matrix3d::Identity()).col(2);
}

void check_alike(const std::string& where, const Slice& first, const Slice& other) {
  const auto &a = first.volume, &b = other.volume;
  const bool alike = a.size == b.size && b.size[2] == 1 &&
                     (a.spacing - b.spacing).head<2>().norm() < 1e-4 * a.spacing[0] &&
                     (a.orientation.value_or(Eigen::Matrix3d::Identity()) -
                      b.orientation.value_or(Eigen::Matrix3d::Identity()))
                             .norm() < 1e-3;
  if (!alike)
    throw InputError(where + ": " + name_of(first) + " and " + name_of(other) +
                     " differ in size, spacing or direction; name a folder with one series");
}

/// The step from slice to slice. @throws InputError: not always the same, or not along the normal
Eigen::Vector3d common_step(const std::string& where, const std::vector<Slice>& slices) {
  const Eigen::Vector3d whole = slices.back().volume.origin - slices.front().volume.origin;
  const Eigen::Vector3d mean = whole / static_cast<double>(slices.size() - 1);
  for (std::size_t k = 1; k < slices.size(); ++k) {
    const Eigen::Vector3d step = slices[k].volume.origin - slices[k - 1].volume.origin;
    if (!((step - mean).norm() <= evenness * mean.norm()) || mean.norm() == 0)
      throw InputError(fmt::format(
          "{}: from {} to {} the step is {:.4g} mm, on average it is {:.4g} mm; give every slice once", where,
          name_of(slices[k - 1]), name_of(slices[k]), mm_from_m(step.norm()), mm_from_m(mean.norm())));
  }
  if ((mean - mean.norm() * normal_of(slices.front())).norm() > straight * mean.norm())
    throw InputError(where +
                     ": its slices are sheared (tilted gantry); resample them onto a straight grid first");
  return mean;
}

}  // namespace

void sort_slices(std::vector<Slice>& slices) {
  if (slices.empty()) return;
  const Eigen::Vector3d normal = normal_of(slices.front());
  std::stable_sort(slices.begin(), slices.end(), [&](const Slice& a, const Slice& b) {
    return normal.dot(a.volume.origin) < normal.dot(b.volume.origin);
  });
}

Volume stack_slices(const std::string& where, const std::vector<Slice>& slices) {
  if (slices.size() < 2) throw InputError(where + ": is a single slice; give all files of the series");
  for (const auto& slice : slices) check_alike(where, slices.front(), slice);
  Volume volume;
  const auto& first = slices.front().volume;
  volume.size = check_size(where, {first.size[0], first.size[1], static_cast<std::int64_t>(slices.size())});
  volume.spacing = first.spacing;
  volume.spacing[2] = common_step(where, slices).norm();
  check_spacing(where, volume.spacing);
  volume.orientation = first.orientation;
  volume.origin = first.origin;
  for (const auto& slice : slices)
    volume.intensity.insert(volume.intensity.end(), slice.volume.intensity.begin(),
                            slice.volume.intensity.end());
  return volume;
}

}  // namespace palpate
