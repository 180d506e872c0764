#include "physics_node/contact/blade_links.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

// In spacings.
constexpr double around_reach = 5;   // of what is listed now and then
constexpr double gather_around = 3;  // and of what is listed each frame, ahead of the edge and behind it
constexpr double across_reach = 2;   // Why: the longest element of a lattice is 1.5 spacings
constexpr double across_margin =
    0.3;  // Why: a step moves tissue by much less than that, a frame of 1 ms does, too
constexpr double settled_ahead = 1;  // farther ahead of the edge sides may change yet
constexpr double look_again_after = 1;
constexpr double tiny = 1e-6;
constexpr double look_again_s = 0.020;  // Why: tissue may come by itself

}  // namespace

BladeLinks::BladeLinks(const BodyModel& body, double length)
    : body_(&body), length_(length), h_(body.body().spacing()) {
  around_.reserve(body.body().nodes().size());
  number_.assign(static_cast<std::size_t>(body.body().capacity()), -1);
  side_.assign(number_.size(), 0);
  nodes_.reserve(most_nodes);
  links_.reserve(most_links);
}

void BladeLinks::look_around(const BladeFrame& frame, const EdgePlace& edge) noexcept {
  const double reach = around_reach * h_;
  around_.clear();
  for (const Index cell : body_->body().nodes()) {
    const Vec3 at = frame.coordinates(body_->position(cell));
    const Vec3 edge_there(std::clamp(at.x(), 0.0, length_), std::clamp(at.y(), edge.last, edge.lag),
                          edge.slot);
    if ((at - edge_there).squaredNorm() <= reach * reach)
      around_.push_back(cell);
    else
      side_[static_cast<std::size_t>(cell)] = 0;
  }
}

void BladeLinks::reset() noexcept {
  for (const Node& node : nodes_) number_[static_cast<std::size_t>(node.cell)] = -1;
  std::ranges::fill(side_, std::int8_t{0});
  when_ = -1e9;
  nodes_.clear();
  links_.clear();
}

void BladeLinks::settle_side(Node& node, const EdgePlace& edge) noexcept {
  std::int8_t& side = side_[static_cast<std::size_t>(node.cell)];
  if (!edge.bites || side == 0 || node.at.y() > edge.lag + settled_ahead * h_)
    side = node.at.z() >= edge.slot ? 1 : -1;
  node.side = side;
}

void BladeLinks::gather(const BladeFrame& frame, const EdgePlace& edge, double t) noexcept {
  const double s = edge.slot;
  const Vec3 tip = frame.tip + edge.lag * frame.ahead + s * frame.side, end = tip + length_ * frame.along;
  const double moved = std::max((tip - tip_).norm(), (end - end_).norm());
  if (moved > look_again_after * h_ || t - when_ >= look_again_s || t < when_) {
    look_around(frame, edge);
    tip_ = tip, end_ = end, when_ = t;
  }
  const double first = edge.last - gather_around * h_, last = edge.lag + gather_around * h_;
  for (const Node& node : nodes_) number_[static_cast<std::size_t>(node.cell)] = -1;
  nodes_.clear();
  links_.clear();
  const Body& body = body_->body();
  for (const Index cell : around_) {
    const Vec3 x = body_->position(cell), at = frame.coordinates(x);
    if (at.x() < -across_reach * h_ || at.x() > length_ + across_reach * h_) continue;
    if (at.y() < first || at.y() > last || std::abs(at.z() - s) > across_reach * h_) continue;
    if (nodes_.size() == most_nodes) break;
    number_[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({.cell = cell,
                      .inverse_mass = body.inverse_mass[static_cast<std::size_t>(cell)],
                      .toughness = law_at(body, cell).cut_toughness,
                      .rest = body.rest_position(cell),
                      .x = x,
                      .at = at});
    settle_side(nodes_.back(), edge);
  }
  const double margin = across_margin * h_;
  for (std::uint32_t a = 0; a < nodes_.size(); ++a)
    body_->adjacency().each_neighbour(nodes_[a].cell, [&](Index other) {
      const std::int32_t b = number_[static_cast<std::size_t>(other)];
      if (b <= static_cast<std::int32_t>(a) || links_.size() == most_links) return;
      const Node& second = nodes_[static_cast<std::size_t>(b)];
      const auto [low, high] = std::minmax(nodes_[a].at.z(), second.at.z());
      if (nodes_[a].side == second.side && (low > s + margin || high < s - margin)) return;
      links_.push_back({.a = a, .b = static_cast<std::uint32_t>(b)});
    });
  cross(s);
  remember();
}

void BladeLinks::remember() noexcept {
  for (Link& link : links_) link.before = link.now;
}

void BladeLinks::begin_step() noexcept {
  for (Node& node : nodes_) {
    node.x = body_->position(node.cell);
    node.v_before = body_->velocity(node.cell);
  }
}

void BladeLinks::update(const BladeFrame& frame, const EdgePlace& edge) noexcept {
  for (Node& node : nodes_) {
    const Vec3 x = body_->position(node.cell);
    node.way = x - node.x;
    node.x = x;
    node.at = frame.coordinates(x);
    settle_side(node, edge);
    node.force.setZero();
    node.pull = 0;
  }
  cross(edge.slot);
}

void BladeLinks::cross(double s) noexcept {
  for (Link& link : links_) {
    const Vec3 &a = nodes_[link.a].at, &b = nodes_[link.b].at;
    Crossing& now = link.now;
    now.is = link.lives && nodes_[link.a].side != nodes_[link.b].side;
    if (!now.is) continue;
    const double apart = b.z() - a.z();
    now.t = std::abs(apart) > tiny * h_ ? std::clamp((s - a.z()) / apart, 0.0, 1.0) : 0.5;
    now.p = a.x() + now.t * (b.x() - a.x());
    now.q = a.y() + now.t * (b.y() - a.y());
  }
}

}  // namespace palpate::physics
