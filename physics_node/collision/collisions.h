#pragma once
// Contact between bodies, and of the fragments of a body with each other: one door for the frame that moves them.
//
// A frame first asks which bodies are near at all; where none is, contact is skipped. Then each step, after the masses have
// moved, impulses are found and given.

#include <memory>

#include "common/math/vec3.h"
#include "common/scene/surroundings_spec.h"
#include "physics_node/collision/exchange.h"
#include "physics_node/collision/joint_contact.h"
#include "physics_node/collision/swept_contact.h"

namespace palpate::physics {

struct CollisionTally {
  std::int64_t collisions = 0;  // impulses between two masses, or a mass and a facet
  std::int64_t passages = 0;    // masses that went through a facet; counted only on request
  std::int64_t stopped = 0;     // masses that had to be made to move together
  std::int64_t overflows = 0;   // pairs that found no room in the list
  std::int64_t rebuilds = 0;    // of the list
};

/// What one step of contact did.
struct CollisionWork {
  double lost = 0;    // kinetic energy [J]
  double driven = 0;  // by hands through masses that they drive [J]
};

class Collisions {
 public:
  /// @param fragments  of each body, null where nothing yields; kept up to date before follow_breaks()
  Collisions(const BodyModels& bodies, const std::vector<std::unique_ptr<Fragments>>& fragments,
             const ContactSpec& spec);

  /// Which bodies may touch in the coming frame. @return false: none, so that there is nothing to do in its steps
  bool begin_frame(double frame_seconds) noexcept;

  /// Are two different bodies near in this frame?
  bool bodies_are_near() const noexcept { return bodies_near_; }

  /// After every step, whether anything is near or not: follows elements that broke.
  void follow_breaks() noexcept;
  /// One step of contact in a frame in which something is near, after the masses have moved by it; the bodies have remembered
  /// their velocities before. Contract: allocates and throws nothing.
  CollisionWork step(double dt) noexcept;
  /// With backward_euler in its place: solves the steps of all bodies, those that touch with forces of contact; then they end with
  /// these forces, contact(body). @param tools  forces on each body. Contract: allocates and throws nothing.
  /// @return false: some of what touches is nearer than it should be
  bool solve(const ExplicitStep& step, std::span<const std::vector<NodalForce>> tools) noexcept;
  /// Of what was solved last, by hands through masses that they drive. [J]
  double driven_work() const { return impulses_.driven_work(); }
  std::span<const NodalForce> contact(std::size_t body) const noexcept {
    return joint_contact_->forces(body);
  }

  /// The longest step in which nothing near moves farther than a quarter of the smallest L; only swept contact asks for one.
  /// Shorter within a frame, too, once something there is faster than the frame was planned for.
  double wanted_step() const noexcept { return wanted_step_; }

  /// A hand feels this body.
  void feel(std::size_t body) noexcept { impulses_.feel(static_cast<std::uint32_t>(body)); }
  /// What a body has taken since the last call.
  BodyImpulse take_impulse(std::size_t body) noexcept {
    return impulses_.take(static_cast<std::uint32_t>(body));
  }
  const CollisionTally& tally() const { return tally_; }
  std::size_t n_candidates() const noexcept;
  std::size_t n_pairs() const { return near_.size(); }

  /// After a reset or a restore: everything anew.
  void restart() noexcept;

 private:
  bool are_near(std::uint32_t a, std::uint32_t b, double frame_seconds) noexcept;
  double fastest(std::uint32_t b) const noexcept;
  double fastest_apart(std::uint32_t b) const noexcept;
  void plan_for(double speed) noexcept;
  bool read_all(double dt, double seconds) noexcept;
  bool go_together() const noexcept { return go_together_; }
  void go_with_common(double least) noexcept;
  double closing() const noexcept;
  void end_step(double dt) noexcept;
  bool read_where_they_are(double dt) noexcept;
  void give_impulses(double dt) noexcept;

  ContactSpec spec_;
  bool swept_;
  std::vector<BodyModel*> moving_;
  std::vector<PushBatch> pushes_;  // by body
  std::vector<ContactBody> bodies_;
  NearPairs near_;
  ContactImpulses impulses_;
  std::unique_ptr<SweptContact> swept_contact_;  // swept only
  std::unique_ptr<JointContact> joint_contact_;  // backward_euler only
  CollisionTally tally_;
  std::vector<double>
      apart_;  // of each pair of bodies: how far they may still travel until they could be near [m]
  std::vector<int> stays_near_;  // of each pair of bodies that are: frames until somebody looks again
  std::int64_t active_overflows_ = 0;
  double smallest_L_ = 0;
  double wanted_step_ = 0;
  double planned_for_ = 0;  // this speed [m/s]
  bool bodies_near_ = false;
  double fastest_ =
      0;  // no mass of what is near moves faster in this frame, against what its body does as a whole [m/s]
  bool go_together_ = false;  // some body moves as a whole (common_motion.h)
};

}  // namespace palpate::physics
