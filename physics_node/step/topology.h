#pragma once
// How the nodes of a body hang together, what of it changed in the last step, and what its nodes have been through. Tools that cut
// change it here.

#include <cstdint>
#include <span>

#include "physics_node/body/adjacency.h"
#include "physics_node/body/body.h"
#include "physics_node/body/topology_events.h"
#include "physics_node/step/mass_flags.h"

namespace palpate::physics {

/// What a node has been through.
struct Condition {
  std::uint8_t flags = 0;  // mass_flags.h
  double yielded_share =
      0;  // of its live elements, [0, 1]; of a node without any, whether one had yielded before
};

class Topology {
 public:
  virtual ~Topology() = default;
  const Body& body() const noexcept { return *body_; }

  /// As it is now.
  const Adjacency& adjacency() const noexcept { return adjacency_; }
  virtual TopologyEvents events() const noexcept = 0;
  /// Elements broken or cut since the start, or faces opened.
  virtual std::int64_t breaks() const noexcept = 0;
  /// @param out  one for each of the nodes
  virtual void conditions(std::span<const Index> nodes, std::span<Condition> out) const noexcept = 0;

  /// Elements that live are cut, at the end of the step just integrated: both ends forget them, their elastic energy
  /// is booked as broken, and events() lists them behind what broke in that step. Those that do not live are passed
  /// over. Springs of a body that Body::may_be_cut. Of tetrahedra that may be cut the two of an EdgeGone are
  /// tetrahedra with a common face, which is opened; what that makes elastic energy grow by is booked as broken,
  /// below 0. Of others: 0. Contract: allocates and throws nothing.
  /// @return how many were cut or opened
  virtual std::int64_t cut(std::span<const EdgeGone> elements) noexcept = 0;

  /// Remembers the body as it is, in place of what it remembered before; one that Body::may_be_cut, others nothing.
  /// Contract: allocates and throws nothing.
  virtual void mark() noexcept = 0;
  /// Back to that: places and velocities to the bit, and joined as it was. What is awake in parts comes back to where it rests, as
  /// joined as it was. Its books begin anew, and events() tell nothing, as after a reset.
  virtual void return_to_mark() noexcept = 0;

 protected:
  explicit Topology(const Body& body) : body_(&body) {}
  /// Once, by the maker: what it steps.
  void show(const Adjacency& now) { adjacency_ = now; }

 private:
  const Body* body_;
  Adjacency adjacency_;  // empty until it is shown
};

}  // namespace palpate::physics
