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
constexpr double cell_over_L = 2;    // of a grid: few cells to look at, few masses in each
// Two masses that have not left their places by more than this, drift apart, do not meet: at rest those that are not joined
// are 1.4 L apart, L where an element broke, and 0.82 L from a facet that broke off.
constexpr double still_over_L = 0.1;
// Room for pairs, touched only where there are any. Tissue beaten into a heap lists some hundreds for each candidate.
constexpr std::size_t pairs_per_candidate = 96, pairs_per_candidate_of_few = 768,
                      few_pairs = std::size_t{1} << 22;

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
      first_(first_candidates(bodies)),
      seeks_other_(first_.back(), 0),
      seeks_own_(first_.back(), 0) {
  for (const auto& body : bodies) grids_.emplace_back(body.candidates().most());
  boxes_.resize(bodies.size());
  movers_.resize(bodies.size());
  smallest_L_ = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies) {
    smallest_L_ = std::min(smallest_L_, body.candidates().length());
    largest_L_ = std::max(largest_L_, body.candidates().length());
  }
  const std::size_t n = first_.back();
  const std::size_t room =
      std::max(pairs_per_candidate * n, std::min(few_pairs, pairs_per_candidate_of_few * n));
  if (kind != PairKind::facets) masses_.reserve(room);
  if (kind != PairKind::masses) facets_.reserve(room);
}

void NearPairs::allow(std::uint32_t a, std::uint32_t b, bool near) noexcept {
  std::uint8_t& now = allowed_[a * n_bodies_ + b];
  if ((now != 0) == near) return;
  now = allowed_[b * n_bodies_ + a] = near ? 1 : 0;
  fresh_ = false;
}

double most_motion(double dt, double speed) noexcept { return 5 * dt * speed; }

double NearPairs::skin(const Candidates& a, const Candidates& b) const noexcept {
  return std::max(0.5 * skin_over_L * (a.length() + b.length()), least_skin_);
}

bool NearPairs::is_valid(const std::vector<ContactBody>& bodies) const noexcept {
  if (!fresh_) return false;
  for (std::uint32_t a = 0; a < n_bodies_; ++a)
    for (std::uint32_t b = a; b < n_bodies_; ++b) {
      if (!is_allowed(a, b)) continue;
      const double apart = (bodies[a].drift() - bodies[b].drift()).norm();
      if (!(apart + bodies[a].stray() + bodies[b].stray() <
            skin(bodies[a].candidates(), bodies[b].candidates())))
        return false;
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
  const double needed = most_motion(dt, speed);
  if (!changed && needed <= std::max(least_skin_, skin_over_L * smallest_L_) && is_valid(bodies)) return;
  least_skin_ = needed;
  for (auto& body : bodies) body.mark();
  rebuild(bodies);
  fresh_ = true;
  ++rebuilds_;
}

void NearPairs::rebuild(const std::vector<ContactBody>& bodies) noexcept {
  masses_.clear();
  facets_.clear();
  for (std::uint32_t b = 0; b < n_bodies_; ++b)
    grids_[b].clear(cell_over_L * bodies[b].candidates().length());
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
  for (std::uint32_t b = 0; b < n_bodies_; ++b) boxes_[b] = bodies[b].box();
  // As far as any pair is listed at: the facets that are stretched most feel farthest.
  const Vec3 reach = Vec3::Constant((most_felt_stretch + 1) * largest_L_ / (2 * std::numbers::sqrt3) +
                                    std::max(skin_over_L * largest_L_, least_skin_));
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
    movers_[b].setEmpty();
    for (std::size_t n = 0; n < c.size(); ++n) {
      seeks_own_[first + n] = own && (c.x()[n] - c.rest()[n] - drift).squaredNorm() > still * still ? 1 : 0;
      seeks_other_[first + n] = 0;
      if (seeks_own_[first + n] != 0) movers_[b].extend(c.x()[n]);
    }
    for (std::uint32_t other = 0; other < n_bodies_; ++other) {
      if (other == b || !is_allowed(b, other)) continue;
      Eigen::AlignedBox3d box = boxes_[other];
      box.min() -= reach, box.max() += reach;
      for (std::size_t n = 0; n < c.size(); ++n)
        if (box.contains(c.x()[n])) seeks_other_[first + n] = 1;
    }
    for (std::size_t n = 0; n < c.size(); ++n)
      if (own || seeks_other_[first + n] != 0) grids_[b].insert(static_cast<std::uint32_t>(n), c.x()[n]);
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
  for (std::uint32_t b = 0; b < n_bodies_; ++b) {
    const Candidates& c = bodies[b].candidates();
    for (std::uint32_t other = b; other < n_bodies_; ++other) {
      if (!is_allowed(b, other)) continue;
      const bool same = other == b;
      const Candidates& d = bodies[other].candidates();
      const double within = paper_distance(c, d) + skin(c, d);
      const auto& seeks = same ? seeks_own_ : seeks_other_;
      for (std::uint32_t n = 0; n < c.size(); ++n) {
        if (seeks[first_[b] + n] == 0) continue;
        const Vec3& p = c.x()[n];
        const Vec3 reach = Vec3::Constant(within);
        grids_[other].visit_box(p - reach, p + reach, [&](std::uint32_t m) {
          // Of two that seek each other the first finds the second.
          if (same && (m == n || (m < n && seeks[first_[b] + m] != 0))) return;
          if ((d.x()[m] - p).squaredNorm() > within * within) return;
          if (same && c.are_joined(n, m)) return;
          add(masses_, {b, same ? std::min(n, m) : n}, {other, same ? std::max(n, m) : m});
        });
      }
    }
  }
}

void NearPairs::seek_facets(const std::vector<ContactBody>& bodies) noexcept {
  for (std::uint32_t b = 0; b < n_bodies_; ++b)
    for (std::uint32_t other = 0; other < n_bodies_; ++other) {
      if (!is_allowed(b, other)) continue;
      const auto n_facets = static_cast<std::uint32_t>(bodies[b].facets()->all().size());
      for (std::uint32_t f = 0; f < n_facets; ++f) seek_masses_near(bodies, {b, f}, other);
    }
}

void NearPairs::seek_masses_near(const std::vector<ContactBody>& bodies, PairEnd facet,
                                 std::uint32_t other) noexcept {
  const std::uint32_t b = facet.body;
  const bool same = other == b;
  const Candidates& c = bodies[b].candidates();
  const Candidates& d = bodies[other].candidates();
  const Facets::Corners& k = bodies[b].facets()->all()[facet.n];
  const FacetNow now = facet_now(c, k);
  const double within = swept_distance(now.edge, d) + skin(c, d);
  const Vec3 reach = Vec3::Constant(within);
  const Eigen::AlignedBox3d box(now.corner[0].cwiseMin(now.corner[1]).cwiseMin(now.corner[2]) - reach,
                                now.corner[0].cwiseMax(now.corner[1]).cwiseMax(now.corner[2]) + reach);
  // A facet whose corners are all far away may still reach over what is near: stretched tissue round a small tool.
  const bool seeks = same && std::any_of(k.begin(), k.end(), [&](std::uint32_t corner) {
                       return seeks_own_[first_[b] + corner] != 0;
                     });
  if (!seeks && !(same ? movers_[b] : boxes_[other]).intersects(box)) return;
  const bool loose = k[0] == k[1];
  grids_[other].visit_box(box.min(), box.max(), [&](std::uint32_t m) {
    if (same && !seeks && seeks_own_[first_[b] + m] == 0) return;
    const Vec3& p = d.x()[m];
    if (!box.contains(p)) return;
    if (same && (m == k[0] || m == k[1] || m == k[2])) return;
    // A loose mass that meets a facet is found by that facet; two loose ones find each other once.
    if (loose && (!bodies[other].facets()->is_loose(m) || first_[other] + m > first_[b] + k[0])) return;
    if (closest_point(p, now.corner).distance > within) return;
    if (same && (c.are_joined(m, k[0]) || c.are_joined(m, k[1]) || c.are_joined(m, k[2]))) return;
    add(facets_, {other, m}, facet);
  });
}

}  // namespace palpate::physics
