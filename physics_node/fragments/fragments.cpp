#include "physics_node/fragments/fragments.h"

#include <algorithm>
#include <utility>

namespace palpate::physics {

Fragments::Fragments(const Topology& moving) {
  const Body& body = moving.body();
  if (body.mesh) shift_ = 1;
  const auto n = static_cast<std::size_t>(body.capacity() + shift_);
  label_ = ZeroedArray<Index>(n);
  next_ = ZeroedArray<Index>(n, 1);
  front_of_ = ZeroedArray<Index>(n, 2);
  const auto n_masses = static_cast<std::size_t>(body.n_nodes()) + body.most_copies();
  masses_.reserve(n_masses);
  const std::size_t elements_gone =
      any_breaks(body) && !body.mesh
          ? std::min(TopologyEvents::most, static_cast<std::size_t>(body.n_elements()))
          : 0;
  const std::size_t most_breaks = elements_gone + body.most_copies();
  fronts_.reserve(std::min(2 * most_breaks, n_masses));
  turns_.reserve(fronts_.capacity());
  links_.reserve(2 * most_breaks);
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

Index Fragments::front_at(Index cell) noexcept {
  if (const Index known = front_of_[static_cast<std::size_t>(cell)]; known != 0) return known - 1;
  const auto front = static_cast<Index>(fronts_.size());
  fronts_.push_back({});
  fronts_.back().parent = front;
  reach(front, cell);
  take_turns(front);
  return front;
}

void Fragments::reach(Index front, Index cell) noexcept {
  Front& f = fronts_[static_cast<std::size_t>(front)];
  front_of_[static_cast<std::size_t>(cell)] = front + 1;
  append(f.waiting, cell);
  ++f.masses;
}

void Fragments::add_half_link(Index front, Index half_link) noexcept {
  Front& f = fronts_[static_cast<std::size_t>(front)];
  links_[static_cast<std::size_t>(half_link)].next = f.links;
  f.links = half_link;
}

void Fragments::take_turns(Index front) noexcept {
  Front& f = fronts_[static_cast<std::size_t>(front)];
  if (f.takes_turns) return;
  f.takes_turns = true;
  turns_.push_back(front);
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
  for (Index h = from.links; h != none;) {
    const Index next = links_[static_cast<std::size_t>(h)].next;
    if (root(links_[static_cast<std::size_t>(h)].target) != a) add_half_link(a, h);
    h = next;
  }
  from.links = none;
  return a;
}

bool Fragments::is_settled(Index front) noexcept {
  Index& first = fronts_[static_cast<std::size_t>(front)].links;
  while (first != none && root(links_[static_cast<std::size_t>(first)].target) == front)
    first = links_[static_cast<std::size_t>(first)].next;
  return first == none;
}

Index Fragments::grow(Index front, const Topology& moving) noexcept {
  Chain& waiting = fronts_[static_cast<std::size_t>(front)].waiting;
  const Index cell = waiting.head;
  waiting.head = next_[static_cast<std::size_t>(cell)];
  append(fronts_[static_cast<std::size_t>(front)].done, cell);
  moving.adjacency().each_neighbour(cell - shift_, [&](Index neighbour) {
    const Index other = neighbour + shift_;
    const Index theirs = front_of_[static_cast<std::size_t>(other)];
    if (theirs == 0) {
      reach(front, other);
    } else if (const Index met = root(theirs - 1); met != front) {
      front = merge(front, met);
    }
  });
  return front;
}

void Fragments::close(Index front) noexcept {
  Front& f = fronts_[static_cast<std::size_t>(front)];
  const Index old = label(f.done.head - shift_);
  masses_.push_back(f.masses);
  masses_[static_cast<std::size_t>(old)] -= f.masses;
  for (Index cell = f.done.head; cell != 0; cell = next_[static_cast<std::size_t>(cell)])
    label_[static_cast<std::size_t>(cell)] = count();
  // Links to neighbours t_1, t_2 ... t_k become links t_1 to t_2, t_2 to t_3 ..., and the last leads nowhere.
  Index last = none;
  for (Index h = std::exchange(f.links, none); h != none;) {
    const HalfLink here = links_[static_cast<std::size_t>(h)];
    const Index neighbour = root(here.target);
    if (neighbour != front) {
      if (last != none) {
        links_[static_cast<std::size_t>(last ^ 1)].target = neighbour;
        add_half_link(neighbour, last);
        take_turns(neighbour);
        take_turns(root(links_[static_cast<std::size_t>(last)].target));
      }
      last = h;
    }
    h = here.next;
  }
  if (last != none)
    links_[static_cast<std::size_t>(last ^ 1)].target = links_[static_cast<std::size_t>(last)].target;
}

void Fragments::forget(const Chain& chain) noexcept {
  for (Index cell = chain.head; cell != 0; cell = next_[static_cast<std::size_t>(cell)])
    front_of_[static_cast<std::size_t>(cell)] = 0;
}

/// They were joined before, and must find each other.
void Fragments::link(Index first, Index second) noexcept {
  const Index a = front_at(first + shift_), b = front_at(second + shift_);
  const auto half_link = static_cast<Index>(links_.size());
  links_.push_back({b, none});
  links_.push_back({a, none});
  add_half_link(a, half_link);
  add_half_link(b, half_link + 1);
}

void Fragments::update(const Topology& moving) noexcept {
  const TopologyEvents events = moving.events();
  if (events.overflow) return recompute(moving);
  if (events.none()) return;
  fronts_.clear();
  links_.clear();
  turns_.clear();
  for (const NodeSplit& split : events.nodes_split) {
    label_[static_cast<std::size_t>(split.copy + shift_)] = label(split.node) + 1;
    ++masses_[static_cast<std::size_t>(label(split.copy))];
  }
  for (const EdgeGone& gone : events.edges_gone) link(gone.a, gone.b);
  for (const NodeSplit& split : events.nodes_split) link(split.node, split.copy);
  for (std::size_t n = 0; !turns_.empty(); n = n + 1 < turns_.size() ? n + 1 : 0) {
    const Index mine = turns_[n];
    if (root(mine) == mine && !is_settled(mine)) {
      const Index front = grow(mine, moving);
      take_turns(front);
      if (fronts_[static_cast<std::size_t>(front)].waiting.head == 0 && !is_settled(front)) close(front);
      if (front == mine && !is_settled(mine)) continue;
    }
    fronts_[static_cast<std::size_t>(mine)].takes_turns = false;
    turns_[n] = turns_.back();
    turns_.pop_back();
  }
  for (const Front& front : fronts_) {
    forget(front.waiting);
    forget(front.done);
  }
}

void Fragments::recompute(const Topology& moving) noexcept {
  const Body& body = moving.body();
  masses_.clear();
  body.each_node([this](Index cell) { label_[static_cast<std::size_t>(cell + shift_)] = 0; });
  body.each_node([&](Index node) {
    const Index start = node + shift_;
    if (label_[static_cast<std::size_t>(start)] != 0) return;
    masses_.push_back(0);
    Chain reached;
    const auto take = [&](Index cell) {
      label_[static_cast<std::size_t>(cell)] = count();
      append(reached, cell);
      ++masses_.back();
    };
    take(start);
    for (Index cell = start; cell != 0; cell = next_[static_cast<std::size_t>(cell)])
      moving.adjacency().each_neighbour(cell - shift_, [&](Index other) {
        if (label_[static_cast<std::size_t>(other + shift_)] == 0) take(other + shift_);
      });
  });
}

}  // namespace palpate::physics
