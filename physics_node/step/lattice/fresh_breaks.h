#pragma once
// The elements that broke in the last step, and those that were cut after it.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "physics_node/body/topology_events.h"

namespace palpate::physics {

/// Made anew by each step: what broke in storage order, which does not depend on the number of threads, then what was cut.
struct FreshBreaks {
  std::vector<EdgeGone> list;  // never grows beyond what was reserved
  std::vector<CellGone> cells;
  bool overflow = false;  // the list is not all: anything may have changed since the step before
  bool replaced = false;  // the state was set from outside after the last step

  void reserve(std::int64_t n_elements) {
    list.reserve(std::min(TopologyEvents::most, static_cast<std::size_t>(n_elements)));
  }
  void reserve_cells(std::size_t n_cells) { cells.reserve(std::min(TopologyEvents::most, n_cells)); }
  void begin_step() noexcept {
    list.clear();
    cells.clear();
    overflow = replaced;
    replaced = false;
  }
  void add(const EdgeGone& broken) noexcept {
    if (list.size() < list.capacity()) {
      list.push_back(broken);
    } else {
      overflow = true;
    }
  }
  void add(const CellGone& broken) noexcept {
    if (cells.size() < cells.capacity()) {
      cells.push_back(broken);
    } else {
      overflow = true;
    }
  }
  /// All elements may live or be gone now: known at once, and still after the next step.
  void replace_all() noexcept {
    list.clear();
    cells.clear();
    overflow = replaced = true;
  }
};

}  // namespace palpate::physics
