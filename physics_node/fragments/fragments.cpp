#include "physics_node/fragments/fragments.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace palpate::physics {

Fragments::Fragments(const MovingBody& moving) {
  const Lattice& lattice = moving.body().lattice;
  const auto n = static_cast<std::size_t>(lattice.n_cells());
  label_ = ZeroedArray<Index>(n);
  next_ = ZeroedArray<Index>(n, 1);
  front_of_ = ZeroedArray<Index>(n, 2);
  const auto n_masses = static_cast<std::size_t>(lattice.n_masses());
  masses_.reserve(n_masses);
  const auto most_breaks = std::min(FreshBreaks::most, static_cast<std::size_t>(lattice.n_elements()));
  seeds_.reserve(2 * most_breaks);
  fronts_.reserve(std::min(2 * most_breaks, n_masses));
  open_.reserve(fronts_.capacity());
  recompute(moving);
}

void Fragments::append(Chain& chain, Index cell) noexcept {
  next_[static_cast<std::size_t>(cell)] = 0;
  join(chain, {cell, cell});
}

void Fragments::join(Chain& chain, const Chain& other) noexcept {
  if (other.head == 0) return;
  if (chain.head == 0) {
    chain = other;
    return;
  }
  next_[static_cast<std::size_t>(chain.tail)] = other.head;
  chain.tail = other.tail;
}

void Fragments::reach(Index front, Index cell) noexcept {
  Front& f = fronts_[static_cast<std::size_t>(front)];
  front_of_[static_cast<std::size_t>(cell)] = front + 1;
  append(f.waiting, cell);
  ++f.masses;
}

bool Fragments::is_open(Index front) const noexcept {
  const Front& f = fronts_[static_cast<std::size_t>(front)];
  return f.parent == front && f.waiting.head != 0;
}

Index Fragments::root(Index front) noexcept {
  Index at = front;
  while (fronts_[static_cast<std::size_t>(at)].parent != at) {
    Index& parent = fronts_[static_cast<std::size_t>(at)].parent;
    parent = fronts_[static_cast<std::size_t>(parent)].parent;  // halves the path for those who come after
    at = parent;
  }
  return at;
}

Index Fragments::merge(Index a, Index b) noexcept {
  if (fronts_[static_cast<std::size_t>(a)].masses < fronts_[static_cast<std::size_t>(b)].masses)
    std::swap(a, b);
  Front& into = fronts_[static_cast<std::size_t>(a)];
  Front& from = fronts_[static_cast<std::size_t>(b)];
  join(into.waiting, from.waiting);
  join(into.done, from.done);
  into.masses += from.masses;
  from.waiting = from.done = {};
  from.parent = a;
  --growing_;
  return a;
}

Index Fragments::grow(Index front, const MovingBody& moving) noexcept {
  Chain& waiting = fronts_[static_cast<std::size_t>(front)].waiting;
  const Index cell = waiting.head;
  waiting.head = next_[static_cast<std::size_t>(cell)];
  append(fronts_[static_cast<std::size_t>(front)].done, cell);
  const Lattice& lattice = moving.body().lattice;
  const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
  for (Mask left = moving.masks()[static_cast<std::size_t>(cell)]; left != 0; left &= left - 1) {
    const Index other = cell + offset[static_cast<std::size_t>(std::countr_zero(left))];
    const Index theirs = front_of_[static_cast<std::size_t>(other)];
    if (theirs == 0) {
      reach(front, other);
    } else if (const Index met = root(theirs - 1); met != front) {
      front = merge(front, met);
    }
  }
  return front;
}

void Fragments::close(Index front) noexcept {
  const Front& f = fronts_[static_cast<std::size_t>(front)];
  const Index old = label(f.done.head);
  masses_.push_back(f.masses);
  masses_[static_cast<std::size_t>(old)] -= f.masses;
  for (Index cell = f.done.head; cell != 0; cell = next_[static_cast<std::size_t>(cell)])
    label_[static_cast<std::size_t>(cell)] = count();
  --growing_;
}

void Fragments::forget(const Chain& chain) noexcept {
  for (Index cell = chain.head; cell != 0; cell = next_[static_cast<std::size_t>(cell)])
    front_of_[static_cast<std::size_t>(cell)] = 0;
}

void Fragments::split(std::size_t first_seed, std::size_t last_seed, const MovingBody& moving) noexcept {
  fronts_.clear();
  open_.clear();
  for (std::size_t s = first_seed; s < last_seed; ++s) {
    const Index cell = seeds_[s].cell;
    if (front_of_[static_cast<std::size_t>(cell)] != 0) continue;  // an end of two elements that broke
    const auto front = static_cast<Index>(fronts_.size());
    fronts_.push_back({});
    fronts_.back().parent = front;
    open_.push_back(front);
    reach(front, cell);
  }
  growing_ = open_.size();
  for (std::size_t n = 0; growing_ > 1; n = n + 1 < open_.size() ? n + 1 : 0) {
    if (is_open(open_[n])) {
      const Index front = grow(open_[n], moving);
      // The last one is what remains, whether it has been followed to its end or not.
      if (growing_ > 1 && !is_open(front)) close(front);
    }
    if (is_open(open_[n])) continue;
    open_[n] = open_.back();
    open_.pop_back();
  }
  for (const Front& front : fronts_) {
    forget(front.waiting);
    forget(front.done);
  }
}

void Fragments::update(const MovingBody& moving) noexcept {
  if (moving.fresh_overflow()) return recompute(moving);
  if (moving.fresh_breaks().empty()) return;
  seeds_.clear();
  for (const Break& broken : moving.fresh_breaks())
    for (const Index cell : {broken.first, broken.other}) seeds_.push_back({label(cell), cell});
  std::sort(seeds_.begin(), seeds_.end(), [](const Seed& a, const Seed& b) {
    return std::tie(a.label, a.cell) < std::tie(b.label, b.cell);
  });
  for (std::size_t first = 0, last = 0; first < seeds_.size(); first = last) {
    while (last < seeds_.size() && seeds_[last].label == seeds_[first].label) ++last;
    split(first, last, moving);
  }
}

void Fragments::recompute(const MovingBody& moving) noexcept {
  const Lattice& lattice = moving.body().lattice;
  masses_.clear();
  for (const Index cell : lattice.masses) label_[static_cast<std::size_t>(cell)] = 0;
  for (const Index start : lattice.masses) {
    if (label_[static_cast<std::size_t>(start)] != 0) continue;
    masses_.push_back(0);
    Chain reached;
    const auto take = [&](Index cell) {
      label_[static_cast<std::size_t>(cell)] = count();
      append(reached, cell);
      ++masses_.back();
    };
    take(start);
    for (Index cell = start; cell != 0; cell = next_[static_cast<std::size_t>(cell)]) {
      const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
      for (Mask left = moving.masks()[static_cast<std::size_t>(cell)]; left != 0; left &= left - 1) {
        const Index other = cell + offset[static_cast<std::size_t>(std::countr_zero(left))];
        if (label_[static_cast<std::size_t>(other)] == 0) take(other);
      }
    }
  }
}

}  // namespace palpate::physics
