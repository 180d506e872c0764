#include "physics_node/contact/blade_edge.h"

#include <algorithm>

namespace palpate::physics {
namespace {

constexpr double paid_in =
    4;  // Why: spacings of way; a row of elements that is cut at once changes the force by a few hundredths
constexpr double most_from_tissue = 0.9;  // of the toughness: an edge that is free does not stand still
constexpr double cut_behind =
    1.5;  // Why: spacings; where the blade's body is there is no element; farther behind there is no blade to be sure of

}  // namespace

double BladeEdge::held() const noexcept {
  double sum = 0;
  for (const BladeStrip& strip : strips_)
    if (strip.bites) sum += strip.cover * hold();
  return sum;
}

EdgePlace BladeEdge::place() const noexcept {
  EdgePlace place{.lag = lag_, .last = lag_, .slot = slot_, .bites = bites_};
  for (const BladeStrip& strip : strips_)
    if (strip.bites) place.last = std::min(place.last, strip.q);
  return place;
}

BladeEdge::BladeEdge(double length, std::size_t n_strips, double stiffness)
    : stiffness_(stiffness), strips_(length, n_strips) {}

void BladeEdge::let_go() noexcept {
  strips_.let_go();
  bites_ = false;
  slot_ = lag_ = lag_before_ = aside_ = 0;
  coming_ = purse_ = from_tissue_ = 0;
  seen_ = false;
}

/// A free strip that has come to an element in this step bites where that is. Between elements it bites with those at its
/// sides, which are no farther apart than a spacing.
void BladeEdge::touch(BladeLinks& links, const BladeFrame& frame) noexcept {
  if (!seen_ || !sharp_) return;
  if (links.wall() > 0) return touch_wall(links);
  const double h = links.spacing();
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (const BladeLinks::Link& link : links.links()) {
    const BladeLinks::Crossing& at = link.now;
    if (!at.is || at.q > lag_) continue;
    const double edge_way = (frame.tip - before_.tip + at.p * (frame.along - before_.along)).dot(frame.ahead);
    const double way = at.between(nodes[link.a].way, nodes[link.b].way).dot(frame.ahead);
    if (at.q - way + edge_way < lag_before_ - 1e-6 * h) continue;  // it was behind already
    strips_.each_near(at.p, 0.5 * h, [&](BladeStrip& strip) {
      if (strip.bites && strip.q <= at.q) return;
      if (strip.bites && strip.ahead > 0) return;  // it has pressed before this step
      strip = {.bites = true, .q = at.q, .r = slot_};
    });
  }
}

/// A surface is met by what strips have of it before them: one that has some of it ahead goes with the edge until it
/// is there.
void BladeEdge::touch_wall(const BladeLinks& links) noexcept {
  const double h = links.spacing();
  for (const BladeLinks::Link& link : links.links()) {
    const BladeLinks::Crossing& at = link.now;
    if (!at.is || at.q < lag_ || at.q > lag_ + h) continue;
    strips_.each_near(at.p, 0.5 * h, [&](BladeStrip& strip) {
      if (!strip.bites) strip = {.bites = true, .q = lag_, .r = slot_};
    });
  }
}

/// Elements that are cut give what they held, and the hand pays the rest (Griffith). Spread over the way to come.
void BladeEdge::share_released(const BladeLinks& links, double dt) noexcept {
  double slid = 0, full = 0;
  for (BladeStrip& strip : strips_) {
    const double resists = strip.bites ? resistance(strip) : 0.0;
    full += resists, slid += resists * strip.slid_before;
  }
  if (!(full > 0)) return;
  const double comes = BladeStrips::evened_part(slid / full, links.spacing(), dt) * coming_;
  coming_ -= comes;
  purse_ += comes;
  from_tissue_ = std::clamp(purse_ / (full * paid_in * links.spacing()), 0.0, most_from_tissue);
}

/// How softly what they hold gives way in a step: g.
void BladeEdge::soften(BladeLinks& links, double dt) noexcept {
  const double k = borne_ * hold();
  const std::span<BladeLinks::Node> nodes = links.nodes();
  for (BladeStrip& strip : strips_) strip.softness = 0;
  strips_.each_held(
      links, &BladeLinks::Link::now,
      [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
        nodes[link.a].pull += w / strip.weight * (1 - at.t) * k * strip.cover;
        nodes[link.b].pull += w / strip.weight * at.t * k * strip.cover;
      });
  links.give_way_to_pulls();
  strips_.each_held(
      links, &BladeLinks::Link::now,
      [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
        const BladeLinks::Node &a = nodes[link.a], &b = nodes[link.b];
        strip.softness += dt * dt * w / strip.weight * ((1 - at.t) * a.gives + at.t * b.gives);
      });
}

/// What all strips press with when the blade is there, ahead [N].
double BladeEdge::hold_ahead(double q) const noexcept {
  double sum = 0;
  for (const BladeStrip& strip : strips_)
    if (strip.bites) sum += std::clamp(hold_of(strip) * (q - strip.q), 0.0, most_force(strip));
  return sum;
}

/// Where the blade is in balance between strips, strands and hand. Ahead by halving, as the sum has a corner for each.
void BladeEdge::find_blade(const BladeStrands& strands, double dt) noexcept {
  lag_ = aside_ = 0;
  double low = strands.lowest(), across = 0, held = 0;
  for (const BladeStrip& strip : strips_) {
    if (!strip.bites) continue;
    low = std::min(low, strip.q);
    const double k = hold_of(strip);
    across += k * strip.r, held += k;
  }
  if (held > 0) aside_ = across / (stiffness_ + held);
  // What tough tissue held lets go of at once. Deviation: the blade has no mass, and would be beyond what lies between.
  double high = std::min(0.0, std::max(lag_before_, low) + fastest_ * dt);
  for (int n = 0; n < 50 && low < high; ++n) {
    const double middle = 0.5 * (low + high);
    const double force = borne_ * (hold_ahead(middle) + strands.hold_ahead(middle));
    (force < -stiffness_ * middle ? low : high) = middle;
  }
  lag_ = 0.5 * (low + high);
}

/// The force of a strip, and how far it has to go on for that.
void BladeEdge::slide(BladeStrip& strip, bool through, BladeOutcome& done) const noexcept {
  strip.ahead = strip.across = 0;
  if (!strip.bites || strip.cover == 0) return;
  const double k = hold_of(strip), most = most_force(strip);
  strip.ahead = std::max(0.0, k * (lag_ - strip.q));
  strip.across = k * (aside_ - strip.r);
  if (strip.ahead <= most && !through) return;
  const double on = through ? std::max(0.0, lag_ - strip.q) : lag_ - strip.q - most / k;
  strip.q += on;
  strip.slid += on;
  strip.ahead = through ? 0 : most;
  const double area = width_at_rest(strip) * on;
  strip.booked += area;
  done.area += area;
  done.work += most * on;
  done.released += from_tissue_ * resistance(strip) * on;
}

/// Puts the forces of the strips on the nodes that they hold.
void BladeEdge::press(BladeLinks& links, const BladeFrame& frame, double dt, BladeOutcome& done) noexcept {
  const std::span<BladeLinks::Node> nodes = links.nodes();
  strips_.each_held(
      links, &BladeLinks::Link::now,
      [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
        const Vec3 force =
            w / strip.weight * (borne_ * strip.ahead * frame.ahead + strip.across * frame.side);
        nodes[link.a].force += (1 - at.t) * force;
        nodes[link.b].force += at.t * force;
      });
  links.give_way_to_forces();
  for (BladeStrip& strip : strips_) strip.way.setZero();
  strips_.each_held(
      links, &BladeLinks::Link::now,
      [&](const BladeLinks::Link& link, const BladeLinks::Crossing& at, BladeStrip& strip, double w) {
        const BladeLinks::Node &a = nodes[link.a], &b = nodes[link.b];
        strip.way += dt * dt * w / strip.weight * at.between(a.gives_way, b.gives_way);
      });
  for (BladeStrip& strip : strips_) {
    if (!strip.bites) continue;
    const double p = strips_.middle(strip);
    strip.last_q = strip.q;
    strip.x = frame.tip + p * frame.along + strip.q * frame.ahead + strip.r * frame.side + strip.way;
  }
  for (const BladeLinks::Node& node : nodes) {
    done.force += node.force;
    done.moment += (node.x - frame.tip).cross(node.force);
    done.power += node.force.dot(node.v_before);
  }
}

BladeOutcome BladeEdge::advance(BladeLinks& links, BladeStrands& strands, const BladeFrame& frame, double dt,
                                std::vector<EdgeGone>& cuts, bool through) noexcept {
  BladeOutcome done;
  links.update(frame, place());
  strips_.follow(links, frame);
  touch(links, frame);
  lag_before_ = lag_;
  find_slot();
  links.cross(slot_);
  links.measure_sections(frame, slot_);
  strips_.weigh(links);
  strips_.carry(links, frame);
  strips_.compare_with_rest(links, dt);
  share_released(links, dt);
  soften(links, dt);
  strands.meet(frame, lag_before_, stiffness_, dt);
  if (through)
    lag_ = aside_ = 0;
  else
    find_blade(strands, dt);
  for (BladeStrip& strip : strips_) {
    slide(strip, through, done);
    done.thrust += strip.ahead;
  }
  strips_.go_on_uncovered(lag_, links.wall() > 0 ? links.spacing() : 0);
  purse_ -= done.released;
  press(links, frame, dt, done);
  strands.slide(frame, lag_, borne_, done);
  if (sharp_) cut(links, frame.side, through, cuts);
  if (through)  // they hold on to what is before them there
    for (BladeStrip& strip : strips_) strip.held_q = strip.q;
  links.remember();
  bites_ = std::ranges::any_of(strips_, [](const BladeStrip& strip) { return strip.bites; });
  before_ = frame;
  seen_ = true;
  return done;
}

/// All of the edge lies in one plane.
void BladeEdge::find_slot() noexcept {
  slot_ = 0;
  double n = 0;
  for (const BladeStrip& strip : strips_)
    if (strip.bites) slot_ += strip.r, n += 1;
  if (n > 0) slot_ /= n;
}

/// Elements that the edge has passed, and those that its body has come to lie in.
void BladeEdge::cut(BladeLinks& links, const Vec3& side, bool through, std::vector<EdgeGone>& cuts) noexcept {
  const std::array<float, 3> normal{static_cast<float>(side.x()), static_cast<float>(side.y()),
                                    static_cast<float>(side.z())};
  const double passed = through ? 0 : BladeStrips::passed_by * links.spacing(),
               behind = cut_behind * links.spacing();
  const std::span<const BladeLinks::Node> nodes = links.nodes();
  for (BladeLinks::Link& link : links.links()) {
    const BladeLinks::Crossing& at = link.now;
    if (!at.is || !strips_.is_along(at.p) || cuts.size() == cuts.capacity()) continue;
    const BladeStrip& strip = strips_.at(at.p);
    const bool has_come =
        strip.bites || strip.follows;  // or did before this step, and there is nothing ahead any more
    if (!has_come || at.q >= strip.q - passed || at.q < strip.q - behind - (through ? strip.slid : 0))
      continue;
    if (links.sever(link))
      cuts.push_back({nodes[link.a].cell, nodes[link.b].cell, {static_cast<float>(at.t), normal}});
  }
}

}  // namespace palpate::physics
