#pragma once
// A hand whose motion presses tissue, as its messages tell it.

#include <algorithm>
#include <functional>

#include "common/message/messages.h"
#include "common/message/vec3.h"

namespace palpate::physics::test {

/// @param path    of the tip over time [m]
/// @param sample  the newest, of those that come every h seconds
inline ToolState recorded_hand(const std::function<Vec3(double)>& path, std::uint64_t sample,
                               double h = 1e-3) {
  ToolState state;
  state.tick = sample;
  state.sample = sample;
  state.engaged = 1;
  state.stiffness = 500;
  state.damping = 1;
  state.force_limit = 3;
  const Vec3 now = path(h * static_cast<double>(sample));
  state.p_WT = state.proxy = array(now);
  const std::uint64_t before = std::min<std::uint64_t>(sample - 1, max_told_samples);
  for (std::uint64_t back = 1; back <= before; ++back) {
    const Vec3 from = path(h * static_cast<double>(sample - back)) - now;
    for (std::size_t a = 0; a < 3; ++a)
      state.before[back - 1][a] = static_cast<float>(from[static_cast<Eigen::Index>(a)]);
  }
  state.n_before = static_cast<std::uint32_t>(before);
  return state;
}

}  // namespace palpate::physics::test
