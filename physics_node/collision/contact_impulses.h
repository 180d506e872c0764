#pragma once
// What contact does to the masses in one step, and what it has done to each body since somebody asked.

#include <vector>

#include "physics_node/collision/contact_sum.h"
#include "physics_node/collision/pair_search.h"

namespace palpate::physics {

/// Impulses that a body took from others, summed.
struct BodyImpulse {
  Vec3 linear = Vec3::Zero();   // [N s]
  Vec3 angular = Vec3::Zero();  // about the origin [N m s]
  Mat6 spread = Mat6::Zero();   // about the origin; only of bodies that somebody feels
  std::uint32_t masses = 0;     // that took any
  /// The same as a moment about a point. (EQUATIONS C-15)
  Vec3 about(const Vec3& p) const { return angular - p.cross(linear); }
  ContactSum sum_about(const Vec3& p) const;
};

class ContactImpulses {
 public:
  explicit ContactImpulses(const std::vector<ContactBody>& bodies);

  /// Somebody feels this body: the spread of its impulses is summed too.
  void feel(std::uint32_t b) noexcept { felt_[b] = 1; }

  void begin_step() noexcept;
  /// Velocity with the impulses of this step [m/s].
  Vec3 v(const std::vector<ContactBody>& bodies, PairEnd at) const noexcept {
    return bodies[at.body].candidates().v()[at.n] + dv_[first_[at.body] + at.n];
  }
  /// The same of the velocity that moves the mass: with velocity_verlet another.
  Vec3 v_move(const std::vector<ContactBody>& bodies, PairEnd at) const noexcept {
    return bodies[at.body].candidates().v_move()[at.n] + dv_[first_[at.body] + at.n];
  }
  /// An impulse J on a mass. One that is held or driven keeps its velocity, and its hand does work -J . v. [J]
  void push(const std::vector<ContactBody>& bodies, PairEnd at, const Vec3& J) noexcept;
  /// Makes the change of its velocity in this step dv. @return the impulse that this takes [N s]
  Vec3 set_change(const std::vector<ContactBody>& bodies, PairEnd at, const Vec3& dv) noexcept;

  /// Calls visit(end, dv) for the masses touched in this step.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const PairEnd& at : touched_) visit(at, dv_[first_[at.body] + at.n]);
  }
  bool any() const { return !touched_.empty(); }

  double driven_work() const { return driven_work_; }  // of this step, by hands that drive masses [J]
  /// What body b took since the last call.
  BodyImpulse take(std::uint32_t b) noexcept;

 private:
  void touch(PairEnd at) noexcept;

  std::vector<std::uint32_t> first_;  // by body, of its candidates
  std::vector<Vec3> dv_;              // by candidate [m/s]
  std::vector<std::uint8_t> is_touched_;
  std::vector<PairEnd> touched_;
  std::vector<BodyImpulse> taken_;         // by body
  std::vector<std::uint8_t> felt_;         // by body
  std::vector<std::uint32_t> counted_in_;  // by candidate: the count in which it was last a colliding mass
  std::vector<std::uint32_t> count_;       // by body
  double driven_work_ = 0;
};

}  // namespace palpate::physics
