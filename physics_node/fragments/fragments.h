#pragma once
// Which masses of a body still hang together.

#include <cstdint>
#include <vector>

#include "physics_node/step/topology.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

/// Connected components of the live elements; a mass without any is a fragment of its own (EQUATIONS C-8). A node of
/// tetrahedra that splits was joined to its copy before.
///
/// After a step only the neighbourhood of what broke is looked at. The ends of the elements that broke begin fronts, which grow
/// breadth-first, one mass each in turn; fronts that meet are one from then on (union-find). A front need not grow while each
/// broken element at it joins it to itself: what was one fragment is one as long as all ends find each other. A front that has
/// nowhere left to grow is a complete fragment and takes a new label; through it its neighbours hung together, so those must now
/// find each other. Without that, when the middle of A-B-C comes off at both ends in one step, A and C would be left with one label.
/// Source: Even & Shiloach 1981, on-line edge deletion, for searches that alternate and end with the smaller side.
/// Cost: follows the size of what comes off and the way round each break; a mass is visited at most once a step.
/// Memory: 12 bytes a storage cell, touched where there are masses. Contract: after construction nothing allocates or throws.
class Fragments {
 public:
  explicit Fragments(const Topology& moving);

  /// To be called after every step in which elements may have broken, and after the state was replaced.
  void update(const Topology& moving) noexcept;
  /// From nothing, by a flood over all masses. Labels then count in storage order.
  void recompute(const Topology& moving) noexcept;

  Index count() const noexcept { return static_cast<Index>(masses_.size()); }
  /// Of the fragment that a mass belongs to, in [0, count()); -1 in an empty cell.
  Index label(Index cell) const noexcept { return label_[static_cast<std::size_t>(cell + shift_)] - 1; }
  /// Masses of each fragment  (count)
  const std::vector<Index>& masses() const noexcept { return masses_; }

 private:
  /// A chain of storage cells through next_. Cell 0 is halo and never has a mass: it ends a chain. Of a mesh, whose first
  /// node is 0, all are counted from 1 on inside.
  struct Chain {
    Index head = 0, tail = 0;
  };
  struct Front {
    Chain waiting;       // masses reached
    Chain done;          // masses whose neighbours have been looked at
    Index masses = 0;    // of both
    Index parent = 0;    // itself, or a front that it has become part of
    Index links = none;  // first of its half links
    bool takes_turns = false;
  };
  /// One end of a link: fronts that a broken element joined and that must find each other. Half links 2 n and 2 n + 1 are one link;
  /// each is in the list of its own front.
  struct HalfLink {
    Index target;  // front at the other end
    Index next;    // in the list, none at its end
  };
  static constexpr Index none = -1;

  void append(Chain& chain, Index cell) noexcept;
  void join(Chain& chain, const Chain& other) noexcept;
  Index front_at(Index cell) noexcept;  // begins one where there is none
  void reach(Index front, Index cell) noexcept;
  void link(Index first, Index second) noexcept;
  void add_half_link(Index front, Index half_link) noexcept;
  void take_turns(Index front) noexcept;
  Index root(Index front) noexcept;
  Index merge(Index a, Index b) noexcept;
  /// Do all its links lead to itself? Forgets those that do.
  bool is_settled(Index front) noexcept;
  /// Looks at the neighbours of the next mass that a front has reached. @return the front that it is part of now
  Index grow(Index front, const Topology& moving) noexcept;
  void close(Index front) noexcept;
  void forget(const Chain& chain) noexcept;

  Index shift_ = 0;
  ZeroedArray<Index> label_;     // 1 + label; 0: empty          (n_cells)
  ZeroedArray<Index> next_;      // in a chain                   (n_cells)
  ZeroedArray<Index> front_of_;  // 1 + front; 0: not reached    (n_cells)
  std::vector<Index> masses_;    // by label
  std::vector<Front> fronts_;
  std::vector<HalfLink> links_;
  std::vector<Index> turns_;  // fronts that grow in turn
};

}  // namespace palpate::physics
