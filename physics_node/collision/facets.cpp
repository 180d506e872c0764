#include "physics_node/collision/facets.h"

namespace palpate::physics {

Facets::Facets(const Candidates& candidates) : triangles_(candidates.moving().body()) {
  facets_.reserve(candidates.most() + triangles_.most(candidates.most()));
  in_facet_.reserve(candidates.most());
  restart(candidates);
}

void Facets::restart(const Candidates& candidates) noexcept {
  const Adjacency& now = candidates.moving().adjacency();
  facets_.clear();
  in_facet_.assign(candidates.size(), 0);
  const auto is_candidate = [&](Index node) { return candidates.at_cell(node) >= 0; };
  for (std::uint32_t n = 0; n < candidates.size(); ++n)
    triangles_.each(candidates.cell()[n], now, is_candidate, [&](Index b, Index c) {
      const Corners corners{n, static_cast<std::uint32_t>(candidates.at_cell(b)),
                            static_cast<std::uint32_t>(candidates.at_cell(c))};
      facets_.push_back(corners);
      for (const std::uint32_t corner : corners) in_facet_[corner] = 1;
    });
  for (std::uint32_t n = 0; n < candidates.size(); ++n)
    if (in_facet_[n] == 0) facets_.push_back({n, n, n});
}

}  // namespace palpate::physics
