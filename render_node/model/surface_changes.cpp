#include "render_node/model/surface_changes.h"

#include <algorithm>

namespace palpate::render {
namespace {

constexpr std::size_t page_memory = sizeof(SurfaceChange) + 64;  // with its place in the map
constexpr std::size_t facet_memory = sizeof(Corners) + sizeof(std::uint32_t);

}  // namespace

ChunkFate SurfaceChanges::take(const SurfaceChange& page) {
  if (page.revision < revision_) return ChunkFate::stale;
  if (page.revision > revision_) begin(page.revision);
  if (given_up_ || page.page < page_ || page.change <= change_) return ChunkFate::stale;
  const auto at = waiting_.find(page.page);
  if (at != waiting_.end()) {
    if (page.change < at->second->change) return ChunkFate::stale;
    *at->second = page;
    return ChunkFate::kept;
  }
  if (!memory_.add(page_memory)) return ChunkFate::too_large;
  waiting_.emplace(page.page, std::make_unique<SurfaceChange>(page));
  return ChunkFate::kept;
}

void SurfaceChanges::begin(std::uint32_t revision) noexcept {
  revision_ = revision;
  given_up_ = false;
  page_ = n_done_ = change_ = 0;
  waiting_.clear();
  memory_.clear();
}

ChunkFate SurfaceChanges::give_up(ChunkFate why) noexcept {
  begin(revision_);
  given_up_ = true;
  return why;
}

/// Pages follow one another from the first change that is not carried out to some last page, which ends where the newest of them says
/// that its change ends. @return end(): they do not
SurfaceChanges::Pages::const_iterator SurfaceChanges::last_of_the_complete(const Surface& surface) const {
  const auto first = waiting_.begin();
  if (first == waiting_.end()) return waiting_.end();
  if (first->second->first_change > n_done_ || first->second->first_vertex > surface.position.size())
    return waiting_.end();
  auto last = first;
  const SurfaceChange* newest = first->second.get();
  for (auto next = std::next(first); next != waiting_.end(); last = next++) {
    const SurfaceChange &before = *last->second, &page = *next->second;
    if (page.page != before.page + 1 || page.first_change != before.first_change + before.n_changes ||
        page.first_vertex != before.first_vertex + before.n_vertices)
      break;
    if (page.change >= newest->change) newest = &page;
  }
  const SurfaceChange& end = *last->second;
  const bool complete = end.first_change + end.n_changes == newest->total_changes &&
                        end.first_vertex + end.n_vertices == newest->total_vertices && &end == newest;
  return complete ? last : waiting_.end();
}

/// Every facet that a change is about is there then, and so are its corners.
bool SurfaceChanges::fits(const Surface& surface, Pages::const_iterator last) const {
  const SurfaceChange& end = *last->second;
  if (end.first_change + end.n_changes < n_done_ || end.total_vertices < surface.position.size())
    return false;
  std::size_t n_facets = surface.corners.size();
  for (auto at = waiting_.cbegin(); at != std::next(last); ++at) {
    const SurfaceChange& page = *at->second;
    for (std::uint32_t n = 0; n < page.n_changes; ++n) {
      if (page.first_change + n < n_done_) continue;
      const FacetChange& facet = page.facets[n];
      if (facet.facet > n_facets) return false;
      n_facets += facet.facet == n_facets ? 1 : 0;
      for (const std::uint32_t corner : facet.corners)
        if (corner >= end.total_vertices) return false;
    }
  }
  return end.total_facets <= n_facets;
}

ChunkFate SurfaceChanges::carry_out(Surface& surface, MemoryHold& memory) {
  if (surface.revision > revision_) begin(surface.revision);
  if (surface.revision < revision_) return ChunkFate::kept;
  const auto last = last_of_the_complete(surface);
  if (last == waiting_.end()) return ChunkFate::kept;
  if (!fits(surface, last)) return give_up(ChunkFate::malformed);
  const SurfaceChange& end = *last->second;
  const std::size_t more_facets =
      std::max<std::size_t>(end.total_facets, surface.corners.size()) - surface.corners.size();
  if (!memory.add((end.total_vertices - surface.position.size()) * sizeof(Array3f) +
                  more_facets * facet_memory))
    return give_up(ChunkFate::too_large);
  for (auto at = waiting_.cbegin(); at != std::next(last); ++at) {
    const SurfaceChange& page = *at->second;
    for (std::uint32_t n = 0; n < page.n_vertices; ++n)
      if (page.first_vertex + n >= surface.position.size()) surface.position.push_back(page.position[n]);
    for (std::uint32_t n = 0; n < page.n_changes; ++n) {
      if (page.first_change + n < n_done_) continue;
      const FacetChange& facet = page.facets[n];
      if (facet.facet == surface.corners.size()) {
        surface.corners.emplace_back();
        surface.rgba.emplace_back();
      }
      surface.corners[facet.facet] = facet.corners;
      surface.rgba[facet.facet] = facet.rgba;
    }
  }
  surface.corners.resize(end.total_facets);
  surface.rgba.resize(end.total_facets);
  surface.facets_hidden = end.facets_hidden;
  n_done_ = end.total_changes;
  change_ = end.change;
  page_ = end.page;
  forget_until(end.page);
  return ChunkFate::completed;
}

void SurfaceChanges::forget_until(std::uint32_t page) {
  waiting_.erase(waiting_.begin(), waiting_.upper_bound(page));
  memory_.clear();
  memory_.add(waiting_.size() * page_memory);
}

}  // namespace palpate::render
