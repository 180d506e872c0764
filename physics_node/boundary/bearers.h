#pragma once
// The masses that carry a place of a surface.

#include <algorithm>
#include <array>
#include <cstdint>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// The place moves as the mean of its masses by their weights, which sum up to 1 and may be below 0 where the place
/// lies outside of what they span. A force on it is shared out by the same weights, and so does the same work.
struct Bearers {
  std::array<double, 8> weight{};
  std::array<Index, 8> node{};
  std::uint32_t n = 0;  // 0: scenery

  static Bearers alone(Index node) noexcept {
    Bearers one;
    one.weight[0] = 1, one.node[0] = node, one.n = 1;
    return one;
  }
  /// @param at  Vec3(node)
  template <class At>
  Vec3 mean(const At& at) const noexcept {
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i = 0; i < n; ++i) sum += weight[i] * at(node[i]);
    return sum;
  }
  /// Of the place, as its masses move. @param moving  NodeMotion [m]
  template <class Moving>
  Vec3 displacement(const Moving& moving) const noexcept {
    return mean([&](Index one) { return moving.displacement(one); });
  }
  /// Is it so of all of them? @param is  bool(node)
  template <class Is>
  bool all(const Is& is) const noexcept {
    return std::all_of(node.begin(), node.begin() + n, is);
  }
  bool operator==(const Bearers&) const = default;
};

}  // namespace palpate::physics
