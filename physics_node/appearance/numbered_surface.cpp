#include "physics_node/appearance/numbered_surface.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace palpate::physics {
namespace {

constexpr Index scenery = -1;

/// What a vertex is known by: its mass and where it rests, as its maker computes it each time.
struct Key {
  Index cell;
  Vec3 rest;
  bool operator==(const Key&) const = default;
};
struct KeyHash {
  std::size_t operator()(const Key& key) const noexcept {
    auto hash = static_cast<std::size_t>(key.cell);
    for (const double x : key.rest) hash = 31 * hash + std::hash<double>()(x);
    return hash;
  }
};

/// A facet by which it is compared, and where it stands.
struct Placed {
  std::array<std::uint32_t, 5> facet;  // corners and colour
  std::uint32_t place;
};

Placed placed(const NumberedSurface::Corners& c, std::uint32_t rgba, std::size_t place) {
  return {{c[0], c[1], c[2], c[3], rgba}, static_cast<std::uint32_t>(place)};
}

/// Those of `a` that `b` has not as often, in the order of their places.
std::vector<Placed> without(std::vector<Placed> a, std::vector<Placed> b) {
  const auto by_facet = [](const Placed& x, const Placed& y) { return x.facet < y.facet; };
  std::stable_sort(a.begin(), a.end(), by_facet);
  std::sort(b.begin(), b.end(), by_facet);
  std::vector<Placed> left;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(left), by_facet);
  std::sort(left.begin(), left.end(), [](const Placed& x, const Placed& y) { return x.place < y.place; });
  return left;
}

/// What is left of two lists of facets when equal ones have been struck out in pairs, as far as they come in the same order.
struct Unpaired {
  std::vector<Placed> here, there;
};
template <class Here, class There>
Unpaired strike_out_pairs(std::size_t n_here, const Here& here, std::size_t n_there, const There& there) {
  constexpr std::size_t reach = 32;  // Why: more than what a break takes away beside one another
  Unpaired left;
  std::size_t first = 0;  // of those here that are still to be found
  for (std::size_t t = 0; t < n_there; ++t) {
    const Placed wanted = there(t);
    const std::size_t end = std::min(first + reach, n_here);
    std::size_t found = first;
    while (found < end && here(found).facet != wanted.facet) ++found;
    if (found == end) {
      left.there.push_back(wanted);
      continue;
    }
    for (; first < found; ++first) left.here.push_back(here(first));
    ++first;
  }
  for (; first < n_here; ++first) left.here.push_back(here(first));
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
      bearers_(std::move(surface.bearers)),
      facets_(std::move(surface.facets)),
      rgba_(std::move(surface.rgba)),
      hidden_(surface.hidden),
      n_leading_(cell_.size()),
      n_first_(rest_.size()),
      is_rigid_(cell_.empty()) {
  cell_.resize(rest_.size(), scenery);
  if (!bearers_.empty()) bearers_.resize(rest_.size());
}

bool NumberedSurface::rests(std::size_t first, std::size_t last, const AwakeParts& parts) const {
  for (std::size_t n = first; n < last; ++n) {
    if (cell_[n] < 0) continue;
    if (bearers_.empty() ? !parts.rests(cell_[n])
                         : !bearers_[n].all([&](Index node) { return parts.rests(node); }))
      return false;
  }
  return true;
}

/// @return number here of each vertex of `next`. Most come in the order of their numbers; what is looked for elsewhere is found by its
/// mass and where it rests.
std::vector<std::uint32_t> NumberedSurface::numbers_of(const Surface& next, SurfaceDelta& delta) const {
  std::unordered_map<Key, std::uint32_t, KeyHash> known;
  const auto number_of = [&](const SurfaceDelta::Vertex& vertex) {
    if (known.empty())
      for (std::size_t v = 0; v < rest_.size(); ++v)
        known.emplace(Key{cell_[v], rest_[v]}, static_cast<std::uint32_t>(v));
    const auto free = static_cast<std::uint32_t>(rest_.size() + delta.vertices.size());
    const auto [at, is_new] = known.try_emplace(Key{vertex.cell, vertex.rest}, free);
    if (is_new) delta.vertices.push_back(vertex);
    return at->second;
  };
  std::vector<std::uint32_t> numbers(next.n_vertices());
  std::uint32_t follower = 0;  // number after that of the vertex before
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    const bool moves = v < next.n_moving();
    const Bearers by = moves && !next.bearers.empty() ? next.bearers[v] : Bearers{};
    const SurfaceDelta::Vertex vertex{next.rest[v], moves ? next.cell[v] : scenery, by};
    const bool follows =
        follower < rest_.size() && cell_[follower] == vertex.cell && rest_[follower] == vertex.rest;
    numbers[v] = follows ? follower : number_of(vertex);
    if (numbers[v] >= rest_.size()) continue;
    follower = numbers[v] + 1;
    if (!bearers_.empty() && !(bearers_[numbers[v]] == by)) delta.carried.push_back({numbers[v], by});
  }
  return numbers;
}

SurfaceDelta NumberedSurface::delta_to(const Surface& next) const {
  SurfaceDelta delta;
  delta.total_facets = next.facets.size();
  delta.hidden = next.hidden;
  const auto number = numbers_of(next, delta);
  const Unpaired left = strike_out_pairs(
      facets_.size(), [this](std::size_t f) { return placed(facets_[f], rgba_[f], f); }, next.facets.size(),
      [&](std::size_t f) {
        Corners corners = next.facets[f];
        for (std::uint32_t& corner : corners) corner = number[corner];
        return placed(corners, next.rgba[f], f);
      });
  const auto gone = without(left.here, left.there), added = without(left.there, left.here);
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
    if (!bearers_.empty()) bearers_.push_back(vertex.bearers);
    is_rigid_ = is_rigid_ && vertex.cell < 0;
  }
  for (const SurfaceDelta::Carried& carried : delta.carried) bearers_[carried.vertex] = carried.bearers;
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
