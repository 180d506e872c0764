#include "physics_node/contact/blade_strands.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace palpate::physics {
namespace {

constexpr double strands_around = 0.010;       // beside the edge and its way [m]
constexpr double strands_again_after = 0.004;  // [m]
constexpr double strands_again_s = 0.020;      // Why: tissue may come by itself
constexpr double strand_held_by =
    20;  // Why: as in springs (blade_edge.h): much stiffer than the hand's spring, however little of the edge is held
constexpr double least_hold =
    4;  // Why: times by how fast T falls behind a strand; with a softer hold the edge would jump in firm tissue

constexpr double held_by_edge =
    0.25;  // Why: of d; no more may tissue move a strand out of its cut or beyond an end of the edge
constexpr double flattest =
    3;  // Why: of ahead to across; a strand that lies nearly in the plane is not cut through by it

/// s / d of an edge that has cut such a share of a strand, whose T rises and falls alike.
double passed_by(double share) noexcept {
  return share <= 0.5 ? std::sqrt(2 * std::max(0.0, share)) : 2 - std::sqrt(2 * std::max(0.0, 1 - share));
}
/// And the share that it has cut.
double share_at(double passed) noexcept {
  return passed <= 1 ? 0.5 * passed * passed : 1 - 0.5 * (2 - passed) * (2 - passed);
}

double distance_to_edge(const Vec3& p, const Vec3& tip, const Vec3& end) noexcept {
  const Vec3 along = end - tip;
  const double t = std::clamp((p - tip).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (tip + t * along - p).norm();
}

}  // namespace

BladeStrands::BladeStrands(const Connections& connections, double length)
    : connections_(connections), length_(length), of_(connections.size()) {
  std::size_t n = 0;
  for (std::size_t c = 0; c < connections.size(); ++c) {
    const auto& strands = connections[c]->strands();
    OfConnection& of = of_[c];
    of.side.assign(strands.size(), Side::unknown);
    of.depth.assign(strands.size(), 0);
    of.pushes.reserve(strands.size());
    n += strands.size();
    std::unordered_map<Index, std::uint32_t> number;
    for (const Strand& strand : strands) {
      auto& feet = of.feet.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        feet[k] = number.try_emplace(strand.foot[k], static_cast<std::uint32_t>(number.size())).first->second;
    }
    of.pull.assign(number.size(), 0);
  }
  near_.reserve(n);
}

void BladeStrands::let_go() noexcept {
  for (const Near& near : near_) of_[near.connection].side[near.strand] = Side::unknown;
  near_.clear();
  clear_pushes();
  when_ = -1e9;
}

void BladeStrands::clear_pushes() noexcept {
  for (OfConnection& of : of_) of.pushes.clear();
}

void BladeStrands::gather(const BladeFrame& frame, double lag, double way, double t) noexcept {
  const Vec3 tip = frame.tip + lag * frame.ahead, end = tip + length_ * frame.along;
  const double moved = std::max((tip - tip_).norm(), (end - end_).norm());
  if (moved + way < strands_again_after && t - when_ < strands_again_s && t >= when_) return;
  tip_ = tip, end_ = end, when_ = t;
  look_around(strands_around + 2 * way);
}

void BladeStrands::look_around(double reach) noexcept {
  near_.clear();
  for (std::size_t c = 0; c < connections_.size(); ++c) {
    const auto& strands = connections_[c]->strands();
    for (std::size_t s = 0; s < strands.size(); ++s) {
      const double d = std::sqrt(strands[s].area);
      bool is_near = connections_[c]->holds(s);
      if (is_near) {
        const Connection::Ends at = connections_[c]->places(strands[s]);
        is_near = distance_to_edge(at.node, tip_, end_) < (at.foot - at.node).norm() + 3 * d + reach;
      }
      if (is_near)
        near_.push_back({.connection = c, .strand = s, .v_before = Connection::Ends{}, .d = d});
      else
        of_[c].side[s] = Side::unknown;
    }
  }
}

void BladeStrands::begin_step() noexcept {
  for (Near& near : near_) near.v_before = connection_of(near).velocities(strand_of(near));
}

/// A strand is the edge's once its patch has lain before the edge, in the plane; never what the edge comes to with
/// its back. Of a patch that it comes into from aside it goes through what lies before it, which is as tough as the
/// whole: nothing presses at once.
bool BladeStrands::follow(Near& near, const BladeFrame& frame, double lag) noexcept {
  const Connection& connection = connection_of(near);
  Side& side = of_[near.connection].side[near.strand];
  double& depth = of_[near.connection].depth[near.strand];
  const Connection::Ends ends = connection.places(strand_of(near));
  const Vec3 a = frame.coordinates(ends.node), b = frame.coordinates(ends.foot), w = b - a;
  const double left = connection.left(near.strand), aside = std::min(std::abs(a.z()), std::abs(b.z()));
  const bool crosses = (a.z() >= 0) != (b.z() >= 0);
  const double margin =
      side == Side::before ? held_by_edge * near.d : 0;  // so that none comes and goes with each step
  const bool reaches = crosses || (left < 1 && aside < margin);
  near.at = crosses ? a.z() / (a.z() - b.z()) : std::abs(a.z()) < std::abs(b.z()) ? 0.0 : 1.0;
  const Vec3 at = a + near.at * w;
  near.x = ends.node + near.at * (ends.foot - ends.node);
  near.passed = passed_by(1 - left);
  const bool is_along = at.x() >= -margin && at.x() <= length_ + margin;
  const bool is_flat = crosses && std::abs(w.y()) > flattest * std::abs(w.z());
  if (left <= 0 || !reaches || !is_along || is_flat) {
    side = Side::unknown;
    return false;
  }
  const double end = at.y() + near.d;
  if (side == Side::unknown) {
    side = at.y() >= lag ? Side::before : Side::behind;
    depth = std::min(near.d, (end - lag) / (2 - near.passed));
  }
  if (side == Side::behind && end - (2 - near.passed) * near.d >= lag) {
    side = Side::before;
    depth = near.d;
  }
  near.depth = depth;
  near.q = end - (2 - near.passed) * depth;
  near.push = frame.ahead;
  if (crosses) near.push -= w.y() / w.z() * frame.side;  // else it does not slide along the edge
  return side == Side::before;
}

void BladeStrands::meet(const BladeFrame& frame, double lag, double stiffness, double dt) noexcept {
  for (Near& near : near_) {
    near.bites = follow(near, frame, lag);
    if (!near.bites) continue;
    const double cut_work = strand_of(near).cut_work;
    near.pays = std::min(1.0, connection_of(near).stored_by_share(near.strand) / cut_work);
    near.most = (1 - near.pays) * cut_work / near.depth;
    near.k = std::max(strand_held_by * stiffness * near.d / length_, least_hold * near.most / near.depth);
  }
  soften(dt);
}

/// Force and strands are solved for together, as the masses at their ends are light: see blade_edge.h.
void BladeStrands::soften(double dt) noexcept {
  for (OfConnection& of : of_) std::ranges::fill(of.pull, 0);
  const auto each_foot = [&](const Near& near, const auto& visit) {
    OfConnection& of = of_[near.connection];
    const Strand& strand = strand_of(near);
    for (std::size_t c = 0; c < 3; ++c) visit(near.at * strand.share[c], of.pull[of.feet[near.strand][c]], c);
  };
  for (const Near& near : near_)
    if (near.bites && near.q < 0)
      each_foot(near, [&](double w, double& pull, std::size_t) { pull += w * near.k; });
  for (Near& near : near_) {
    if (!near.bites) continue;
    const Strand& strand = strand_of(near);
    const Connection& connection = connection_of(near);
    double gives = (1 - near.at) * (1 - near.at) * connection.inverse_mass_of_node(strand) * near.k;
    each_foot(near, [&](double w, double pull, std::size_t c) {
      gives += w * connection.inverse_mass_of_foot(strand, c) * std::max(pull, w * near.k);
    });
    near.k /= 1 + dt * dt * near.push.squaredNorm() * gives;
  }
}

/// Within a step T is the mean of what s goes through, which makes an equation of the second degree of it where s
/// passes the strand. Where the hold is softer than T falls, there is no answer behind the strand: it parts at once.
BladeStrands::Slide BladeStrands::slide_of(const Near& near, double q) noexcept {
  const double way = (q - near.q) / near.depth, k = near.k * near.depth, most = near.most, s = near.passed;
  if (!(way > 0)) return {};
  if (k * way <= most * std::min(s, 2 - s)) return {0, k * way};
  const Slide through{2 - s, most * (1 - share_at(s)) / way};  // what was left, over all of the way
  const double a = k - 0.5 * most;
  double on = 0;
  if (s < 1 && (on = (k * way - most * s) / (k + 0.5 * most)) <= 1 - s) return {on, k * (way - on)};
  if (!(a > 0)) return through;
  if (s < 1) {
    const double up = 1 - s, b = k * way - most * (1 + up);
    on = (b + std::sqrt(b * b + 4 * a * most * up * up)) / (2 * a);
  } else {
    on = (k * way - most * (2 - s)) / a;
  }
  return on < 2 - s ? Slide{on, k * (way - on)} : through;
}

double BladeStrands::hold_ahead(double q) const noexcept {
  double sum = 0;
  for (const Near& near : near_)
    if (near.bites) sum += slide_of(near, q).force;
  return sum;
}

double BladeStrands::lowest() const noexcept {
  double low = 0;
  for (const Near& near : near_)
    if (near.bites) low = std::min(low, near.q);
  return low;
}

double BladeStrands::held() const noexcept {
  double sum = 0;
  for (const Near& near : near_)
    if (near.bites && near.q < 0) sum += near.k;
  return sum;
}

std::size_t BladeStrands::n_pushes() const noexcept {
  std::size_t n = 0;
  for (const OfConnection& of : of_) n += of.pushes.size();
  return n;
}

void BladeStrands::slide(const BladeFrame& frame, double lag, double borne, BladeOutcome& done) noexcept {
  for (const Near& near : near_) {
    if (!near.bites) continue;
    const Slide slide = slide_of(near, lag);
    if (slide.force == 0 && slide.on == 0) continue;
    const bool through = near.passed + slide.on >= 2;
    const double left = connection_of(near).left(near.strand);
    const double share = through ? left : std::min(left, share_at(near.passed + slide.on) - (1 - left));
    const Strand& strand = strand_of(near);
    const double takes = std::max(0.0, share) * strand.cut_work;
    const Vec3 force = borne * slide.force * near.push;
    of_[near.connection].pushes.push_back({near.strand, near.at, force, std::max(0.0, share)});
    done.area += std::max(0.0, share) * strand.area;
    done.work += (1 - near.pays) * takes;
    done.released += near.pays * takes;
    done.force += force;
    done.thrust += slide.force;
    done.moment += (near.x - frame.tip).cross(force);
    done.power += force.dot((1 - near.at) * near.v_before.node + near.at * near.v_before.foot);
  }
}

}  // namespace palpate::physics
