#include "physics_node/collision/facets.h"

#include <algorithm>

namespace palpate::physics {

Facets::Facets(const Candidates& candidates)
    : patterns_(triangle_patterns(candidates.moving().body().lattice)) {
  std::size_t most_of_kind = 0;
  for (const auto& patterns : patterns_) most_of_kind = std::max(most_of_kind, patterns.size());
  facets_.reserve(candidates.most() * (most_of_kind + 1));
  in_facet_.reserve(candidates.most());
  restart(candidates);
}

void Facets::restart(const Candidates& candidates) noexcept {
  const Lattice& lattice = candidates.moving().body().lattice;
  const BodyModel& moving = candidates.moving();
  const auto mask = [&](Index cell) { return moving.mask(cell); };
  facets_.clear();
  in_facet_.assign(candidates.size(), 0);
  for (std::uint32_t n = 0; n < candidates.size(); ++n) {
    const Index cell = candidates.cell()[n];
    for (const TrianglePattern& triangle : patterns_[static_cast<std::size_t>(lattice.row_kind(cell))]) {
      if (!holds(triangle.edges[0], cell, mask)) continue;
      const std::int32_t b = candidates.at_cell(cell + triangle.corner[0]);
      const std::int32_t c = candidates.at_cell(cell + triangle.corner[1]);
      if (b < 0 || c < 0 || !is_exposed(triangle, cell, mask)) continue;
      const Corners corners{n, static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
      facets_.push_back(corners);
      for (const std::uint32_t corner : corners) in_facet_[corner] = 1;
    }
  }
  for (std::uint32_t n = 0; n < candidates.size(); ++n)
    if (in_facet_[n] == 0) facets_.push_back({n, n, n});
}

}  // namespace palpate::physics
