#include "physics_node/contact/blade_strips.h"

#include <array>

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
    if (links.wall() > 0) continue;  // cover_wall()
    const double begin = static_cast<double>(i) * width_, end = begin + width_;
    if (links.has_sections()) {
      if (strip.low > begin) strip.low = std::min(strip.low, links.skin_along(*lowest[i], begin));
      if (strip.high < end) strip.high = std::max(strip.high, links.skin_along(*highest[i], end));
    }
    const double low = std::max(strip.low, begin), high = std::min(strip.high, end);
    strip.cover = std::max(0.0, high - low) / width_;
  }
  if (links.wall() > 0) cover_wall(links);
}

/// An edge goes through a surface at a point, about which its wall reaches along the edge: of a strip the part of that which lies on it. So
/// what a way opens is as thick as the wall wherever strips end. Deviation: as if the edge stood upright on it.
void BladeStrips::cover_wall(const BladeLinks& links) noexcept {
  std::array<double, most> p{};
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link&, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
              p[static_cast<std::size_t>(&strip - strips_.data())] += w * at.p;
            });
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    BladeStrip& strip = strips_[i];
    if (!strip.bites) continue;
    const double middle = p[i] / strip.weight, half = 0.5 * links.wall(),
                 begin = static_cast<double>(i) * width_;
    strip.low = middle - half, strip.high = middle + half;
    strip.cover = std::max(0.0, std::min(strip.high, begin + width_) - std::max(strip.low, begin)) / width_;
  }
}

/// By how much the area before a strip has grown or shrunk: the places at rest of where its elements cross,
/// X = X_0 + A q + B p by least squares, make of dq dp an area |A x B| dq dp.
void BladeStrips::compare_with_rest(const BladeLinks& links, double dt) noexcept {
  if (links.wall() > 0) return compare_way_with_rest(links, dt);
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

/// The same of a surface, where what lies before a strip is a line: X = X_0 + A q, and of a way dq |A| dq has been passed, as far as it is
/// thick.
void BladeStrips::compare_way_with_rest(const BladeLinks& links, double dt) noexcept {
  struct Sums {
    double n = 0, q = 0, qq = 0;
    Vec3 x = Vec3::Zero(), xq = Vec3::Zero();
  };
  std::array<Sums, most> sums{};
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  each_held(links, &BladeLinks::Link::now,
            [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
              Sums& s = sums[static_cast<std::size_t>(&strip - strips_.data())];
              const Vec3 x = at.between(nodes[link.a].rest, nodes[link.b].rest);
              s.n += w, s.q += w * at.q, s.qq += w * at.q * at.q;
              s.x += w * x, s.xq += w * at.q * x;
            });
  const double h = links.spacing();
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Sums& s = sums[i];
    BladeStrip& strip = strips_[i];
    const bool first = strip.new_bite;
    const double part = first ? 1.0 : evened_part(strip.slid, h, dt);
    strip.slid_before = strip.slid, strip.slid = 0;
    if (!strip.bites || s.n <= 0) continue;
    const double q = s.q / s.n, qq = s.qq / s.n - q * q;
    if (qq < 1e-3 * h * h) continue;
    const Vec3 x = s.x / s.n, A = (s.xq / s.n - q * x) / qq;
    strip.unstrained += part * (std::clamp(A.norm(), 0.1, 10.0) - strip.unstrained);
    strip.new_bite = false;
    strip.onward += part * (A - strip.onward);
    const Vec3 front = x + (strip.q - q) * strip.onward;
    if (!first) count_passed(strip, front, Vec3::Zero());
    strip.front = front;
    const double broad = std::min(width_, links.wall());
    const double even = std::clamp(1 + strip.unpaid / (evened_in * h * broad), 0.5, 1.5);
    strip.even += part * (even - strip.even);
  }
}

/// What a strip has passed since the last step. Counted by where it is, and not by how far it went, this is right in the sum:
/// where the two differ, as tissue is pressed together before the edge, the next that it opens is booked as so much more or less.
void BladeStrips::count_passed(BladeStrip& strip, const Vec3& front, const Vec3& B) noexcept {
  const double size = strip.onward.norm();
  if (size < 0.1) return;
  const Vec3 onward = strip.onward / size;
  const double broad = B.isZero(0) ? 1.0 : onward.cross(B).norm();  // of a line none
  const double passed = (front - strip.front).dot(onward) * broad * strip.cover * width_;
  strip.unpaid += passed - strip.booked;
  strip.booked = 0;
}

}  // namespace palpate::physics
