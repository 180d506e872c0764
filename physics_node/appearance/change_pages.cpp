#include "physics_node/appearance/change_pages.h"

#include <algorithm>

namespace palpate::physics {
namespace {

/// Moves as many to the end of `into` as there is room for.
template <class T, std::size_t N>
void fill(std::array<T, N>& into, std::uint32_t& n, std::span<const T>& from) noexcept {
  const std::size_t some = std::min(N - n, from.size());
  std::copy_n(from.begin(), some, into.begin() + n);
  from = from.subspan(some);
  n += static_cast<std::uint32_t>(some);
}

}  // namespace

void ChangePages::begin(std::uint32_t body, std::uint32_t revision, std::uint32_t n_vertices) noexcept {
  page_ = SurfaceChange();
  page_.body = body;
  page_.revision = revision;
  page_.first_vertex = page_.total_vertices = n_vertices;
}

int ChangePages::add(std::span<const Array3f> vertices, std::span<const FacetChange> facets,
                     const Totals& totals, const std::function<void(const SurfaceChange&)>& sink) {
  ++page_.change;
  page_.total_vertices += static_cast<std::uint32_t>(vertices.size());
  page_.total_changes += static_cast<std::uint32_t>(facets.size());
  page_.total_facets = totals.facets;
  page_.facets_hidden = totals.hidden;
  const bool no_room = (vertices.empty() || page_.n_vertices == max_change_vertices) &&
                       (facets.empty() || page_.n_changes == max_change_facets);
  if (no_room && !(vertices.empty() && facets.empty())) turn();
  for (int pages = 1;; ++pages) {
    fill(page_.position, page_.n_vertices, vertices);
    fill(page_.facets, page_.n_changes, facets);
    sink(page_);
    if (vertices.empty() && facets.empty()) return pages;
    turn();
  }
}

void ChangePages::turn() noexcept {
  ++page_.page;
  page_.first_vertex += page_.n_vertices;
  page_.first_change += page_.n_changes;
  page_.n_vertices = page_.n_changes = 0;
}

}  // namespace palpate::physics
