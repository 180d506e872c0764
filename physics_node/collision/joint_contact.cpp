#include "physics_node/collision/joint_contact.h"

#include <algorithm>
#include <cmath>

#include "physics_node/collision/facet_now.h"

namespace palpate::physics {
namespace {

constexpr int most_iterations = 40;
constexpr int sweeps_together = 8;
constexpr double precise = 1e-4;  // to which ends are where they should be [of L]
constexpr double farther = 0.25;  // pairs are looked for [of L]

/// Numbers of a body are less than 2^24, bodies fewer than 2^8.
std::uint64_t key_of(PairEnd mass, PairEnd other) noexcept {
  return (std::uint64_t{mass.body} << 56) | (std::uint64_t{mass.n & 0xffffff} << 32) |
         (std::uint64_t{other.body} << 24) | (other.n & 0xffffff);
}

}  // namespace

JointContact::JointContact(const std::vector<ContactBody>& bodies, std::size_t most_pairs)
    : first_(first_candidates(bodies)), forces_(bodies.size()) {
  rows_.reserve(most_pairs / 2);  // memory is touched only where pairs are
  last_.reserve(most_pairs / 2);
  dv_.assign(first_.back(), Vec3::Zero());
  double L = bodies.front().candidates().length();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    forces_[b].reserve(bodies[b].candidates().most());
    L = std::min(L, bodies[b].candidates().length());
  }
  near_enough_ = precise * L;
}

void JointContact::add(Row row, double distance, double h, double reach) noexcept {
  if (distance == 0 || distance > h + reach || row.W == 0) return;
  if (rows_.size() == rows_.capacity()) {
    ++overflows_;
    return;
  }
  row.gap = distance - h;
  row.least = std::min(0.0, row.gap);
  const auto same = std::lower_bound(last_.begin(), last_.end(), row.key,
                                     [](const Remembered& one, std::uint64_t key) { return one.key < key; });
  if (same != last_.end() && same->key == row.key) {
    row.l = same->l;
    row.least = std::max(row.least, same->least);  // Why: what errors of solving take may not add up
  }
  rows_.push_back(row);
}

void JointContact::find(const std::vector<ContactBody>& bodies, const Link& link, double dt) noexcept {
  const double speed = bodies[link.a].speed() + bodies[link.b].speed() + link.closing;
  const double L = std::max(bodies[link.a].candidates().length(), bodies[link.b].candidates().length());
  const double reach = 2 * dt * speed + farther * L;
  for (const NearPair& pair : link.facets.pairs()) {
    const Candidates &c = bodies[pair.mass.body].candidates(), &d = bodies[pair.other.body].candidates();
    const Facets::Corners& k = bodies[pair.other.body].facets()->all()[pair.other.n];
    const FacetNow facet = facet_now(d, k);
    const ClosestPoint nearest = closest_point(c.x()[pair.mass.n], facet.corner);
    if (nearest.distance == 0) continue;
    Row row;
    row.end = {pair.mass, PairEnd{pair.other.body, k[0]}, PairEnd{pair.other.body, k[1]},
               PairEnd{pair.other.body, k[2]}};
    row.weight = k[0] == k[1] ? Vec3(1, 0, 0) : Vec3(nearest.weight);
    row.n = nearest.away / nearest.distance;
    row.key = key_of(pair.mass, pair.other);
    each_end(row,
             [&](PairEnd at, double w) { row.W += w * w * bodies[at.body].candidates().inverse_mass(at.n); });
    add(row, nearest.distance, swept_distance(facet.edge, c), reach);
  }
  for (const NearPair& pair : link.masses.pairs()) {
    const Candidates &c = bodies[pair.mass.body].candidates(), &d = bodies[pair.other.body].candidates();
    const Vec3 away = c.x()[pair.mass.n] - d.x()[pair.other.n];
    Row row;
    row.end = {pair.mass, pair.other, pair.other, pair.other};
    row.weight = Vec3(1, 0, 0);
    row.n = away.normalized();
    row.key = key_of(pair.mass, pair.other);
    row.W = c.inverse_mass(pair.mass.n) + d.inverse_mass(pair.other.n);
    add(row, away.norm(), paper_distance(c, d), reach);
  }
}

void JointContact::begin(const std::vector<ContactBody>& bodies, std::span<Link> links, double dt) noexcept {
  last_.clear();
  for (const Row& row : rows_)
    if (row.l > 0) last_.push_back({row.key, row.l, row.least});
  std::sort(last_.begin(), last_.end(),
            [](const Remembered& a, const Remembered& b) { return a.key < b.key; });
  rows_.clear();
  for (const Link& link : links)
    if (link.near) find(bodies, link, dt);
  iterations_ = 0;
  converged_ = rows_.empty();
  square_ = 0;
  spread(bodies);
}

/// By how much it ends nearer than it may. [m]
double JointContact::missing(const std::vector<ContactBody>& bodies, const Row& row,
                             double dt) const noexcept {
  double v_n = 0;
  each_end(row, [&](PairEnd at, double w) {
    v_n += w * row.n.dot(bodies[at.body].candidates().v_move()[at.n] + dv_[id_of(at)]);
  });
  return row.least - row.gap - dt * v_n;
}

void JointContact::sweep(const std::vector<ContactBody>& bodies, double dt) noexcept {
  for (int n = 0; n < sweeps_together; ++n)
    for (Row& row : rows_) {
      const double before = row.l + row.change;
      const double change = std::max(-before, missing(bodies, row, dt) / (dt * dt * row.W));
      if (change == 0) continue;
      row.change += change;
      each_end(row, [&](PairEnd at, double w) {
        dv_[id_of(at)] += dt * change * w * bodies[at.body].candidates().inverse_mass(at.n) * row.n;
      });
    }
  for (const Row& row : rows_) each_end(row, [&](PairEnd at, double) { dv_[id_of(at)].setZero(); });
}

bool JointContact::improve(const std::vector<ContactBody>& bodies, double dt) noexcept {
  if (rows_.empty()) return false;
  for (Row& row : rows_) row.change = 0;
  // As it stands: what is missing, or what a force holds apart that need not be.
  double worst = 0;
  for (const Row& row : rows_) {
    const double off = missing(bodies, row, dt);
    worst = std::max(worst, row.l > 0 ? std::abs(off) : off);
  }
  converged_ = worst <= near_enough_;
  if (converged_ || iterations_ == most_iterations) return false;
  sweep(bodies, dt);
  double square = 0;
  for (const Row& row : rows_) square += row.change * row.change;
  const double beta = square_ > 0 ? square / square_ : 2;
  square_ = square;
  for (Row& row : rows_) {
    // Of the first, and where the last direction has led astray, the sweep alone.
    const double along = beta > 1 ? 0 : beta * row.direction;
    row.direction = row.change + along;
    row.l = std::max(0.0, row.l + row.direction);
  }
  ++iterations_;
  spread(bodies);
  return true;
}

void JointContact::spread(const std::vector<ContactBody>& bodies) noexcept {
  for (auto& list : forces_) list.clear();
  for (const Row& row : rows_)
    if (row.l > 0) each_end(row, [&](PairEnd at, double w) { dv_[id_of(at)] += w * row.l * row.n; });
  for (const Row& row : rows_)
    if (row.l > 0)
      each_end(row, [&](PairEnd at, double) {
        Vec3& force = dv_[id_of(at)];
        const Candidates& c = bodies[at.body].candidates();
        if (!force.isZero(0) && c.inverse_mass(at.n) > 0) forces_[at.body].push_back({c.cell()[at.n], force});
        force.setZero();
      });
}

JointReport JointContact::end(const std::vector<ContactBody>& bodies, double dt,
                              ContactImpulses& impulses) noexcept {
  JointReport report{.solves = iterations_, .overflows = overflows_, .converged = converged_};
  overflows_ = 0;
  for (const Row& row : rows_) {
    if (!(row.l > 0)) continue;
    ++report.touching;
    each_end(row, [&](PairEnd at, double w) { impulses.push(bodies, at, w * row.l * dt * row.n); });
  }
  return report;
}

}  // namespace palpate::physics
