#include "common/record/volume_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/math/units.h"

namespace palpate {

std::array<int, 3> check_size(const std::string& where, const std::array<std::int64_t, 3>& size) {
  const auto text = fmt::format("{} x {} x {}", size[0], size[1], size[2]);
  if (*std::min_element(size.begin(), size.end()) < 1)
    throw InputError(fmt::format("{}: its size is {} cells; each must be at least 1", where, text));
  // One factor after the other, so that the product cannot overflow.
  std::int64_t cells = 1;
  for (const auto n : size) {
    if (n >= volume_cells_limit / cells + 1 || cells * n >= volume_cells_limit)
      throw InputError(
          fmt::format("{}: its size is {} cells; fewer than 1e9 in all are accepted", where, text));
    cells *= n;
  }
  return {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])};
}

void check_spacing(const std::string& where, const Eigen::Vector3d& spacing) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(spacing[axis]) || spacing[axis] <= 0 || spacing[axis] > 1)
      throw InputError(
          fmt::format("{}: its spacing is {:g} x {:g} x {:g} mm; each must be above 0 and at most 1000",
                      where, mm_from_m(spacing[0]), mm_from_m(spacing[1]), mm_from_m(spacing[2])));
}

void check_intensity(const std::string& where, const std::vector<float>& intensity) {
  const auto bad =
      std::count_if(intensity.begin(), intensity.end(), [](float v) { return !std::isfinite(v); });
  if (bad > 0)
    throw InputError(
        fmt::format("{}: {} of its values are not finite numbers; replace them first", where, bad));
}

void check_transfer(const std::string& where, const std::vector<TransferPoint>& transfer) {
  if (transfer.size() < 2)
    throw InputError(where + ": its transfer function has fewer than two points; give at least two");
  for (std::size_t i = 0; i < transfer.size(); ++i) {
    const auto& point = transfer[i];
    if (!std::isfinite(point.intensity) || (i > 0 && point.intensity < transfer[i - 1].intensity))
      throw InputError(where + ": its transfer function is not sorted by intensity; sort it");
    for (const double channel : point.rgba)
      if (!(channel >= 0 && channel <= 1))
        throw InputError(where + ": a colour of its transfer function is outside 0..1; keep it inside");
  }
}

}  // namespace palpate
