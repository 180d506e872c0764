#pragma once
// What could touch soon: for each two bodies that are near, and for each body with its own fragments, a list of pairs within
// reach plus a skin, made anew only when something there moved by half the skin or broke. Until then a step looks at these
// pairs and at nothing else, and at each of them only when enough has been travelled for it to touch.
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
  double least_skin = 0;       // for what one step moves masses by [m]
  double slack = 0;   // when all were read last, how far they could still move until the list is too old [m]
  double unseen = 0;  // what they may have moved since [m]
  double travel = 0;  // by which a mass may have come nearer to a facet since the lists were made [m]
  PairList masses, facets;
};

class NearPairs {
 public:
  NearPairs(const std::vector<ContactBody>& bodies, PairKind kind);

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

  std::vector<Link>& links() { return links_; }
  const std::vector<Link>& links() const { return links_; }
  std::size_t size() const noexcept;  // of all lists
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t overflows() const noexcept;                  // pairs that found no room
  std::size_t most_facets() const { return most_facets_; }  // pairs that there can be
  std::size_t most_pairs() const noexcept;                  // of both kinds

 private:
  double skin(const std::vector<ContactBody>& bodies, const Link& link) const noexcept;  // [m]
  double needed_skin(double fastest, double dt) const noexcept;                          // for a step [m]
  double measure_slack(const std::vector<ContactBody>& bodies, Link& link) const noexcept;
  void list_all_ends(std::vector<ContactBody>& bodies) const noexcept;
  void rebuild(const std::vector<ContactBody>& bodies, Link& link) noexcept;

  std::size_t n_bodies_;
  PairKind kind_;
  PairSearch search_;
  std::vector<Link> links_;  // (0, 0), (0, 1) ... (1, 1) ...
  std::size_t most_facets_ = 0;
  std::int64_t rebuilds_ = 0;
};

/// What two masses may move towards each other in a step at most, where the fastest has this speed: a light one that a heavy
/// one hits goes on at twice its speed, and a little more is allowed for [m].
double most_motion(double dt, double speed) noexcept;

}  // namespace palpate::physics
