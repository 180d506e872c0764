#include "physics_node/collision/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "physics_node/collision/facet_now.h"

namespace palpate::physics {
namespace {

constexpr double skin_over_L = 0.4;  // at least; more where one step moves masses by as much
// Two masses that have not left their places by more than this, drift apart, do not meet: at rest those that are not joined
// are 1.4 L apart, L where an element broke, and 0.82 L from a facet that broke off.
constexpr double still_over_L = 0.1;
constexpr std::size_t pairs_per_candidate = 24;  // room; a compressed heap of loose masses has fewer

std::size_t count_all(const std::vector<ContactBody>& bodies) {
  std::size_t n = 0;
  for (const auto& body : bodies) n += body.candidates().most();
  return n;
}

}  // namespace

double paper_distance(const Candidates& a, const Candidates& b) noexcept {
  return std::max(a.length(), b.length()) / std::numbers::sqrt3;
}

double swept_distance(double edge, const Candidates& of_mass) noexcept {
  return (edge + of_mass.length()) / (2 * std::numbers::sqrt3);
}

NearPairs::NearPairs(const std::vector<ContactBody>& bodies, PairKind kind)
    : n_bodies_(static_cast<std::uint32_t>(bodies.size())),
      kind_(kind),
      allowed_(bodies.size() * bodies.size(), 0),
      seeks_other_(count_all(bodies), 0),
      seeks_own_(count_all(bodies), 0),
      grid_(count_all(bodies)) {
  first_.push_back(0);
  smallest_L_ = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies) {
    first_.push_back(first_.back() + static_cast<std::uint32_t>(body.candidates().most()));
    smallest_L_ = std::min(smallest_L_, body.candidates().length());
    largest_L_ = std::max(largest_L_, body.candidates().length());
  }
  const std::size_t room = pairs_per_candidate * count_all(bodies);
  if (kind != PairKind::facets) masses_.reserve(room);
  if (kind != PairKind::masses) facets_.reserve(room);
}

void NearPairs::allow(std::uint32_t a, std::uint32_t b, bool near) noexcept {
  std::uint8_t& now = allowed_[a * n_bodies_ + b];
  if ((now != 0) == near) return;
  now = allowed_[b * n_bodies_ + a] = near ? 1 : 0;
  fresh_ = false;
}

bool NearPairs::any_allowed() const noexcept {
  return std::any_of(allowed_.begin(), allowed_.end(), [](auto a) { return a != 0; });
}

PairEnd NearPairs::place_of(std::uint32_t id) const noexcept {
  const auto after = std::upper_bound(first_.begin(), first_.end(), id);
  const auto body = static_cast<std::uint32_t>(after - first_.begin()) - 1;
  return {body, id - first_[body]};
}

bool NearPairs::is_valid(const std::vector<ContactBody>& bodies) const noexcept {
  if (!fresh_) return false;
  for (std::uint32_t a = 0; a < n_bodies_; ++a)
    for (std::uint32_t b = a; b < n_bodies_; ++b) {
      if (!is_allowed(a, b)) continue;
      const double apart = (bodies[a].drift() - bodies[b].drift()).norm();
      if (!(apart + bodies[a].stray() + bodies[b].stray() < skin_)) return false;
    }
  return true;
}

void NearPairs::update(std::vector<ContactBody>& bodies, bool changed, double dt) noexcept {
  double speed = 0;
  for (auto& body : bodies) {
    body.measure_motion();
    speed = std::max(speed, body.speed());
  }
  // What two masses may have done to each other within this step must be in the list.
  const double needed = 2.4 * dt * speed;
  if (!changed && needed <= skin_ && is_valid(bodies)) return;
  skin_ = std::max(skin_over_L * smallest_L_, needed);
  reach_ = largest_L_ / std::numbers::sqrt3 + skin_;
  for (auto& body : bodies) body.mark();
  rebuild(bodies);
  fresh_ = true;
  ++rebuilds_;
}

void NearPairs::rebuild(const std::vector<ContactBody>& bodies) noexcept {
  masses_.clear();
  facets_.clear();
  grid_.clear(reach_);
  choose_seekers(bodies);
  if (kind_ != PairKind::facets) seek_masses(bodies);
  if (kind_ != PairKind::masses) seek_facets(bodies);
  for (auto* list : {&masses_, &facets_})
    std::sort(list->begin(), list->end(), [](const NearPair& p, const NearPair& q) {
      return std::tie(p.mass.body, p.mass.n, p.other.body, p.other.n) <
             std::tie(q.mass.body, q.mass.n, q.other.body, q.other.n);
    });
}

void NearPairs::choose_seekers(const std::vector<ContactBody>& bodies) noexcept {
  for (std::uint32_t b = 0; b < n_bodies_; ++b) {
    const Candidates& c = bodies[b].candidates();
    const std::uint32_t first = first_[b];
    const bool own = is_allowed(b, b);
    Vec3 drift = Vec3::Zero();
    if (own) {
      for (std::size_t n = 0; n < c.size(); ++n) drift += c.x()[n] - c.rest()[n];
      drift /= static_cast<double>(c.size());
    }
    const double still = still_over_L * c.length();
    for (std::size_t n = 0; n < c.size(); ++n) {
      seeks_own_[first + n] = own && (c.x()[n] - c.rest()[n] - drift).squaredNorm() > still * still ? 1 : 0;
      seeks_other_[first + n] = 0;
    }
    for (std::uint32_t other = 0; other < n_bodies_; ++other) {
      if (other == b || !is_allowed(b, other)) continue;
      ContactBody::Box box = bodies[other].box();
      const Vec3 reach = Vec3::Constant(2 * reach_);
      box.lo -= reach, box.hi += reach;
      for (std::size_t n = 0; n < c.size(); ++n)
        if ((c.x()[n].array() >= box.lo.array()).all() && (c.x()[n].array() <= box.hi.array()).all())
          seeks_other_[first + n] = 1;
    }
    for (std::size_t n = 0; n < c.size(); ++n)
      if (own || seeks_other_[first + n] != 0) grid_.insert(first + static_cast<std::uint32_t>(n), c.x()[n]);
  }
}

void NearPairs::add(std::vector<NearPair>& list, PairEnd mass, PairEnd other) noexcept {
  if (list.size() == list.capacity()) {
    ++overflows_;
    return;
  }
  list.push_back({mass, other});
}

void NearPairs::seek_masses(const std::vector<ContactBody>& bodies) noexcept {
  const Vec3 reach = Vec3::Constant(reach_);
  for (std::uint32_t b = 0; b < n_bodies_; ++b) {
    const Candidates& c = bodies[b].candidates();
    for (std::uint32_t n = 0; n < c.size(); ++n) {
      const std::uint32_t id = first_[b] + n;
      if ((seeks_own_[id] | seeks_other_[id]) == 0) continue;
      const Vec3& p = c.x()[n];
      grid_.visit_box(p - reach, p + reach, [&](std::uint32_t other_id) {
        const PairEnd q = place_of(other_id);
        const bool same = q.body == b;
        const bool both = same ? seeks_own_[other_id] != 0 : seeks_other_[other_id] != 0;
        if (other_id == id || (both && other_id < id) || !is_allowed(b, q.body)) return;
        if (same ? seeks_own_[id] == 0 : seeks_other_[id] == 0) return;
        const Candidates& d = bodies[q.body].candidates();
        const double within = paper_distance(c, d) + skin_;
        if ((d.x()[q.n] - p).squaredNorm() > within * within) return;
        if (same && c.are_joined(n, q.n)) return;
        if (id < other_id) {
          add(masses_, {b, n}, q);
        } else {
          add(masses_, q, {b, n});
        }
      });
    }
  }
}

void NearPairs::seek_facets(const std::vector<ContactBody>& bodies) noexcept {
  for (std::uint32_t b = 0; b < n_bodies_; ++b) {
    const Candidates& c = bodies[b].candidates();
    const Facets& facets = *bodies[b].facets();
    const std::uint32_t first = first_[b];
    for (std::uint32_t f = 0; f < facets.all().size(); ++f) {
      const Facets::Corners& k = facets.all()[f];
      const bool own = (seeks_own_[first + k[0]] | seeks_own_[first + k[1]] | seeks_own_[first + k[2]]) != 0;
      const bool others = (seeks_other_[first + k[0]] | seeks_other_[first + k[1]] | seeks_other_[first + k[2]]) != 0;
      const bool touches_itself = is_allowed(b, b);
      if (!touches_itself && !others) continue;
      const FacetNow facet = facet_now(c, k);
      const Vec3 reach = Vec3::Constant(swept_distance(facet.edge, c) + reach_);
      const Vec3 lo = facet.corner[0].cwiseMin(facet.corner[1]).cwiseMin(facet.corner[2]) - reach;
      const Vec3 hi = facet.corner[0].cwiseMax(facet.corner[1]).cwiseMax(facet.corner[2]) + reach;
      const bool loose = k[0] == k[1];
      grid_.visit_box(lo, hi, [&](std::uint32_t id) {
        const PairEnd p = place_of(id);
        const bool same = p.body == b;
        if (!is_allowed(b, p.body)) return;
        if (same ? !own && seeks_own_[id] == 0 : !others || seeks_other_[id] == 0) return;
        if (same && (p.n == k[0] || p.n == k[1] || p.n == k[2])) return;
        // A loose mass that meets a facet is found by that facet; two loose ones find each other once.
        if (loose && (!bodies[p.body].facets()->is_loose(p.n) || id > first + k[0])) return;
        const Candidates& d = bodies[p.body].candidates();
        const double within = swept_distance(facet.edge, d) + skin_;
        if (closest_point(d.x()[p.n], facet.corner).distance > within) return;
        if (same && (c.are_joined(p.n, k[0]) || c.are_joined(p.n, k[1]) || c.are_joined(p.n, k[2]))) return;
        add(facets_, p, {b, f});
      });
    }
  }
}

}  // namespace palpate::physics
