#include "physics_node/collision/pair_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics_node/collision/facet_now.h"
#include "physics_node/collision/usual_motion.h"

namespace palpate::physics {
namespace {

constexpr double least_cell_over_L = 2;  // of a grid: few cells to look at, few masses in each
// Two masses that have not left their places by more than this, drift apart, do not meet: at rest those that are not joined
// are 1.4 L apart, L where an element broke, and 0.82 L from a facet that broke off.
constexpr double still_over_L = 0.1;

}  // namespace

double paper_distance(const Candidates& a, const Candidates& b) noexcept {
  return std::max(a.length(), b.length()) / std::numbers::sqrt3;
}

double swept_distance(double edge, const Candidates& of_mass) noexcept {
  return (edge + of_mass.length()) * (0.5 / std::numbers::sqrt3);
}

void PairList::add(PairEnd mass, PairEnd other) noexcept {
  if (pairs_.size() == pairs_.capacity()) {
    ++overflows_;
    return;
  }
  pairs_.push_back({mass, other});
}

void PairList::sort() noexcept {
  const auto key = [](const PairEnd& end) { return std::uint64_t{end.body} << 32 | end.n; };
  std::sort(pairs_.begin(), pairs_.end(), [&](const NearPair& p, const NearPair& q) {
    const std::uint64_t a = key(p.mass), b = key(q.mass);
    return a != b ? a < b : key(p.other) < key(q.other);
  });
}

void PairList::sort_by_mass(std::uint32_t a, std::size_t n_a, std::size_t n) noexcept {
  const auto number = [&](const PairEnd& mass) { return (mass.body == a ? 0 : n_a) + mass.n; };
  begin_.assign(n + 1, 0);
  for (const NearPair& pair : pairs_) ++begin_[number(pair.mass) + 1];
  for (std::size_t m = 0; m < n; ++m) begin_[m + 1] += begin_[m];
  by_mass_.resize(pairs_.size());
  for (const NearPair& pair : pairs_) by_mass_[begin_[number(pair.mass)]++] = pair;
  pairs_.swap(by_mass_);
}

PairSearch::PairSearch(const std::vector<ContactBody>& bodies) {
  for (const auto& body : bodies) {
    const std::size_t most = body.candidates().most();
    sides_.push_back({std::vector<std::uint8_t>(most, 0), {}, PointGrid(most), {}, 0, {}, 0});
  }
}

void PairSearch::choose_movers(const ContactBody& body, std::uint32_t b) noexcept {
  const Candidates& c = body.candidates();
  Side& side = sides_[b];
  const Vec3 drift = usual_motion(c.size(), [&](std::size_t n) { return Vec3(c.x()[n] - c.rest()[n]); });
  const double still = still_over_L * c.length();
  for (std::size_t n = 0; n < c.size(); ++n) {
    const bool moved = (c.x()[n] - c.rest()[n] - drift).squaredNorm() > still * still;
    side.seeks[n] = moved && body.may_meet_itself(n) ? 1 : 0;
    if (side.seeks[n] != 0) side.box.extend(c.x()[n]);
    side.grid.insert(static_cast<std::uint32_t>(n), side.level_of(n), c.x()[n]);  // what rests can be met
  }
  side.grid.arrange();
}

void PairSearch::choose_inside(const ContactBody& body, std::uint32_t b,
                               const Eigen::AlignedBox3d& box) noexcept {
  const Candidates& c = body.candidates();
  Side& side = sides_[b];
  for (std::size_t n = 0; n < c.size(); ++n) {
    side.seeks[n] = box.contains(c.x()[n]) ? 1 : 0;
    if (side.seeks[n] == 0) continue;
    side.box.extend(c.x()[n]);
    side.grid.insert(static_cast<std::uint32_t>(n), side.level_of(n), c.x()[n]);
  }
  side.grid.arrange();
}

/// @param touch  farthest at which any two of them touch [m]
void PairSearch::choose(const std::vector<ContactBody>& bodies, std::uint32_t a, std::uint32_t b,
                        double touch, const ListReach& reach) noexcept {
  const double all = touch + reach.skin + reach.between;
  double farthest = all;
  for (const std::uint32_t n : {a, b}) {
    Side& side = sides_[n];
    side.given = n == a ? reach.of_a : reach.of_b;
    side.little = reach.skin;
    side.most = {};
    for (std::size_t c = 0; c < side.given.size(); ++c) {
      double& most = side.most[side.level_of(c)];
      most = std::max(most, side.given[c]);
    }
    side.most_of_all = *std::ranges::max_element(side.most);
    farthest += side.most_of_all;
    side.box.setEmpty();
    const double least = least_cell_over_L * bodies[n].candidates().length();
    std::array<double, PointGrid::levels> size{};
    for (std::size_t level = 0; level < size.size(); ++level)
      size[level] = std::max(least, all + side.most[level]);
    side.grid.clear(size);
  }
  if (a == b) return choose_movers(bodies[a], a);
  const auto widened = [&](const ContactBody& body) {
    Eigen::AlignedBox3d box = body.box();
    box.min().array() -= farthest, box.max().array() += farthest;
    return box;
  };
  choose_inside(bodies[a], a, widened(bodies[b]));
  choose_inside(bodies[b], b, widened(bodies[a]));
}

void PairSearch::find_masses(const std::vector<ContactBody>& bodies, std::uint32_t a, std::uint32_t b,
                             const ListReach& reach, PairList& list) noexcept {
  const Candidates& c = bodies[a].candidates();
  const Candidates& d = bodies[b].candidates();
  const double touch = paper_distance(c, d);
  choose(bodies, a, b, touch, reach);
  const Side& other = sides_[b];
  const auto& seeks = sides_[a].seeks;
  list.clear();
  for (std::uint32_t n = 0; n < c.size(); ++n) {
    if (seeks[n] == 0) continue;
    const Vec3& p = c.x()[n];
    const double own = touch + reach.skin + reach.between + sides_[a].given_to(n);
    for (std::uint32_t level = 0; level < PointGrid::levels; ++level) {
      const Vec3 around = Vec3::Constant(own + other.most[level]);
      other.grid.visit_box(level, p - around, p + around, [&](std::uint32_t m, const Vec3& at) {
        // Of two that seek each other the first finds the second.
        if (a == b && (m == n || (m < n && seeks[m] != 0))) return;
        const double within = own + other.given_to(m);
        if ((at - p).squaredNorm() > within * within) return;
        if (a == b && c.are_joined(n, m)) return;
        list.add({a, a == b ? std::min(n, m) : n}, {b, a == b ? std::max(n, m) : m});
      });
    }
  }
  list.sort();
}

void PairSearch::find_facets(const std::vector<ContactBody>& bodies, std::uint32_t a, std::uint32_t b,
                             const ListReach& reach, PairList& list) noexcept {
  // As far as any pair touches at: the facets that are stretched most feel farthest.
  const double L = std::max(bodies[a].candidates().length(), bodies[b].candidates().length());
  choose(bodies, a, b, (most_felt_stretch + 1) * L * (0.5 / std::numbers::sqrt3), reach);
  list.clear();
  const double skin = reach.skin + reach.between;
  const auto seek = [&](std::uint32_t of, std::uint32_t other) {
    const auto n = static_cast<std::uint32_t>(bodies[of].facets()->all().size());
    for (std::uint32_t f = 0; f < n; ++f) seek_masses_near(bodies, {of, f}, other, skin, list);
  };
  seek(a, b);
  if (a != b) seek(b, a);
  const std::size_t n_a = bodies[a].candidates().size();
  list.sort_by_mass(a, n_a, a == b ? n_a : n_a + bodies[b].candidates().size());
}

void PairSearch::seek_masses_near(const std::vector<ContactBody>& bodies, PairEnd facet, std::uint32_t other,
                                  double skin, PairList& list) const noexcept {
  const std::uint32_t b = facet.body;
  const bool same = other == b;
  const Side& side = sides_[other];
  const Candidates& c = bodies[b].candidates();
  const Candidates& d = bodies[other].candidates();
  const Facets::Corners& k = bodies[b].facets()->all()[facet.n];
  const FacetNow now = facet_now(c, k);
  const Side& mine = sides_[b];
  const double own = swept_distance(now.edge, d) + skin +
                     std::max({mine.given_to(k[0]), mine.given_to(k[1]), mine.given_to(k[2])});
  const Vec3 lo = now.corner[0].cwiseMin(now.corner[1]).cwiseMin(now.corner[2]);
  const Vec3 hi = now.corner[0].cwiseMax(now.corner[1]).cwiseMax(now.corner[2]);
  // A facet whose corners are all far away may still reach over what is near: stretched tissue round a small tool.
  const bool seeks = same && (side.seeks[k[0]] | side.seeks[k[1]] | side.seeks[k[2]]) != 0;
  const Vec3 farthest = Vec3::Constant(own + side.most_of_all);
  if (!seeks && !side.box.intersects(Eigen::AlignedBox3d(lo - farthest, hi + farthest))) return;
  const bool loose = k[0] == k[1];
  const Vec3 middle = (now.corner[0] + now.corner[1] + now.corner[2]) / 3;
  double out = 0;  // of the corners from there
  for (const Vec3& corner : now.corner) out = std::max(out, (corner - middle).squaredNorm());
  out = std::sqrt(out);
  for (std::uint32_t level = 0; level < PointGrid::levels; ++level) {
    const Vec3 reach = Vec3::Constant(own + side.most[level]);
    side.grid.visit_box(level, lo - reach, hi + reach, [&](std::uint32_t m, const Vec3& p) {
      const double within = own + side.given_to(m);
      const double around = (out + within) * (1 + 1e-12);
      if ((p - middle).squaredNorm() > around * around) return;  // most of a box, and quickly told
      if (!seeks && side.seeks[m] == 0) return;
      if (same && (m == k[0] || m == k[1] || m == k[2])) return;
      // A loose mass that meets a facet is found by that facet; two loose ones find each other once.
      if (loose && (!bodies[other].facets()->is_loose(m) || other > b || (same && m > k[0]))) return;
      if (closest_point(p, now.corner).distance > within) return;
      if (same && (c.are_joined(m, k[0]) || c.are_joined(m, k[1]) || c.are_joined(m, k[2]))) return;
      list.add({other, m}, facet);
    });
  }
}

}  // namespace palpate::physics
