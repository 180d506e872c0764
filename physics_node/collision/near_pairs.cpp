#include "physics_node/collision/near_pairs.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr double skin_over_L = 0.4;  // at least; more where one step moves masses by as much
// Room for pairs, touched only where there are any. Tissue beaten into a heap lists some hundreds for each candidate.
constexpr std::size_t pairs_per_candidate = 96, pairs_per_candidate_of_few = 768,
                      few_pairs = std::size_t{1} << 22;
// A mass and a facet move towards each other, and the distance at which they touch grows with the edges: by 2 / (2 sqrt(3))
// of what the corners move.
constexpr double travel_per_motion = 1.6;

}  // namespace

double most_motion(double dt, double speed) noexcept { return 5 * dt * speed; }

NearPairs::NearPairs(const std::vector<ContactBody>& bodies, PairKind kind)
    : n_bodies_(bodies.size()), kind_(kind), search_(bodies) {
  for (std::uint32_t a = 0; a < n_bodies_; ++a)
    for (std::uint32_t b = a; b < n_bodies_; ++b) {
      const std::size_t of_a = bodies[a].candidates().most(), of_b = bodies[b].candidates().most();
      const std::size_t n = a == b ? of_a : of_a + of_b;
      const std::size_t room =
          std::max(pairs_per_candidate * n, std::min(few_pairs, pairs_per_candidate_of_few * n));
      Link link{a, b, false, false, MotionMark(of_a), MotionMark(a == b ? 0 : of_b), 0, 0, 0, 0, {}, {}};
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
  return std::max(
      0.5 * skin_over_L * (bodies[link.a].candidates().length() + bodies[link.b].candidates().length()),
      link.least_skin);
}

void NearPairs::restart() noexcept {
  for (Link& link : links_) {
    link.near = link.fresh = false;
    link.least_skin = link.slack = link.unseen = link.travel = 0;
    link.masses.clear(), link.facets.clear();
  }
}

/// Masses that touch do so where the step begins; with facets what they do to each other within it counts, too.
double NearPairs::needed_skin(double fastest, double dt) const noexcept {
  return kind_ == PairKind::masses ? 0 : most_motion(dt, fastest);
}

bool NearPairs::needs_all(const std::vector<ContactBody>& bodies, double fastest, double dt) noexcept {
  bool any = false;
  for (Link& link : links_) {
    if (!link.near) continue;
    link.unseen += 2 * fastest * dt;
    any = any || !link.fresh || link.unseen >= link.slack || bodies[link.a].has_changed() ||
          bodies[link.b].has_changed() || needed_skin(fastest, dt) > skin(bodies, link);
  }
  return any;
}

/// Two bodies may drift together as they like: what counts is how they move against each other.
double NearPairs::measure_slack(const std::vector<ContactBody>& bodies, Link& link) const noexcept {
  link.of_a.measure(bodies[link.a].candidates());
  if (link.a == link.b) return skin(bodies, link) - 2 * link.of_a.stray();
  link.of_b.measure(bodies[link.b].candidates());
  return skin(bodies, link) - (link.of_a.drift() - link.of_b.drift()).norm() - link.of_a.stray() -
         link.of_b.stray();
}

void NearPairs::update(std::vector<ContactBody>& bodies, double dt) noexcept {
  double speed = 0;
  for (const auto& body : bodies) speed = std::max(speed, body.speed());
  const double needed = needed_skin(speed, dt);
  bool any = false;
  for (Link& link : links_) {
    if (!link.near) continue;
    link.travel += travel_per_motion * (bodies[link.a].moved() + bodies[link.b].moved());
    link.unseen = 0;
    if (link.fresh && !bodies[link.a].has_changed() && !bodies[link.b].has_changed() &&
        needed <= skin(bodies, link)) {
      link.slack = measure_slack(bodies, link);
      if (link.slack > 0) continue;
    }
    link.least_skin = needed;
    rebuild(bodies, link);
    any = true;
  }
  for (auto& body : bodies) body.forget_changes();
  if (any) list_all_ends(bodies);
}

void NearPairs::follow(std::vector<ContactBody>& bodies) noexcept {
  for (Link& link : links_)
    if (link.near) link.travel += travel_per_motion * (bodies[link.a].moved() + bodies[link.b].moved());
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

void NearPairs::rebuild(const std::vector<ContactBody>& bodies, Link& link) noexcept {
  link.slack = skin(bodies, link);
  if (kind_ != PairKind::facets) search_.find_masses(bodies, link.a, link.b, link.slack, link.masses);
  if (kind_ != PairKind::masses) search_.find_facets(bodies, link.a, link.b, link.slack, link.facets);
  link.of_a.mark(bodies[link.a].candidates());
  if (link.a != link.b) link.of_b.mark(bodies[link.b].candidates());
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
