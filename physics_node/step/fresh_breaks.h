#pragma once
// The elements that broke in the last step.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

/// An element that is no more: other = first + offset[kind of first's row][half].
struct Break {
  Index first = 0;  // storage cell from which its direction is of the first half
  Index other = 0;
  int half = 0;  // half direction
};

/// Made anew by each step, in storage order, which does not depend on the number of threads.
struct FreshBreaks {
  std::vector<Break> list;  // never grows beyond what was reserved
  bool overflow = false;    // the list is not all: anything may have changed since the step before
  bool replaced = false;    // the state was set from outside after the last step

  static constexpr std::size_t most = 65536;
  void reserve(std::int64_t n_elements) {
    list.reserve(std::min(most, static_cast<std::size_t>(n_elements)));
  }
  void begin_step() noexcept {
    list.clear();
    overflow = replaced;
    replaced = false;
  }
  void add(const Break& broken) noexcept {
    if (list.size() < list.capacity()) {
      list.push_back(broken);
    } else {
      overflow = true;
    }
  }
  /// All elements may live or be gone now: known at once, and still after the next step.
  void replace_all() noexcept {
    list.clear();
    overflow = replaced = true;
  }
};

}  // namespace palpate::physics
