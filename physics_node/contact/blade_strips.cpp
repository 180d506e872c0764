#include "physics_node/contact/blade_strips.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr double back_reach =
    0.5;  // spacings of tissue that an edge holds on to, and that a hand may go back by

}  // namespace

void BladeStrips::follow(const BladeLinks& links, const BladeFrame& frame) noexcept {
  const double h = links.spacing();
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (BladeStrip& strip : strips_) strip.weight = 0, strip.way.setZero();
  each_held(links, &BladeLinks::Link::before,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
              strip.weight += w;
              strip.way += w * at.between(nodes[link.a].way, nodes[link.b].way);
            });
  for (BladeStrip& strip : strips_) {
    strip.follows = strip.bites && strip.weight > 0;
    if (!strip.bites) continue;
    const Vec3 way = strip.follows ? Vec3(strip.way / strip.weight) : Vec3(Vec3::Zero());
    const Vec3 at = frame.coordinates(strip.x + way);
    strip.q = at.y(), strip.r = at.z();
    strip.bites = strip.follows && strip.q < back_reach * h;
  }
}

void BladeStrips::carry(const BladeLinks& links, const BladeFrame& frame) noexcept {
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (BladeStrip& strip : strips_) strip.way.setZero();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
              strip.way += w / strip.weight * at.between(nodes[link.a].way, nodes[link.b].way);
            });
  for (BladeStrip& strip : strips_) {
    if (!strip.bites || !strip.follows) continue;
    const Vec3 at = frame.coordinates(strip.x + strip.way);
    strip.q = at.y(), strip.r = at.z();
  }
  stay_before_elements(links);
}

void BladeStrips::stay_before_elements(const BladeLinks& links) noexcept {
  const double passed = passed_by * links.spacing();
  for (const BladeLinks::Link& link : links.links()) {
    if (!link.lives || !link.now.is || !link.before.is || !is_along(link.now.p)) continue;
    BladeStrip& strip = at(link.now.p);
    if (!strip.bites || !strip.follows || link.before.q < strip.last_q - passed) continue;
    strip.q = std::min(strip.q, link.now.q + passed);
  }
}

void BladeStrips::weigh(const BladeLinks& links) noexcept {
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (BladeStrip& strip : strips_) {
    strip.held_q = strip.q;
    strip.weight = strip.toughness = strip.cover = 0;
    strip.low = 2 * length_, strip.high = -2 * length_;
  }
  std::array<const BladeLinks::Link*, most> lowest{}, highest{};
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
              strip.weight += w;
              const auto i = static_cast<std::size_t>(&strip - strips_.data());
              if (at.low < strip.low) strip.low = at.low, lowest[i] = &link;
              if (at.high > strip.high) strip.high = at.high, highest[i] = &link;
              strip.toughness += w * 0.5 * (nodes[link.a].toughness + nodes[link.b].toughness);
            });
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    BladeStrip& strip = strips_[i];
    strip.bites = strip.bites && strip.weight > 0;
    if (!strip.bites) continue;
    strip.toughness /= strip.weight;
    if (links.wall() > 0) continue;  // compare_with_rest() finds what it has before it
    const double begin = static_cast<double>(i) * width_, end = begin + width_;
    if (links.has_sections()) {
      if (strip.low > begin) strip.low = std::min(strip.low, links.skin_along(*lowest[i], begin));
      if (strip.high < end) strip.high = std::max(strip.high, links.skin_along(*highest[i], end));
    }
    const double low = std::max(strip.low, begin), high = std::min(strip.high, end);
    strip.cover = std::max(0.0, high - low) / width_;
  }
}

namespace {

struct Interval {
  double low = 0, high = 0;
};

/// Where along an edge that lies at q a piece of a wall is less than half its thickness away.
Interval within(const BladeLinks::WallPiece& piece, double q, double half) noexcept {
  const double dp = piece.p[1] - piece.p[0], dq = piece.q[1] - piece.q[0], ahead = q - piece.q[0];
  const double length = std::sqrt(dp * dp + dq * dq);
  double low = -1e9, high = 1e9;  // of p, from its first end
  // | dq p - dp ahead | <= half length, and 0 <= dp p + dq ahead <= length^2
  if (std::abs(dq) > 1e-12 * length) {
    const double a = (dp * ahead - half * length) / dq, b = (dp * ahead + half * length) / dq;
    low = std::min(a, b), high = std::max(a, b);
  } else if (std::abs(dp * ahead) > half * length) {
    return {};
  }
  if (std::abs(dp) > 1e-12 * length) {
    const double a = -dq * ahead / dp, b = (length * length - dq * ahead) / dp;
    low = std::max(low, std::min(a, b)), high = std::min(high, std::max(a, b));
  } else if (dq * ahead < 0 || dq * ahead > length * length) {
    return {};
  }
  return {piece.p[0] + low, piece.p[0] + high};
}

}  // namespace

/// Of a surface an edge has before it what is within half the wall's thickness of where the plane cuts it, on a strip as
/// much as lies there: of a wall across the edge its thickness, of one along it all of the strip for as long as that is
/// thick. Two walls count twice.
void BladeStrips::cover_wall(const BladeLinks& links, double dt) noexcept {
  constexpr std::size_t most_pieces = 32;
  constexpr double least_ahead =
      0.3;  // Why: of a wall along the edge a little of the way ahead is a long way along it
  const double half = 0.5 * links.wall();
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    BladeStrip& strip = strips_[i];
    const double part = strip.new_bite ? 1.0 : evened_part(strip.slid, links.spacing(), dt);
    strip.slid_before = strip.slid, strip.slid = 0;
    if (!strip.bites) continue;
    const double begin = static_cast<double>(i) * width_, end = begin + width_;
    std::array<Interval, most_pieces> found;
    std::size_t n = 0;
    double all = 0, unstrained = 0, broadest = 0;
    const BladeLinks::WallPiece* across = nullptr;  // the most of it that goes on ahead
    for (const BladeLinks::WallPiece& piece : links.wall_pieces()) {
      Interval at = within(piece, strip.q, half);
      at.low = std::max(at.low, begin), at.high = std::min(at.high, end);
      if (!(at.high > at.low) || n == most_pieces) continue;
      found[n++] = at;
      all += at.high - at.low, unstrained += (at.high - at.low) * piece.unstrained;
      const double dp = piece.p[1] - piece.p[0], dq = piece.q[1] - piece.q[0];
      if (std::abs(dq) > least_ahead * std::abs(dp) && at.high - at.low > broadest)
        broadest = at.high - at.low, across = &piece;
    }
    std::sort(found.begin(), found.begin() + n,
              [](const Interval& a, const Interval& b) { return a.low < b.low; });
    double covered = 0, reached = begin;
    for (std::size_t k = 0; k < n; ++k) {
      covered += std::max(0.0, found[k].high - std::max(found[k].low, reached));
      reached = std::max(reached, found[k].high);
    }
    strip.cover = covered / width_;
    const bool first = strip.new_bite;
    strip.new_bite = across == nullptr;
    if (all <= 0) continue;
    strip.unstrained += part * (std::clamp(unstrained / all, 0.1, 10.0) - strip.unstrained);
    if (across == nullptr) continue;
    // Where it is in the wall at rest, and which way that goes on.
    const double dp = across->p[1] - across->p[0], dq = across->q[1] - across->q[0];
    const double cosine =
        std::abs(dq) / std::sqrt(dp * dp + dq * dq);  // its cover is as broad as the wall by that
    const Vec3 onward = (across->rest[1] - across->rest[0]) / dq;
    const Vec3 front = across->rest[0] + (strip.q - across->q[0]) * onward;
    if (!first) {
      unpaid_ +=
          (front - strip.front).dot(onward.normalized()) * strip.cover * width_ * cosine - strip.booked;
      strip.booked = 0;
    }
    strip.front = front;
    const double even = std::clamp(1 + unpaid_ / (evened_in * links.spacing() * links.wall()), 0.5, 1.5);
    strip.even += part * (even - strip.even);
  }
}

/// By how much the area before a strip has grown or shrunk: the places at rest of where its elements cross,
/// X = X_0 + A q + B p by least squares, make of dq dp an area |A x B| dq dp.
void BladeStrips::compare_with_rest(const BladeLinks& links, double dt) noexcept {
  if (links.wall() > 0) return cover_wall(links, dt);
  struct Sums {
    double n = 0, q = 0, p = 0, qq = 0, qp = 0, pp = 0;
    Vec3 x = Vec3::Zero(), xq = Vec3::Zero(), xp = Vec3::Zero();
  };
  std::array<Sums, most> sums{};
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
              Sums& s = sums[static_cast<std::size_t>(&strip - strips_.data())];
              const Vec3 x = at.between(nodes[link.a].rest, nodes[link.b].rest);
              s.n += w, s.q += w * at.q, s.p += w * at.p;
              s.qq += w * at.q * at.q, s.qp += w * at.q * at.p, s.pp += w * at.p * at.p;
              s.x += w * x, s.xq += w * at.q * x, s.xp += w * at.p * x;
            });
  const double least = 1e-3 * links.spacing() * links.spacing();
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Sums& s = sums[i];
    BladeStrip& strip = strips_[i];
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
    strip.onward += part * (A - strip.onward);
    const Vec3 front = x + (strip.q - q) * strip.onward + (middle(strip) - p) * B;
    if (!first) count_passed(strip, front, B);
    strip.front = front;
    const double even = std::clamp(1 + strip.unpaid / (evened_in * links.spacing() * width_), 0.5, 1.5);
    strip.even += part * (even - strip.even);
  }
}

void BladeStrips::go_on_uncovered(double lag, double reach) noexcept {
  const auto near = static_cast<std::size_t>(std::ceil(reach / width_));
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    BladeStrip& strip = strips_[i];
    if (!strip.bites || strip.cover > 0) continue;
    double front = lag;
    const std::size_t first = i > near ? i - near : 0, last = std::min(strips_.size(), i + near + 1);
    for (std::size_t k = first; k < last; ++k)
      if (strips_[k].bites && strips_[k].cover > 0) front = std::min(front, strips_[k].q);
    strip.q = std::max(strip.q, front);
  }
}

/// What a strip has passed since the last step. Counted by where it is, and not by how far it went, this is right in the sum:
/// where the two differ, as tissue is pressed together before the edge, the next that it opens is booked as so much more or less.
void BladeStrips::count_passed(BladeStrip& strip, const Vec3& front, const Vec3& B) noexcept {
  const double size = strip.onward.norm();
  if (size < 0.1) return;
  const Vec3 onward = strip.onward / size;
  const double passed = (front - strip.front).dot(onward) * onward.cross(B).norm() * strip.cover * width_;
  strip.unpaid += passed - strip.booked;
  strip.booked = 0;
}

}  // namespace palpate::physics
