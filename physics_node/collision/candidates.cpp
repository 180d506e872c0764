#include "physics_node/collision/candidates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace palpate::physics {
namespace {

/// Elements of a mass deep inside the lattice: 12; on voxels 18 of an even mass and 6 of an odd one.
int complete_count(const Lattice& lattice, Index cell) {
  if (lattice.kind == LatticeKind::fcc) return 12;
  return (lattice.grid_of(cell).sum() & 1) == 0 ? 18 : 6;
}

/// Does space reach this mass although it may lack no element? On fcc where a mass is missing across one of the six octahedra
/// that it is a corner of, on voxels where one of its eight cells is.
bool lies_open(const Lattice& lattice, Index cell) {
  if (lattice.kind != LatticeKind::fcc) return lattice.mass_share[static_cast<std::size_t>(cell)] < 1;
  const Vec3i grid = lattice.grid_of(cell);
  for (int axis = 0; axis < 3; ++axis)
    for (const int by : {-2, 2})
      if (lattice.mass_at(grid + by * Vec3i::Unit(axis)) < 0) return true;
  return false;
}

}  // namespace

bool Candidates::is_candidate(Index cell, Mask live) const {
  const Lattice& lattice = moving_->body().lattice;
  return std::popcount(live) < complete_count(lattice, cell) || (with_front_ && lies_open(lattice, cell));
}

Candidates::Candidates(const BodyModel& moving, bool with_front) : moving_(&moving), with_front_(with_front) {
  const Lattice& lattice = moving.body().lattice;
  length_ = lattice.spacing();
  longest_element_ = 1.01 * *std::max_element(lattice.rest_length.begin(), lattice.rest_length.end());
  number_.assign(static_cast<std::size_t>(lattice.n_cells()), -1);
  most_ = lattice.masses.size();
  if (!any_yields(moving.body())) {
    const auto at_start = [&](Index cell) {
      return is_candidate(cell, lattice.mask[static_cast<std::size_t>(cell)]);
    };
    most_ = static_cast<std::size_t>(std::count_if(lattice.masses.begin(), lattice.masses.end(), at_start));
  }
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
  rest_.push_back(body.lattice.rest_position(cell));
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
  const Lattice& lattice = moving_->body().lattice;
  for (const Index cell : lattice.masses)
    if (is_candidate(cell, moving_->mask(cell))) add(cell);
  if (!with_front_ || moving_->breaks() == 0) return;
  for (const Index cell : lattice.masses)
    if (moving_->mask(cell) != lattice.mask[static_cast<std::size_t>(cell)]) add_front(cell);
}

void Candidates::add_front(Index cell) noexcept {
  const Lattice& lattice = moving_->body().lattice;
  const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
  for (Mask mask = moving_->mask(cell); mask != 0; mask &= mask - 1)
    add(cell + offset[static_cast<std::size_t>(std::countr_zero(mask))]);
}

void Candidates::follow(std::span<const Break> breaks) noexcept {
  for (const Break& b : breaks) {
    add(b.first), add(b.other);
    if (with_front_) add_front(b.first), add_front(b.other);
  }
}

bool Candidates::refresh(double dt, std::span<const std::uint32_t> which) noexcept {
  for (const std::uint32_t n : which) last_x_[n] = x_[n];
  moving_->read(which, cell_, rest_, dt, x_, v_, v_move_);
  double sum = 0, farthest = 0;
  for (const std::uint32_t n : which) {
    if (inverse_mass_[n] == 0) v_[n] = v_move_[n];  // a hand leads it, whatever the elements do
    sum += 0.0 * (x_[n].sum() + v_[n].sum());
    farthest = std::max(farthest, (x_[n] - last_x_[n]).squaredNorm());
  }
  moved_ = std::sqrt(farthest);
  return sum == 0;
}

bool Candidates::are_joined(std::size_t a, std::size_t b) const noexcept {
  if ((rest_[a] - rest_[b]).squaredNorm() > longest_element_ * longest_element_) return false;
  const Lattice& lattice = moving_->body().lattice;
  const Index cell = cell_[a];
  const Index away = cell_[b] - cell;
  const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
  Mask mask = moving_->mask(cell);
  for (; mask != 0; mask &= mask - 1)
    if (offset[static_cast<std::size_t>(std::countr_zero(mask))] == away) return true;
  return false;
}

}  // namespace palpate::physics
