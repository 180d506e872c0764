#pragma once
// What could touch soon: for each two bodies that are near, and for each body with its own fragments, a list of pairs within
// reach plus a skin, made anew only when something there has used up its skin or broke. Until then a step
// looks at these pairs and at nothing else, and at each of them only when enough has been travelled for it
// to touch. A mass that is fast against the others of its body is given a wider skin, and it alone.
// Source: Verlet 1967 (neighbour lists with a skin).

#include "physics_node/collision/motion_mark.h"
#include "physics_node/collision/pair_search.h"

namespace palpate::physics {

enum class PairKind { masses, facets, both };

/// Two bodies, or one with itself.
struct Link {
  std::uint32_t a = 0, b = 0;  // a <= b
  bool near = false;           // they may touch in this frame
  bool fresh = false;          // the lists are what they should be
  MotionMark of_a, of_b;       // since the lists were made
  double steps_ahead = 0;      // for which the lists give fast masses their way, besides one
  double closing = 0;          // speed of the two bodies as wholes against each other [m/s]
  double between = 0;          // given to the two as wholes [m]
  double slack = 0;   // when all were read last, how far they could still move until the list is too old [m]
  double unseen = 0;  // what they may have moved since [m]
  double travel = 0;  // by which a mass may have come nearer to a facet since the lists were made [m]
  PairList masses, facets;
};

class NearPairs {
 public:
  /// @param solved  steps are solved: any mass may take the speed of the fastest of its body
  NearPairs(const std::vector<ContactBody>& bodies, PairKind kind, bool solved = false);

  /// Which bodies may touch which, this frame; a body beside itself: its fragments.
  void allow(std::uint32_t a, std::uint32_t b, bool near) noexcept;

  /// Nothing is listed, and all is as it was when this was made.
  void restart() noexcept;

  /// Must all candidates be read in this step? Else those in the lists are enough: whatever else there is cannot have come
  /// within reach since all were read last. @param fastest  no mass of any body moves faster [m/s]
  bool needs_all(const std::vector<ContactBody>& bodies, double fastest, double dt) noexcept;
  /// After all were read: brings the lists up to date.
  void update(std::vector<ContactBody>& bodies, double dt) noexcept;
  /// After those in the lists were read: takes note of how far they moved.
  void follow(std::vector<ContactBody>& bodies) noexcept;

  /// Do the lists hold whatever a candidate could touch in this step, if it has this speed?
  bool hold(const std::vector<ContactBody>& bodies, PairEnd at, double speed, double dt) const noexcept;
  /// Makes them anew for candidates with these speeds, by body; only where all were read in this step, else
  /// false and nothing.
  bool widen(std::vector<ContactBody>& bodies, std::span<const std::span<const double>> speeds,
             double dt) noexcept;

  std::vector<Link>& links() { return links_; }
  const std::vector<Link>& links() const { return links_; }
  std::size_t size() const noexcept;  // of all lists
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t overflows() const noexcept;                  // pairs that found no room
  std::size_t most_facets() const { return most_facets_; }  // pairs that there can be
  std::size_t most_pairs() const noexcept;                  // of both kinds

 private:
  double skin(const std::vector<ContactBody>& bodies, const Link& link) const noexcept;  // [m]
  double needed() const noexcept { return kind_ == PairKind::masses ? 0 : speed_gain; }
  double measure_slack(const std::vector<ContactBody>& bodies, Link& link, double dt) const noexcept;
  void list_all_ends(std::vector<ContactBody>& bodies) const noexcept;
  double closing_gain() const noexcept { return solved_ ? speed_gain : 1; }
  void rebuild(const std::vector<ContactBody>& bodies, Link& link, double dt,
               std::span<const std::span<const double>> expected) noexcept;

  // Why: a light mass that a heavy one hits goes on at twice its speed.
  static constexpr double speed_gain = 2;

  std::size_t n_bodies_;
  PairKind kind_;
  bool solved_;
  bool all_read_ = false;  // in this step
  PairSearch search_;
  std::vector<Link> links_;  // (0, 0), (0, 1) ... (1, 1) ...
  std::size_t most_facets_ = 0;
  std::int64_t rebuilds_ = 0;
};

}  // namespace palpate::physics
