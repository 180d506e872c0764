#pragma once
// Nodes that are stepped on their own, several times in a step of the body, and what of them the next step must know: see hex_fast.h.

#include <array>
#include <cstdint>
#include <vector>

#include "physics_node/body/body.h"

namespace palpate::physics {

template <class Real>
struct FastNodes {
  std::vector<Index> node;           // storage cells, in storage order; EMPTY: none
  std::vector<std::int32_t> number;  // of a storage cell in the order of `node`, -1: it is none  (n_cells)
  std::vector<std::uint8_t> cell;    // 1: cells of this lowest corner are fast  (n_cells)
  using ByNode = std::vector<std::array<Real, 3>>;
  ByNode ahead;  // of the velocity that has the momentum, before that of the last step in the mean [m/s]
  ByNode
      held;  // acceleration that the last step took to be that of outer forces, until they are known [m/s^2]
  ByNode given;  // and what it was [m/s^2]

  /// @param body  finite elements or not
  explicit FastNodes(const Body& body);

  bool has(Index c) const noexcept { return !node.empty() && number[static_cast<std::size_t>(c)] >= 0; }
  bool has_cell(Index c) const noexcept { return !node.empty() && cell[static_cast<std::size_t>(c)] != 0; }
  Vec3 lead(Index c) const noexcept {  // `ahead` of a node [m/s]
    const std::array<Real, 3>& of = ahead[static_cast<std::size_t>(number[static_cast<std::size_t>(c)])];
    return {static_cast<double>(of[0]), static_cast<double>(of[1]), static_cast<double>(of[2])};
  }
  /// Outer forces accelerate a node by this. @return what of it the step has not yet done
  std::array<Real, 3> learn(Index c, const std::array<Real, 3>& acceleration) noexcept {
    const auto n = static_cast<std::size_t>(number[static_cast<std::size_t>(c)]);
    std::array<Real, 3> left;
    for (std::size_t a = 0; a < 3; ++a) {
      left[a] = acceleration[a] - held[n][a];
      given[n][a] += acceleration[a];
    }
    held[n] = {};
    return left;
  }
};

}  // namespace palpate::physics
