#include "physics_node/appearance/numbered_surface.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace palpate::physics {
namespace {

constexpr Index scenery = -1;

/// Where a vertex of the scenery is, as its maker computes it each time.
struct RestHash {
  std::size_t operator()(const Vec3& p) const noexcept {
    std::size_t hash = 0;
    for (const double x : p) hash = 31 * hash + std::hash<double>()(x);
    return hash;
  }
};

/// A facet by which it is compared, and where it stands.
struct Placed {
  std::array<std::uint32_t, 5> facet;  // corners and colour
  std::uint32_t place;
  friend bool operator<(const Placed& a, const Placed& b) { return a.facet < b.facet; }
};

/// Sorted; equal ones in the order of their places.
template <class CornersOf>
std::vector<Placed> sorted(const std::vector<std::uint32_t>& rgba, const CornersOf& corners_of) {
  std::vector<Placed> all(rgba.size());
  for (std::size_t f = 0; f < all.size(); ++f) {
    const NumberedSurface::Corners c = corners_of(f);
    all[f] = {{c[0], c[1], c[2], c[3], rgba[f]}, static_cast<std::uint32_t>(f)};
  }
  std::stable_sort(all.begin(), all.end());
  return all;
}

/// Those of `a` that `b` has not as often, in the order of their places.
std::vector<Placed> without(const std::vector<Placed>& a, const std::vector<Placed>& b) {
  std::vector<Placed> left;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(left));
  std::sort(left.begin(), left.end(), [](const Placed& x, const Placed& y) { return x.place < y.place; });
  return left;
}

FacetChange at_place(std::uint32_t place, const Placed& of) {
  const auto& f = of.facet;
  return {place, {f[0], f[1], f[2], f[3]}, f[4]};
}

}  // namespace

NumberedSurface::NumberedSurface(Surface surface)
    : rest_(std::move(surface.rest)),
      cell_(std::move(surface.cell)),
      facets_(std::move(surface.facets)),
      rgba_(std::move(surface.rgba)),
      hidden_(surface.hidden),
      n_leading_(cell_.size()),
      n_first_(rest_.size()),
      is_rigid_(cell_.empty()) {
  cell_.resize(rest_.size(), scenery);
}

/// @return number here of each vertex of `next`
std::vector<std::uint32_t> NumberedSurface::numbers_of(const Surface& next,
                                                       std::vector<SurfaceDelta::Vertex>& added) const {
  std::unordered_map<Index, std::uint32_t> of_mass;
  std::unordered_map<Vec3, std::uint32_t, RestHash> of_scenery;
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    const auto number = static_cast<std::uint32_t>(v);
    if (cell_[v] >= 0)
      of_mass.emplace(cell_[v], number);
    else
      of_scenery.emplace(rest_[v], number);
  }
  const auto number_in = [&](auto& known, const auto& key, const SurfaceDelta::Vertex& vertex) {
    const auto free = static_cast<std::uint32_t>(rest_.size() + added.size());
    const auto [at, is_new] = known.try_emplace(key, free);
    if (is_new) added.push_back(vertex);
    return at->second;
  };
  std::vector<std::uint32_t> numbers(next.n_vertices());
  for (std::size_t v = 0; v < numbers.size(); ++v)
    numbers[v] = v < next.n_moving() ? number_in(of_mass, next.cell[v], {next.rest[v], next.cell[v]})
                                     : number_in(of_scenery, next.rest[v], {next.rest[v], scenery});
  return numbers;
}

SurfaceDelta NumberedSurface::delta_to(const Surface& next) const {
  SurfaceDelta delta;
  delta.total_facets = next.facets.size();
  delta.hidden = next.hidden;
  const auto number = numbers_of(next, delta.vertices);
  const auto here = sorted(rgba_, [this](std::size_t f) { return facets_[f]; });
  const auto there = sorted(next.rgba, [&](std::size_t f) {
    Corners corners = next.facets[f];
    for (std::uint32_t& corner : corners) corner = number[corner];
    return corners;
  });
  const auto gone = without(here, there), added = without(there, here);
  // 1. New ones in the places of those that are gone.
  const std::size_t swapped = std::min(gone.size(), added.size());
  for (std::size_t n = 0; n < swapped; ++n) delta.facets.push_back(at_place(gone[n].place, added[n]));
  // 2. The other new ones behind the last.
  for (std::size_t n = swapped; n < added.size(); ++n)
    delta.facets.push_back(at_place(static_cast<std::uint32_t>(facets_.size() + n - swapped), added[n]));
  // 3. Else the last ones in the places left empty. Each place behind the new end either is empty itself or gives its facet.
  std::size_t last = facets_.size(), end = gone.size();
  for (std::size_t n = swapped; n < end && gone[n].place < delta.total_facets; ++n) {
    for (--last; gone[end - 1].place == last; --last) --end;
    const auto place = static_cast<std::uint32_t>(last);
    delta.facets.push_back({gone[n].place, facets_[place], rgba_[place]});
  }
  return delta;
}

void NumberedSurface::apply(const SurfaceDelta& delta) {
  for (const SurfaceDelta::Vertex& vertex : delta.vertices) {
    rest_.push_back(vertex.rest);
    cell_.push_back(vertex.cell);
    is_rigid_ = is_rigid_ && vertex.cell < 0;
  }
  for (const FacetChange& change : delta.facets) {
    if (change.facet == facets_.size()) {
      facets_.emplace_back();
      rgba_.emplace_back();
    }
    facets_[change.facet] = change.corners;
    rgba_[change.facet] = change.rgba;
  }
  facets_.resize(delta.total_facets);
  rgba_.resize(delta.total_facets);
  hidden_ = delta.hidden;
}

}  // namespace palpate::physics
