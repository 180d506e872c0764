// How a boundary follows breaks.

#include <algorithm>

#include "physics_node/boundary/boundary.h"

namespace palpate::physics {

void Boundary::follow() noexcept {
  if (!sites_) return;
  const TopologyEvents events = body_.events();
  if (events.overflow) return restart();
  for (const EdgeGone& gone : events.edges_gone) mark(gone.a), mark(gone.b);
  for (const CellGone& gone : events.cells_gone)
    for (const Index corner : gone.corners) mark(corner);
  for (const NodeSplit& split : events.nodes_split) mark(split.node);
}

/// As loaded, and every mass that lacks an element is looked at anew.
void Boundary::restart() noexcept {
  std::fill(gone_.begin(), gone_.end(), std::uint8_t{0});
  std::fill(first_.begin(), first_.end(), none);
  std::fill(waits_.begin(), waits_.end(), std::uint8_t{0});
  for (std::size_t n = 0; n < n_used_; ++n) open_[n] = {};
  queue_begin_ = n_queued_ = n_used_ = n_open_ = 0;
  free_ = none;
  if (skin_) skin_->restart();
  changed_all_ = ++revision_;
  if (body_.breaks() == 0) return;
  for (const Index node : body_.body().nodes())
    if (body_.adjacency().has_lost(node)) mark(node);
}

void Boundary::mark(Index mass) noexcept {
  std::array<std::uint32_t, SiteFacets::most_around> sites;
  const std::size_t n = sites_->around(mass, sites);
  for (std::size_t i = 0; i < n; ++i) {
    if (waits_[sites[i]] != 0) continue;
    waits_[sites[i]] = 1;
    queue_[(queue_begin_ + n_queued_++) % queue_.size()] = sites[i];
  }
  changes_[n_changes_++ % changes_.size()] = {mass, revision_ + 1};
}

/// Facets have the numbers of the loaded ones for as long as they are the same, so that who kept them need not look again.
void Boundary::update() noexcept {
  if (!sites_ || n_queued_ == 0) return;
  const std::size_t n = std::min(n_queued_, most_sites_a_frame);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t site = queue_[queue_begin_];
    queue_begin_ = (queue_begin_ + 1) % queue_.size();
    waits_[site] = 0;
    renew(site);
  }
  n_queued_ -= n;
  ++revision_;
  if (n_queued_ > 0) changed_all_ = revision_ + 1;  // where the rest is, is no longer known
}

bool Boundary::changed_near(const Vec3& p, double radius, std::uint64_t revision,
                            const NodeMotion& moving) const noexcept {
  if (revision == revision_) return false;
  if (changed_all_ > revision) return true;
  std::uint64_t n = n_changes_;
  const std::uint64_t oldest = n_changes_ > changes_.size() ? n_changes_ - changes_.size() : 0;
  while (n > oldest && changes_[(n - 1) % changes_.size()].revision > revision) {
    --n;
    if ((moving.position(changes_[n % changes_.size()].mass) - p).squaredNorm() <= radius * radius)
      return true;
  }
  return n == oldest && oldest > 0;
}

void Boundary::renew(std::uint32_t site) noexcept {
  std::array<SiteFacets::Corners, SiteFacets::most_facets> room;
  const std::size_t n = sites_->facets_of(site, room);
  const std::span<const SiteFacets::Corners> now(room.data(), n);
  if (skin_) skin_->look_at(body_.body().cells->cell_of(site));
  close_all(site);
  const auto [begin, end] = std::equal_range(surface_.site.begin(), surface_.site.end(), site);
  const auto first = static_cast<std::size_t>(begin - surface_.site.begin());
  const auto last = static_cast<std::size_t>(end - surface_.site.begin());
  const bool rigid = sites_->is_rigid(site);
  const bool same = !rigid && is_as_loaded(first, last, now);
  if (!rigid)
    std::fill(gone_.begin() + std::ptrdiff_t(first), gone_.begin() + std::ptrdiff_t(last), same ? 0 : 1);
  if (same) return;
  for (const auto& masses : now) open(site, masses);
}

/// A skin names corners from another first one on.
bool Boundary::is_facet(std::uint32_t facet, const SiteFacets::Corners& masses) const noexcept {
  for (std::size_t first = 0; first < (surface_.bearers.empty() ? 1u : 4u); ++first) {
    bool same = true;
    for (std::size_t c = 0; c < 4; ++c) same = same && mass(facet, (first + c) % 4) == masses[c];
    if (same) return true;
  }
  return false;
}

bool Boundary::is_as_loaded(std::size_t first, std::size_t last,
                            std::span<const SiteFacets::Corners> now) const noexcept {
  if (last - first != now.size()) return false;
  const auto is_lip = [this](Index mass) {
    return skin_->lip(mass) != nullptr;
  };  // it has moved from where it was
  for (const SiteFacets::Corners& masses : now)
    if (skin_ && std::ranges::any_of(masses, is_lip)) return false;
  for (std::size_t n = 0; n < now.size(); ++n)
    if (!is_facet(static_cast<std::uint32_t>(first + n), now[n])) return false;
  return true;
}

void Boundary::close_all(std::uint32_t site) noexcept {
  for (std::uint32_t n = first_[site]; n != none;) {
    const std::uint32_t next = open_[n].next;
    open_[n] = {.next = free_};
    free_ = n;
    --n_open_;
    n = next;
  }
  first_[site] = none;
}

void Boundary::open(std::uint32_t site, const SiteFacets::Corners& masses) noexcept {
  std::uint32_t at = free_;
  if (at != none) {
    free_ = open_[at].next;
  } else if (n_used_ < open_.size()) {
    at = static_cast<std::uint32_t>(n_used_++);
  } else {
    ++left_out_;
    return;
  }
  open_[at] = {.masses = masses, .across = sites_->across(site, masses), .next = first_[site], .open = true};
  first_[site] = at;
  ++n_open_;
}

}  // namespace palpate::physics
