#include "physics_node/collision/candidates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palpate::physics {
Candidates::Candidates(const BodyModel& moving, bool with_front)
    : moving_(&moving), exposed_(moving.body(), with_front), with_front_(with_front) {
  const Body& body = moving.body();
  length_ = body.spacing();
  longest_element_ = 1.01 * body.longest_element();
  number_.assign(static_cast<std::size_t>(body.capacity()), -1);
  most_ = body.nodes().size() + body.most_copies();
  if (!may_come_apart(body))
    most_ = static_cast<std::size_t>(std::count_if(body.nodes().begin(), body.nodes().end(), [&](Index node) {
      return exposed_.contains(node, body.adjacency());
    }));
  cell_.reserve(most_);
  rest_.reserve(most_);
  inverse_mass_.reserve(most_);
  x_.reserve(most_);
  last_x_.reserve(most_);
  all_.resize(most_);
  std::iota(all_.begin(), all_.end(), 0U);
  v_.reserve(most_);
  v_move_.reserve(most_);
  restart();
}

void Candidates::add(Index cell) noexcept {
  std::int32_t& number = number_[static_cast<std::size_t>(cell)];
  if (number >= 0 || cell_.size() == most_) return;
  const Body& body = moving_->body();
  number = static_cast<std::int32_t>(cell_.size());
  cell_.push_back(cell);
  rest_.push_back(body.rest_position(cell));
  const bool driven = std::binary_search(body.handle.begin(), body.handle.end(), cell);
  inverse_mass_.push_back(driven ? 0.0 : body.inverse_mass[static_cast<std::size_t>(cell)]);
  x_.emplace_back(Vec3::Zero());
  last_x_.emplace_back(Vec3::Zero());
  v_.emplace_back(Vec3::Zero());
  v_move_.emplace_back(Vec3::Zero());
}

void Candidates::restart() noexcept {
  for (const Index cell : cell_) number_[static_cast<std::size_t>(cell)] = -1;
  cell_.clear(), rest_.clear(), inverse_mass_.clear();
  x_.clear(), last_x_.clear(), v_.clear(), v_move_.clear();
  const Adjacency& now = moving_->adjacency();
  const auto nodes = moving_->body().nodes();
  moving_->body().each_node([&](Index cell) {
    if (exposed_.contains(cell, now)) add(cell);
  });
  if (!with_front_ || moving_->breaks() == 0 || moving_->body().mesh) return;
  for (const Index cell : nodes)
    if (now.has_lost(cell)) add_front(cell);
}

void Candidates::add_front(Index cell) noexcept {
  moving_->adjacency().each_neighbour(cell, [this](Index other) { add(other); });
}

void Candidates::follow(const TopologyEvents& events) noexcept {
  for (const EdgeGone& gone : events.edges_gone) {
    add(gone.a), add(gone.b);
    if (with_front_) add_front(gone.a), add_front(gone.b);
  }
  for (const CellGone& gone : events.cells_gone)
    for (const Index corner : gone.corners) {
      add(corner);
      if (with_front_) add_front(corner);
    }
  for (const NodeSplit& split : events.nodes_split)
    for (const Index node : {split.node, split.copy}) add_sides(node);
}

/// Of a node that has split, and a copy: itself, and what it opens at the end of a cut. Both weigh less than before.
void Candidates::add_sides(Index node) noexcept {
  const Adjacency& now = moving_->adjacency();
  const auto add_open = [&](Index one) {
    if (exposed_.contains(one, now)) add(one);
  };
  add_open(node);
  now.each_neighbour(node, add_open);
  if (const std::int32_t n = at_cell(node); n >= 0)
    inverse_mass_[static_cast<std::size_t>(n)] = moving_->body().inverse_mass[static_cast<std::size_t>(node)];
}

bool Candidates::refresh(double dt, std::span<const std::uint32_t> which, const Vec3& shift) noexcept {
  for (const std::uint32_t n : which) last_x_[n] = x_[n];
  moving_->read(which, cell_, rest_, dt, x_, v_, v_move_);
  double sum = 0, farthest = 0;
  for (const std::uint32_t n : which) {
    if (inverse_mass_[n] == 0) v_[n] = v_move_[n];  // a hand leads it, whatever the elements do
    sum += 0.0 * (x_[n].sum() + v_[n].sum());
    farthest = std::max(farthest, (x_[n] - last_x_[n] - shift).squaredNorm());
  }
  moved_ = std::sqrt(farthest);
  return sum == 0;
}

bool Candidates::are_joined(std::size_t a, std::size_t b) const noexcept {
  if ((rest_[a] - rest_[b]).squaredNorm() > longest_element_ * longest_element_) return false;
  return moving_->adjacency().are_joined(cell_[a], cell_[b]);
}

}  // namespace palpate::physics
