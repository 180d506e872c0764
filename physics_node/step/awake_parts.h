#pragma once
// Which nodes of a body that is awake in parts may be elsewhere than at rest.

#include <cstdint>

#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

struct AwakeParts {
  const std::uint8_t* marks = nullptr;  // of each storage cell; bit 0: it moves
  double most_moved = 0;                // how far one may be from rest, at most [m]

  bool rests(Index node) const noexcept { return (marks[node] & 1) == 0; }
};

}  // namespace palpate::physics
