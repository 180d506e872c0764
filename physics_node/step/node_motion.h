#pragma once
// Where the nodes of a body are, how fast they move, and who pushes them. Virtual calls are per batch; single nodes are read
// without any.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/step/awake_parts.h"
#include "physics_node/step/node_field.h"

namespace palpate::physics {

struct NodalForce {
  Index cell = 0;
  Vec3 force = Vec3::Zero();  // [N]
};

/// A change of velocity.
struct NodalPush {
  Index cell = 0;
  Vec3 dv = Vec3::Zero();  // [m/s]
};

class NodeMotion {
 public:
  virtual ~NodeMotion() = default;
  const Body& body() const noexcept { return *body_; }

  Vec3 position(Index cell) const noexcept { return body_->rest_position(cell) + displacements_[cell]; }
  Vec3 displacement(Index cell) const noexcept { return displacements_[cell]; }  // from rest [m]
  Vec3 velocity(Index cell) const noexcept { return velocities_[cell]; }         // [m/s]
  /// Of a body that is awake in parts; else null, and any node may move.
  const AwakeParts* parts() const noexcept { return parts_; }

  /// Is it not stepped, since all about it is at rest or far from where it is pressed?
  virtual bool sleeps(Index node) const noexcept = 0;

  /// Some masses at the beginning of the step just integrated: place x, velocity v, and the velocity v_move at which it moved
  /// them. With the explicit integrators v is the mean of v_move before and after the elements acted, so that an impulse that
  /// keeps the energy of v keeps the energy that the integrator keeps.
  /// @param which  of the others, which are as long as each other; @param rest  their rest positions
  virtual void read(std::span<const std::uint32_t> which, std::span<const Index> cells,
                    std::span<const Vec3> rest, double dt, std::span<Vec3> x, std::span<Vec3> v,
                    std::span<Vec3> v_move) const noexcept = 0;
  /// Impulses at the beginning of the step just integrated: add dv to the velocity of a mass and dt dv to its place. A held mass
  /// stays; a sleeping one wakes. With backward_euler, whose step is solved as a whole, they act at its end instead: an impulse
  /// changes the velocity only, and read() tells of the end; but while a step is solved and not over (pending_step.h), read() tells of
  /// its beginning and of the velocity that the solution has. So only hands that lead bodies push there.
  virtual void push(std::span<const NodalPush> pushes, double dt) noexcept = 0;
  /// Adds forces that act during the step just integrated. Held masses ignore them; sleeping rows wake.
  virtual void kick(std::span<const NodalForce> forces, double dt) noexcept = 0;
  /// Of forces on masses that nothing holds, with the velocities that moved them. Their work in an explicit step of dt is dt times
  /// the mean of this before it and when all is done that acts in it. [W]
  virtual double power(std::span<const NodalForce> forces) const noexcept = 0;
  /// Puts one mass where a test, a benchmark or a tool wants it. A held mass stays.
  virtual void place(Index cell, const Vec3& displacement, const Vec3& velocity) noexcept = 0;

 protected:
  explicit NodeMotion(const Body& body) : body_(&body) {}
  /// Once, by the maker: what it steps.
  void show(const NodeField& displacements, const NodeField& velocities) {
    displacements_ = displacements;
    velocities_ = velocities;
  }
  void show(const AwakeParts& parts) { parts_ = &parts; }

 private:
  const Body* body_;
  NodeField displacements_, velocities_;
  const AwakeParts* parts_ = nullptr;
};

/// Gathers pushes on one body and hands them over in batches. Contract: allocates when it is made only.
class PushBatch {
 public:
  PushBatch() { list_.reserve(most); }
  void add(NodeMotion& to, const NodalPush& push, double dt) noexcept {
    list_.push_back(push);
    if (list_.size() == most) give(to, dt);
  }
  void give(NodeMotion& to, double dt) noexcept {
    to.push(list_, dt);
    list_.clear();
  }

 private:
  static constexpr std::size_t most =
      256;  // Why: a virtual call for each costs nothing then, and the batch stays in cache
  std::vector<NodalPush> list_;
};

}  // namespace palpate::physics
