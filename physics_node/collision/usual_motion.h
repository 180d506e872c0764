#pragma once
// The motion that most of many have: what a frame of reference takes, so that the few that move otherwise do
// not matter.

#include <algorithm>
#include <array>

#include "common/math/vec3.h"

namespace palpate::physics {

/// The median of at(0) ... at(n - 1), component by component, from 255 of them at most, evenly spread; of
/// those that are finite, zero of none.
template <class At>
Vec3 usual_motion(std::size_t n, const At& at) noexcept {
  constexpr std::size_t most = 255;
  const std::size_t looked_at = std::min(n, most);
  std::array<std::array<double, most>, 3> of;
  std::size_t sampled = 0;
  for (std::size_t s = 0; s < looked_at; ++s) {
    const Vec3 v = at(s * n / looked_at);
    if (!v.allFinite()) continue;
    for (std::size_t k = 0; k < 3; ++k) of[k][sampled] = v[static_cast<int>(k)];
    ++sampled;
  }
  if (sampled == 0) return Vec3::Zero();
  Vec3 usual;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto middle = of[k].begin() + static_cast<std::ptrdiff_t>(sampled / 2);
    std::nth_element(of[k].begin(), middle, of[k].begin() + static_cast<std::ptrdiff_t>(sampled));
    usual[static_cast<int>(k)] = *middle;
  }
  return usual;
}

}  // namespace palpate::physics
