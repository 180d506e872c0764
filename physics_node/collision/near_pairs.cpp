#include "physics_node/collision/near_pairs.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr double skin_over_L = 0.4;
// Room for pairs, touched only where there are any. Tissue beaten into a heap lists some hundreds for each candidate.
constexpr std::size_t pairs_per_candidate = 96, pairs_per_candidate_of_few = 768,
                      few_pairs = std::size_t{1} << 22;
// For how many steps more than one a fast mass is given its way. Of steps that are solved, in which all are
// as fast as the fastest, for less: there are few, and their lists are long.
constexpr double steps_ahead = 4, solved_steps_ahead = 0.5;

/// By which a mass may have come nearer to a facet since changes were forgotten [m]
double travelled(const std::vector<ContactBody>& bodies, const Link& link) noexcept {
  const ContactBody &a = bodies[link.a], &b = bodies[link.b];
  return travel_per_motion * (a.moved() + b.moved()) + (a.shifted() - b.shifted()).norm();
}

}  // namespace

NearPairs::NearPairs(const std::vector<ContactBody>& bodies, PairKind kind, bool solved)
    : n_bodies_(bodies.size()), kind_(kind), solved_(solved), search_(bodies) {
  for (std::uint32_t a = 0; a < n_bodies_; ++a)
    for (std::uint32_t b = a; b < n_bodies_; ++b) {
      const std::size_t of_a = bodies[a].candidates().most(), of_b = bodies[b].candidates().most();
      const std::size_t n = a == b ? of_a : of_a + of_b;
      const std::size_t room =
          std::max(pairs_per_candidate * n, std::min(few_pairs, pairs_per_candidate_of_few * n));
      Link link{a, b, false, false, MotionMark(of_a), MotionMark(a == b ? 0 : of_b), 0, 0, 0, 0,
                0, 0, {},    {}};
      if (kind != PairKind::facets) link.masses.make_room(room);
      if (kind != PairKind::masses) link.facets.make_room(room, n), most_facets_ += room;
      links_.push_back(std::move(link));
    }
}

void NearPairs::allow(std::uint32_t a, std::uint32_t b, bool near) noexcept {
  for (Link& link : links_) {
    if (link.a != a || link.b != b || link.near == near) continue;
    link.near = near;
    link.fresh = false;
    link.masses.clear(), link.facets.clear();
  }
}

double NearPairs::skin(const std::vector<ContactBody>& bodies, const Link& link) const noexcept {
  return 0.5 * skin_over_L * (bodies[link.a].candidates().length() + bodies[link.b].candidates().length());
}

void NearPairs::restart() noexcept {
  for (Link& link : links_) {
    link.near = link.fresh = false;
    link.closing = link.between = link.slack = link.unseen = link.travel = 0;
    link.masses.clear(), link.facets.clear();
  }
}

/// Masses that touch do so where the step begins; with facets what they do to each other within it counts, too.
bool NearPairs::needs_all(const std::vector<ContactBody>& bodies, double fastest, double dt) noexcept {
  bool any = false;
  // Any two may have moved as the fastest, and one that it hits may leave at twice its speed.
  const double may_need = 2 * speed_gain * needed() * fastest * dt;
  for (Link& link : links_) {
    if (!link.near) continue;
    link.unseen += 2 * travel_per_motion * fastest * dt;
    any = any || !link.fresh || link.unseen + may_need >= link.slack || bodies[link.a].has_changed() ||
          bodies[link.b].has_changed();
  }
  return any;
}

/// Two bodies may drift together as they like: what counts is how they move against each other.
double NearPairs::measure_slack(const std::vector<ContactBody>& bodies, Link& link,
                                double dt) const noexcept {
  link.of_a.measure(bodies[link.a], needed(), dt, solved_);
  if (link.a == link.b) return skin(bodies, link) - 2 * link.of_a.excess();
  link.of_b.measure(bodies[link.b], needed(), dt, solved_);
  const double apart =
      (link.of_a.drift() - link.of_b.drift()).norm() + closing_gain() * dt * link.closing - link.between;
  return skin(bodies, link) - std::max(0.0, apart) - link.of_a.excess() - link.of_b.excess();
}

bool NearPairs::hold(const std::vector<ContactBody>& bodies, PairEnd at, double speed,
                     double dt) const noexcept {
  return std::ranges::all_of(links_, [&](const Link& link) {
    if (!link.near || (link.a != at.body && link.b != at.body)) return true;
    // The other one of a pair may need as much.
    const MotionMark& of = link.a == at.body ? link.of_a : link.of_b;
    return of.excess_of(bodies[at.body], at.n, dt * speed) <= of.excess() + 0.5 * link.slack;
  });
}

bool NearPairs::widen(std::vector<ContactBody>& bodies, std::span<const std::span<const double>> speeds,
                      double dt) noexcept {
  if (!all_read_) return false;
  for (Link& link : links_)
    if (link.near) rebuild(bodies, link, dt, speeds);
  list_all_ends(bodies);
  return true;
}

void NearPairs::update(std::vector<ContactBody>& bodies, double dt) noexcept {
  all_read_ = true;
  bool any = false;
  for (Link& link : links_) {
    if (!link.near) continue;
    link.travel += travelled(bodies, link);
    link.closing = (bodies[link.a].common_velocity() - bodies[link.b].common_velocity()).norm();
    link.unseen = 0;
    const bool changed = bodies[link.a].has_changed() || bodies[link.b].has_changed();
    if (link.fresh && !changed) {
      link.slack = measure_slack(bodies, link, dt);
      if (link.slack > 0) continue;
    }
    // Why: what breaks in one step breaks in the next, too.
    link.steps_ahead = changed ? 0 : solved_ ? solved_steps_ahead : steps_ahead;
    rebuild(bodies, link, dt, {});
    any = true;
  }
  for (auto& body : bodies) body.forget_changes();
  if (any) list_all_ends(bodies);
}

void NearPairs::follow(std::vector<ContactBody>& bodies) noexcept {
  all_read_ = false;
  for (Link& link : links_)
    if (link.near) link.travel += travelled(bodies, link);
  for (auto& body : bodies) body.forget_changes();
}

void NearPairs::list_all_ends(std::vector<ContactBody>& bodies) const noexcept {
  for (auto& body : bodies) body.clear_listed();
  for (const Link& link : links_) {
    for (const NearPair& pair : link.masses.pairs()) {
      bodies[pair.mass.body].list(pair.mass.n);
      bodies[pair.other.body].list(pair.other.n);
    }
    for (const NearPair& pair : link.facets.pairs()) {
      bodies[pair.mass.body].list(pair.mass.n);
      ContactBody& other = bodies[pair.other.body];
      for (const std::uint32_t corner : other.facets()->all()[pair.other.n]) other.list(corner);
    }
  }
}

void NearPairs::rebuild(const std::vector<ContactBody>& bodies, Link& link, double dt,
                        std::span<const std::span<const double>> expected) noexcept {
  const double given = kind_ == PairKind::masses ? 0 : needed() + travel_per_motion * link.steps_ahead;
  const auto mark = [&](MotionMark& of, std::uint32_t b) {
    of.mark(bodies[b], given, dt, solved_, expected.empty() ? std::span<const double>() : expected[b]);
  };
  mark(link.of_a, link.a);
  if (link.a != link.b) mark(link.of_b, link.b);
  link.between = kind_ == PairKind::masses ? 0 : (closing_gain() + link.steps_ahead) * dt * link.closing;
  link.slack = skin(bodies, link);
  const ListReach reach{link.slack, link.between, link.of_a.extra(),
                        link.a == link.b ? link.of_a.extra() : link.of_b.extra()};
  if (kind_ != PairKind::facets) search_.find_masses(bodies, link.a, link.b, reach, link.masses);
  if (kind_ != PairKind::masses) search_.find_facets(bodies, link.a, link.b, reach, link.facets);
  link.travel = 0;
  link.fresh = true;
  ++rebuilds_;
}

std::size_t NearPairs::most_pairs() const noexcept {
  std::size_t n = 0;
  for (const Link& link : links_) n += link.masses.pairs().capacity() + link.facets.pairs().capacity();
  return n;
}

std::size_t NearPairs::size() const noexcept {
  std::size_t n = 0;
  for (const Link& link : links_) n += link.masses.pairs().size() + link.facets.pairs().size();
  return n;
}

std::int64_t NearPairs::overflows() const noexcept {
  std::int64_t n = 0;
  for (const Link& link : links_) n += link.masses.overflows() + link.facets.overflows();
  return n;
}

}  // namespace palpate::physics
