#pragma once
// What an image holds below its skin.

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "physics_node/body/cells.h"

namespace palpate::physics {

/// Of a place in an image, by trilinear weights of the centres of those cells around it that are `shown`;
/// nothing: none is. Beyond the outermost centres the image goes on as it is there.
/// @param shown  of each cell
inline std::optional<double> intensity_at(const Cells& cells, const Vec3& p,
                                          const std::vector<std::uint8_t>& shown) {
  std::array<std::array<std::size_t, 2>, 3> at{};  // of the cell before and the one behind, along each axis
  std::array<std::array<double, 2>, 3> w{};
  std::size_t stride = 1;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const int last = cells.size[a] - 1;
    const double x = std::clamp((p[a] - cells.corner[a]) / cells.spacing[a] - 0.5, 0.0, 1.0 * last);
    const int low = static_cast<int>(x);
    at[axis] = {stride * static_cast<std::size_t>(low),
                stride * static_cast<std::size_t>(std::min(low + 1, last))};
    w[axis] = {1 - (x - low), x - low};
    stride *= static_cast<std::size_t>(cells.size[a]);
  }
  double sum = 0, weights = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    const std::size_t i = n & 1, j = n >> 1 & 1, k = n >> 2;
    const std::size_t cell = at[0][i] + at[1][j] + at[2][k];
    const double weight = shown[cell] != 0 ? w[0][i] * w[1][j] * w[2][k] : 0;
    sum += weight * static_cast<double>(cells.intensity[cell]);
    weights += weight;
  }
  return weights > 0 ? std::optional(sum / weights) : std::nullopt;
}

/// Below a place on a skin, by so many cells along its normal, into the tissue.
inline std::optional<double> intensity_below(const Cells& cells, const Vec3& p, const Vec3& normal,
                                             double depth_in_cells, const std::vector<std::uint8_t>& shown) {
  return intensity_at(cells, p - depth_in_cells * cells.spacing.cwiseProduct(normal).norm() * normal, shown);
}

}  // namespace palpate::physics
