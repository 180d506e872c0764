#include "physics_node/contact/blade_edge.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::physics {
namespace {

// In spacings.
constexpr double ahead_reach =
    1.5;  // Why: a blade between two layers of masses presses on the one ahead whatever the direction
constexpr double back_reach = 0.5;  // of tissue that an edge holds on to, and that a hand may go back by
constexpr double compared_anew_in = 0.05;  // [s]
constexpr double evened_in =
    2;  // Why: less, and the force would jump with every element, more, and it would lag behind the tissue
constexpr double most_from_tissue = 0.9;  // of the toughness: an edge that is free does not stand still
constexpr double passed_by =
    0.25;  // Why: tissue before an edge moves by little against its neighbours without being cut
constexpr double cut_behind =
    1.5;  // Why: where the blade's body is there is no element; farther behind there is no blade to be sure of

/// Of what lies d ahead of a strip: less the farther, and none where it has been passed, without a jump.
double weight(double d, double h) noexcept {
  return std::max(0.0, d < 0 ? 1 + d / (passed_by * h) : 1 - d / (ahead_reach * h));
}

/// Of what has changed, how much is taken up in a step in which an edge has slid so far.
double evened_part(double slid, double h, double dt) noexcept {
  return std::min(1.0, slid / h + dt / compared_anew_in);
}

}  // namespace

double BladeEdge::felt_stiffness() const noexcept {
  double sum = 0;
  for (const Strip& strip : strips_)
    if (strip.bites) sum += strip.cover * hold();
  return sum > 0 ? stiffness_ * sum / (stiffness_ + sum) : 0.0;
}

EdgePlace BladeEdge::place() const noexcept {
  EdgePlace place{.lag = lag_, .last = lag_, .slot = slot_, .bites = bites_};
  for (const Strip& strip : strips_)
    if (strip.bites) place.last = std::min(place.last, strip.q);
  return place;
}

BladeEdge::BladeEdge(double length, std::size_t n_strips, double stiffness)
    : length_(length),
      width_(length / static_cast<double>(n_strips)),
      stiffness_(stiffness),
      strips_(n_strips) {}

void BladeEdge::let_go() noexcept {
  for (Strip& strip : strips_) strip = {};
  bites_ = false;
  slot_ = lag_ = lag_before_ = aside_ = 0;
  purse_ = from_tissue_ = 0;
  seen_ = false;
}

/// Strips of which any part is within `reach` of p.
BladeEdge::Window BladeEdge::strips_near(double p, double reach) const noexcept {
  reach += 0.5 * width_;
  const double most = static_cast<double>(strips_.size());
  const double first = std::ceil((p - reach) / width_ - 0.5), last = std::floor((p + reach) / width_ - 0.5);
  return {static_cast<std::size_t>(std::clamp(first, 0.0, most)),
          static_cast<std::size_t>(std::clamp(last + 1, 0.0, most))};
}

/// Calls visit(link, crossing, strip, weight) for every strip that bites and what it presses on.
template <class Visit>
void BladeEdge::each_held(const BladeLinks& links, BladeLinks::Crossing BladeLinks::Link::*when,
                          const Visit& visit) noexcept {
  const double h = links.spacing();
  for (const BladeLinks::Link& link : links.links()) {
    const BladeLinks::Crossing& at = link.*when;
    if (!at.is || !link.lives) continue;
    const Window near = strips_near(at.p, h);
    for (std::size_t i = near.first; i < near.last; ++i) {
      Strip& strip = strips_[i];
      if (!strip.bites) continue;
      if (const double w = weight(at.q - strip.held_q, h); w > 0) visit(link, at, strip, w);
    }
  }
}

/// About where tissue has carried the strips, by what each has pressed on. Who finds none ahead, or was left behind by the hand,
/// lets go.
void BladeEdge::follow(BladeLinks& links, const BladeFrame& frame) noexcept {
  const double h = links.spacing();
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (Strip& strip : strips_) strip.weight = 0, strip.way.setZero();
  each_held(links, &BladeLinks::Link::before,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              strip.weight += w;
              strip.way += w * at.between(nodes[link.a].way, nodes[link.b].way);
            });
  for (Strip& strip : strips_) {
    strip.follows = strip.bites && strip.weight > 0;
    if (!strip.bites) continue;
    const Vec3 way = strip.follows ? Vec3(strip.way / strip.weight) : Vec3(Vec3::Zero());
    const Vec3 at = frame.coordinates(strip.x + way);
    strip.q = at.y(), strip.r = at.z();
    strip.bites = strip.follows && strip.q < back_reach * h;
  }
}

/// Exactly where: by the weights with which they are about to press, as masses go to and fro in a step by much more than they get on.
/// So what the hand gives is what tissue gets.
void BladeEdge::carry(const BladeLinks& links, const BladeFrame& frame) noexcept {
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (Strip& strip : strips_) strip.way.setZero();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              strip.way += w / strip.weight * at.between(nodes[link.a].way, nodes[link.b].way);
            });
  for (Strip& strip : strips_) {
    if (!strip.bites || !strip.follows) continue;
    const Vec3 at = frame.coordinates(strip.x + strip.way);
    strip.q = at.y(), strip.r = at.z();
  }
  stay_before_elements(links);
}

/// What a strip has not gone past by sliding it is not past: where tissue turns or shears before it, it stays with the element that is
/// farthest behind.
void BladeEdge::stay_before_elements(const BladeLinks& links) noexcept {
  const double passed = passed_by * links.spacing();
  for (const BladeLinks::Link& link : links.links()) {
    if (!link.lives || !link.now.is || !link.before.is || !is_along(link.now.p)) continue;
    Strip& strip = strip_at(link.now.p);
    if (!strip.bites || !strip.follows || link.before.q < strip.last_q - passed) continue;
    strip.q = std::min(strip.q, link.now.q + passed);
  }
}

/// A free strip that has come to an element in this step bites where that is. Between elements it bites with those at its
/// sides, which are no farther apart than a spacing.
void BladeEdge::touch(BladeLinks& links, const BladeFrame& frame) noexcept {
  if (!seen_) return;
  const double h = links.spacing();
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (const BladeLinks::Link& link : links.links()) {
    const BladeLinks::Crossing& at = link.now;
    if (!at.is || at.q > lag_) continue;
    const double edge_way = (frame.tip - before_.tip + at.p * (frame.along - before_.along)).dot(frame.ahead);
    const double way = at.between(nodes[link.a].way, nodes[link.b].way).dot(frame.ahead);
    if (at.q - way + edge_way < lag_before_ - 1e-6 * h) continue;  // it was behind already
    const Window near = strips_near(at.p, 0.5 * h);
    for (std::size_t i = near.first; i < near.last; ++i) {
      Strip& strip = strips_[i];
      if (strip.bites && strip.q <= at.q) continue;
      if (strip.bites && strip.ahead > 0) continue;  // it has pressed before this step
      strip = {.bites = true, .q = at.q, .r = slot_};
    }
  }
}

/// From now on in this step: who holds on to what, and how much of a strip there is tissue for: as far as there are elements on both sides.
void BladeEdge::weigh(const BladeLinks& links) noexcept {
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (Strip& strip : strips_) {
    strip.held_q = strip.q;
    strip.weight = strip.toughness = strip.cover = 0;
    strip.low = 2 * length_, strip.high = -2 * length_;
  }
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              strip.weight += w;
              strip.low = std::min(strip.low, at.p), strip.high = std::max(strip.high, at.p);
              strip.toughness += w * 0.5 * (nodes[link.a].toughness + nodes[link.b].toughness);
            });
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    Strip& strip = strips_[i];
    strip.bites = strip.bites && strip.weight > 0;
    if (!strip.bites) continue;
    strip.toughness /= strip.weight;
    const double begin = static_cast<double>(i) * width_;
    const double low = std::max(strip.low, begin), high = std::min(strip.high, begin + width_);
    strip.cover = std::max(0.0, high - low) / width_;
  }
}

/// By how much the area before a strip has grown or shrunk: the places at rest of where its elements cross,
/// X = X_0 + A q + B p by least squares, make of dq dp an area |A x B| dq dp.
void BladeEdge::compare_with_rest(const BladeLinks& links, double dt) noexcept {
  struct Sums {
    double n = 0, q = 0, p = 0, qq = 0, qp = 0, pp = 0;
    Vec3 x = Vec3::Zero(), xq = Vec3::Zero(), xp = Vec3::Zero();
  };
  std::array<Sums, most_strips> sums{};
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              Sums& s = sums[static_cast<std::size_t>(&strip - strips_.data())];
              const Vec3 x = at.between(nodes[link.a].rest, nodes[link.b].rest);
              s.n += w, s.q += w * at.q, s.p += w * at.p;
              s.qq += w * at.q * at.q, s.qp += w * at.q * at.p, s.pp += w * at.p * at.p;
              s.x += w * x, s.xq += w * at.q * x, s.xp += w * at.p * x;
            });
  const double least = 1e-3 * links.spacing() * links.spacing();
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Sums& s = sums[i];
    Strip& strip = strips_[i];
    // An element that is cut leaves others to compare with: what is felt of that comes as the edge goes on.
    const bool first = strip.new_bite;
    const double part = first ? 1.0 : evened_part(strip.slid, links.spacing(), dt);
    strip.slid_before = strip.slid, strip.slid = 0;
    if (!strip.bites || s.n <= 0) continue;
    const double q = s.q / s.n, p = s.p / s.n;
    const double qq = s.qq / s.n - q * q, qp = s.qp / s.n - q * p, pp = s.pp / s.n - p * p;
    const double det = qq * pp - qp * qp;
    if (det < least * least) continue;
    const Vec3 x = s.x / s.n, xq = s.xq / s.n - q * x, xp = s.xp / s.n - p * x;
    const Vec3 A = (pp * xq - qp * xp) / det, B = (qq * xp - qp * xq) / det;
    strip.unstrained += part * (std::clamp(A.cross(B).norm(), 0.1, 10.0) - strip.unstrained);
    strip.new_bite = false;
    const double middle = (static_cast<double>(i) + 0.5) * width_;
    const Vec3 front = x + (strip.q - q) * A + (middle - p) * B;
    if (!first) count_passed(strip, front, A, B);
    strip.front = front;
    const double even = std::clamp(1 + strip.unpaid / (evened_in * links.spacing() * width_), 0.5, 1.5);
    strip.even += part * (even - strip.even);
  }
}

/// What a strip has passed since the last step. Counted by where it is, and not by how far it went, this is right in the sum:
/// where the two differ, as tissue is pressed together before the edge, the next that it opens is booked as so much more or less.
void BladeEdge::count_passed(Strip& strip, const Vec3& front, const Vec3& A, const Vec3& B) noexcept {
  const Vec3 normal = A.cross(B);
  const double size = normal.norm();
  if (size < 0.1) return;
  const double passed = (front - strip.front).cross(B).dot(normal) / size * strip.cover * width_;
  strip.unpaid += passed - strip.booked;
  strip.booked = 0;
}

/// Elements that are cut give what they held, and the hand pays the rest (Griffith). Spread over the way to come.
void BladeEdge::share_released(const BladeLinks& links, double dt) noexcept {
  double slid = 0, full = 0;
  for (Strip& strip : strips_) {
    const double resists = strip.bites ? resistance(strip) : 0.0;
    full += resists, slid += resists * strip.slid_before;
  }
  if (!(full > 0)) return;
  const double wanted =
      std::clamp(purse_ / (full * evened_in * links.spacing()), -most_from_tissue, most_from_tissue);
  from_tissue_ += evened_part(slid / full, links.spacing(), dt) * (wanted - from_tissue_);
}

/// How softly what they hold gives way in a step: g.
void BladeEdge::soften(BladeLinks& links, double dt) noexcept {
  const double k = hold();
  const std::span<BladeLinks::Node> nodes = links.nodes();
  for (Strip& strip : strips_) strip.softness = 0;
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              nodes[link.a].pull += w / strip.weight * (1 - at.t) * k * strip.cover;
              nodes[link.b].pull += w / strip.weight * at.t * k * strip.cover;
            });
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              const BladeLinks::Node &a = nodes[link.a], &b = nodes[link.b];
              strip.softness += dt * dt * w / strip.weight *
                                ((1 - at.t) * a.inverse_mass * a.pull + at.t * b.inverse_mass * b.pull);
            });
}

/// What all strips press with when the blade is there, ahead [N].
double BladeEdge::hold_ahead(double q) const noexcept {
  double sum = 0;
  for (const Strip& strip : strips_)
    if (strip.bites) sum += std::clamp(hold_of(strip) * (q - strip.q), 0.0, most_force(strip));
  return sum;
}

/// Where the blade is in balance between strips and hand. Ahead by halving, as the sum has a corner for each strip.
void BladeEdge::find_blade() noexcept {
  lag_ = aside_ = 0;
  double low = 0, across = 0, held = 0;
  for (const Strip& strip : strips_) {
    if (!strip.bites) continue;
    low = std::min(low, strip.q);
    const double k = hold_of(strip);
    across += k * strip.r, held += k;
  }
  if (held == 0) return;
  aside_ = across / (stiffness_ + held);
  double high = 0;
  for (int n = 0; n < 50 && low < high; ++n) {
    const double middle = 0.5 * (low + high);
    (hold_ahead(middle) < -stiffness_ * middle ? low : high) = middle;
  }
  lag_ = 0.5 * (low + high);
}

/// The force of a strip, and how far it has to go on for that.
void BladeEdge::slide(Strip& strip, Outcome& done) const noexcept {
  strip.ahead = strip.across = 0;
  if (!strip.bites) return;
  if (strip.cover == 0) {
    strip.q = std::max(strip.q, lag_);
    return;
  }
  const double k = hold_of(strip), most = most_force(strip);
  strip.ahead = std::max(0.0, k * (lag_ - strip.q));
  strip.across = k * (aside_ - strip.r);
  if (strip.ahead <= most) return;
  const double on = lag_ - strip.q - most / k;
  strip.q += on;
  strip.slid += on;
  strip.ahead = most;
  const double area = width_at_rest(strip) * on;
  strip.booked += area;
  done.area += area;
  done.work += most * on;
  done.released += from_tissue_ * resistance(strip) * on;
}

/// Puts the forces of the strips on the nodes that they hold.
void BladeEdge::press(BladeLinks& links, const BladeFrame& frame, double dt, Outcome& done) noexcept {
  const std::span<BladeLinks::Node> nodes = links.nodes();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              const Vec3 force = w / strip.weight * (strip.ahead * frame.ahead + strip.across * frame.side);
              nodes[link.a].force += (1 - at.t) * force;
              nodes[link.b].force += at.t * force;
            });
  for (Strip& strip : strips_) strip.way.setZero();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, Strip& strip, double w) {
              const BladeLinks::Node &a = nodes[link.a], &b = nodes[link.b];
              strip.way +=
                  dt * dt * w / strip.weight * at.between(a.inverse_mass * a.force, b.inverse_mass * b.force);
            });
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    Strip& strip = strips_[i];
    if (!strip.bites) continue;
    const double p = (static_cast<double>(i) + 0.5) * width_;
    strip.last_q = strip.q;
    strip.x = frame.tip + p * frame.along + strip.q * frame.ahead + strip.r * frame.side + strip.way;
  }
  for (const BladeLinks::Node& node : nodes) {
    done.force += node.force;
    done.moment += (node.x - frame.tip).cross(node.force);
    done.power += node.force.dot(node.v_before);
  }
}

BladeEdge::Outcome BladeEdge::step(BladeLinks& links, const BladeFrame& frame, double dt,
                                   std::vector<EdgeGone>& cuts) noexcept {
  Outcome done;
  links.update(frame, place());
  follow(links, frame);
  touch(links, frame);
  lag_before_ = lag_;
  find_slot();
  links.cross(slot_);
  weigh(links);
  carry(links, frame);
  compare_with_rest(links, dt);
  share_released(links, dt);
  soften(links, dt);
  find_blade();
  for (Strip& strip : strips_) slide(strip, done);
  purse_ -= done.released;
  press(links, frame, dt, done);
  cut(links, cuts);
  links.remember();
  bites_ = std::ranges::any_of(strips_, [](const Strip& strip) { return strip.bites; });
  before_ = frame;
  seen_ = true;
  return done;
}

/// All of the edge lies in one plane.
void BladeEdge::find_slot() noexcept {
  slot_ = 0;
  double n = 0;
  for (const Strip& strip : strips_)
    if (strip.bites) slot_ += strip.r, n += 1;
  if (n > 0) slot_ /= n;
}

/// Elements that the edge has passed, and those that its body has come to lie in.
void BladeEdge::cut(BladeLinks& links, std::vector<EdgeGone>& cuts) noexcept {
  const double passed = passed_by * links.spacing(), behind = cut_behind * links.spacing();
  std::span<BladeLinks::Node> nodes = links.nodes();
  for (BladeLinks::Link& link : links.links()) {
    const BladeLinks::Crossing& at = link.now;
    if (!at.is || !is_along(at.p) || cuts.size() == cuts.capacity()) continue;
    const Strip& strip = strip_at(at.p);
    if (!strip.bites || at.q >= strip.q - passed || at.q < strip.q - behind) continue;
    link.lives = link.now.is = false;
    cuts.push_back({nodes[link.a].cell, nodes[link.b].cell});
  }
}

}  // namespace palpate::physics
