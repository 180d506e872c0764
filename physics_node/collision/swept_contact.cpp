#include "physics_node/collision/swept_contact.h"

#include <algorithm>
#include <cmath>

#include "physics_node/collision/facet_now.h"
#include "physics_node/collision/shadowed.h"
#include "physics_node/step/rebound.h"

namespace palpate::physics {
namespace {

constexpr int most_sweeps = 8;
// Why: each finds what masses reach that are twice as fast as in the one before; bodies that lie in each other at the start can throw each
// other out faster and faster, and a step must end.
constexpr int most_searches = 8;
constexpr int most_rounds = 32;  // of zones; each joins at least one more mass

/// The four where the step began, and what they move by with the impulses so far.
struct Path {
  Vec3 p, dp;
  Triangle t, dt;
};

/// How near a mass may come in one step: a tenth of what it was; not nearer at all where hardly anything is left.
double least_distance(double distance, double h) {
  return std::max(0.1 * distance, std::min(0.99 * distance, 0.02 * h));
}

}  // namespace

SweptContact::SweptContact(const std::vector<ContactBody>& bodies, std::size_t most_pairs)
    : first_(first_candidates(bodies)), speed_(first_.back(), 0.0) {
  const std::uint32_t n = first_.back();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    speeds_.emplace_back(speed_.data() + first_[b], first_[b + 1] - first_[b]);
  parent_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) parent_[i] = i;
  in_zone_.assign(n, 0);
  zoned_.reserve(n);
  sums_.resize(n);
  active_.reserve(most_pairs / 2);  // memory is touched only where pairs are
}

void SweptContact::find_active(const std::vector<ContactBody>& bodies, std::span<Link> links,
                               double dt) noexcept {
  active_.clear();
  for (Link& link : links)
    for (NearPair& pair : link.facets.pairs()) look_at(bodies, pair, link.travel, link.closing, dt);
}

/// Twice what they have: what a heavy mass hits leaves at twice its speed.
void SweptContact::expect_speeds(const std::vector<ContactBody>& bodies) noexcept {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const std::uint32_t n : bodies[b].listed()) {
      double& speed = speed_[first_[b] + n];
      speed = std::max(speed, 2 * bodies[b].speed_of(n));
    }
}

/// What a fast one may hit may leave as fast: that is looked for at once where the lists tell, else when it
/// is hit (outran).
/// @return any may that was not expected to
bool SweptContact::expect_hits(const std::vector<ContactBody>& bodies, const NearPairs& near,
                               double dt) noexcept {
  bool any = false;
  for (const Active& a : active_) {
    double most = 0;
    for (const PairEnd& at : a.end) most = std::max(most, speed_[id_of(at)]);
    for (const PairEnd& at : a.end) {
      double& speed = speed_[id_of(at)];
      if (!(speed < most) || !near.hold(bodies, at, most, dt)) continue;
      any = true;
      speed = most;
    }
  }
  return any;
}

void SweptContact::forget_speeds(const std::vector<ContactBody>& bodies) noexcept {
  if (widened_) std::fill(speed_.begin(), speed_.end(), 0.0);  // some may be in no list any more
  widened_ = false;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const std::uint32_t n : bodies[b].listed()) speed_[first_[b] + n] = 0;
}

/// Has an impulse made a mass faster than the pairs were looked for with? Then the pairs are there that it
/// may meet.
bool SweptContact::outran(std::vector<ContactBody>& bodies, NearPairs& near, const ContactImpulses& impulses,
                          double dt) noexcept {
  bool any = false, listed = true;
  impulses.for_each([&](PairEnd at, const Vec3&) {
    const double speed = (impulses.v_move(bodies, at) - bodies[at.body].common_velocity()).norm();
    double& expected = speed_[id_of(at)];
    if (!(speed > expected)) return;
    expected = 2 * speed;
    any = true;
    listed = listed && near.hold(bodies, at, expected, dt);
  });
  if (listed) return any;
  widened_ = true;
  if (!near.widen(bodies, speeds_, dt)) ++overflows_;
  expect_speeds(bodies);  // of those that are new in the lists
  return true;
}

double SweptContact::expected_of(PairEnd mass, PairEnd facet, const Facets::Corners& k) const noexcept {
  const std::uint32_t first = first_[facet.body];
  return speed_[id_of(mass)] + std::max({speed_[first + k[0]], speed_[first + k[1]], speed_[first + k[2]]});
}

void SweptContact::look_at(const std::vector<ContactBody>& bodies, NearPair& pair, double travel,
                           double closing, double dt) noexcept {
  const ContactBody& other = bodies[pair.other.body];
  const Facets::Corners& k = other.facets()->all()[pair.other.n];
  const double reach = dt * (closing + expected_of(pair.mass, pair.other, k));
  if (pair.look_at > travel + reach) return;
  const Candidates& c = bodies[pair.mass.body].candidates();
  const Candidates& d = other.candidates();
  const FacetNow facet = facet_now(d, k);
  const double h = swept_distance(facet.edge, c);
  const ClosestPoint nearest = closest_point(c.x()[pair.mass.n], facet.corner);
  pair.look_at = travel + (nearest.distance - h);
  if (nearest.distance > h + reach || nearest.distance == 0) return;
  if (active_.size() == active_.capacity()) {
    ++overflows_;
    return;
  }
  Active& a = active_.emplace_back();
  a.end = {pair.mass, PairEnd{pair.other.body, k[0]}, PairEnd{pair.other.body, k[1]},
           PairEnd{pair.other.body, k[2]}};
  a.weight = nearest.weight;
  a.distance = nearest.distance;
  a.n = nearest.away / nearest.distance;
  a.h = h;
  a.W = c.inverse_mass(pair.mass.n);
  if (k[0] == k[1]) {
    a.weight = {1, 0, 0};
    a.W += d.inverse_mass(k[0]);
    return;
  }
  for (int i = 0; i < 3; ++i)
    a.W += a.weight[i] * a.weight[i] * d.inverse_mass(k[static_cast<std::size_t>(i)]);
}

std::int64_t SweptContact::push_apart(const std::vector<ContactBody>& bodies, double e, double dt,
                                      ContactImpulses& impulses, double& lost) noexcept {
  std::int64_t collisions = 0;
  for (std::size_t q = 0; q < active_.size(); ++q) {
    const std::size_t n = backwards_ ? active_.size() - 1 - q : q;
    Active& a = active_[n];
    if (a.W == 0 || a.shadow == Shadow::in_it) continue;
    const auto closing = [&](auto&& velocity) {
      Vec3 v = velocity(a.end[0]);
      for (int i = 0; i < 3; ++i) v -= a.weight[i] * velocity(a.end[static_cast<std::size_t>(i) + 1]);
      return v.dot(a.n);
    };
    const double v_n = closing([&](PairEnd at) { return impulses.v(bodies, at); });
    if (v_n >= 0) continue;
    const double v_move_n = closing([&](PairEnd at) { return impulses.v_move(bodies, at); });
    if (a.distance + dt * v_move_n >= a.h) continue;
    if (a.shadow == Shadow::unknown) {  // asked only of those that would push
      a.shadow = is_shadowed(std::span<const Active>(active_), n) ? Shadow::in_it : Shadow::none;
      if (a.shadow == Shadow::in_it) continue;
    }
    const double J = rebound(e, v_n, v_move_n) / a.W;
    impulses.push(bodies, a.end[0], J * a.n);
    for (int i = 0; i < 3; ++i)
      if (a.weight[i] > 0)
        impulses.push(bodies, a.end[static_cast<std::size_t>(i) + 1], -a.weight[i] * J * a.n);
    lost -= J * v_n + 0.5 * J * J * a.W;
    ++collisions;
  }
  return collisions;
}

bool SweptContact::would_pass(const std::vector<ContactBody>& bodies, const Active& a, double dt,
                              const ContactImpulses& impulses) const noexcept {
  const auto start = [&](PairEnd at) { return bodies[at.body].candidates().x()[at.n]; };
  const auto moves = [&](PairEnd at) { return Vec3(dt * impulses.v_move(bodies, at)); };
  const Triangle t{start(a.end[1]), start(a.end[2]), start(a.end[3])};
  const Triangle by{moves(a.end[1]), moves(a.end[2]), moves(a.end[3])};
  return comes_nearer(start(a.end[0]), moves(a.end[0]), t, by, a.distance * a.n,
                      least_distance(a.distance, a.h));
}

std::uint32_t SweptContact::zone_of(std::uint32_t id) noexcept {
  while (parent_[id] != id) id = parent_[id] = parent_[parent_[id]];
  return id;
}

void SweptContact::join(const Active& a) noexcept {
  for (const PairEnd& at : a.end) {
    const std::uint32_t id = id_of(at);
    if (in_zone_[id] == 0) {
      in_zone_[id] = 1;
      zoned_.push_back(at);
    }
    const std::uint32_t one = zone_of(id_of(a.end[0])), other = zone_of(id);
    parent_[std::max(one, other)] = std::min(one, other);
  }
}

/// V = sum m v / sum m of the masses of a zone; that of a held or driven one where there is any.
void SweptContact::move_zones_together(const std::vector<ContactBody>& bodies,
                                       ContactImpulses& impulses) noexcept {
  for (const PairEnd& at : zoned_) sums_[id_of(at)] = Sum{};
  for (const PairEnd& at : zoned_) {
    Sum& sum = sums_[zone_of(id_of(at))];
    const double w = bodies[at.body].candidates().inverse_mass(at.n);
    if (w == 0) {
      sum.fixed = true;
      sum.velocity = impulses.v_move(bodies, at);
      continue;
    }
    sum.momentum += impulses.v_move(bodies, at) / w;
    sum.mass += 1 / w;
  }
  for (const PairEnd& at : zoned_) {
    Sum& sum = sums_[zone_of(id_of(at))];
    const Vec3 V = sum.fixed ? sum.velocity : Vec3(sum.momentum / sum.mass);
    sum.given += impulses.set_change(bodies, at, V - bodies[at.body].candidates().v_move()[at.n]);
  }
  // What a zone with a held or driven mass was given came from there.
  for (const PairEnd& at : zoned_) {
    Sum& sum = sums_[zone_of(id_of(at))];
    if (!sum.fixed || bodies[at.body].candidates().inverse_mass(at.n) != 0) continue;
    impulses.push(bodies, at, -sum.given);
    sum.given.setZero();
  }
}

SweptReport SweptContact::step(std::vector<ContactBody>& bodies, NearPairs& near, double e, double dt,
                               ContactImpulses& impulses) noexcept {
  SweptReport report;
  backwards_ = !backwards_;
  overflows_ = 0;
  expect_speeds(bodies);
  for (int search = 0;; ++search) {
    const std::size_t before = active_.size();
    find_active(bodies, near.links(), dt);
    if (search == 0 && expect_hits(bodies, near, dt)) find_active(bodies, near.links(), dt);
    if (search > 0 && active_.size() == before) break;  // nobody whom they had not met
    for (int n = 0; n < most_sweeps; ++n) {
      const std::int64_t collisions = push_apart(bodies, e, dt, impulses, report.lost);
      report.collisions += collisions;
      if (collisions == 0) break;
    }
    if (!outran(bodies, near, impulses, dt)) break;
    if (search + 1 < most_searches) continue;
    ++overflows_;
    break;
  }
  const auto any_zoned = [this](const Active& a) {
    return std::ranges::any_of(a.end, [this](PairEnd at) { return in_zone_[id_of(at)] != 0; });
  };
  for (int round = 0; round < most_rounds; ++round) {
    bool grown = false;
    for (Active& a : active_) {
      // Where none of its masses is in a zone, all move as they did in the round before.
      if (a.together || (round > 0 && !any_zoned(a))) continue;
      if (!would_pass(bodies, a, dt, impulses)) continue;
      a.together = true;  // moves together from now on
      join(a);
      grown = true;
    }
    if (!grown) break;
    const auto kinetic = [&] {
      double sum = 0;
      for (const PairEnd& at : zoned_) {
        const double w = bodies[at.body].candidates().inverse_mass(at.n);
        if (w > 0) sum += 0.5 / w * impulses.v(bodies, at).squaredNorm();
      }
      return sum;
    };
    const double before = kinetic() - impulses.driven_work();
    move_zones_together(bodies, impulses);
    if (outran(bodies, near, impulses, dt)) find_active(bodies, near.links(), dt);
    report.lost += before - (kinetic() - impulses.driven_work());  // what hands gave to it, too
  }
  report.overflows = overflows_;
  forget_speeds(bodies);
  report.stopped = static_cast<std::int64_t>(zoned_.size());
  for (const PairEnd& at : zoned_) {
    parent_[id_of(at)] = id_of(at);
    in_zone_[id_of(at)] = 0;
  }
  zoned_.clear();
  return report;
}

}  // namespace palpate::physics
