#pragma once
// How the nodes of a body hang together, what of it changed in the last step, and what its nodes have been through.

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
  /// Elements broken since the start.
  virtual std::int64_t breaks() const noexcept = 0;
  /// @param out  one for each of the nodes
  virtual void conditions(std::span<const Index> nodes, std::span<Condition> out) const noexcept = 0;

 protected:
  explicit Topology(const Body& body) : body_(&body) {}
  /// Once, by the maker: what it steps.
  void show(const Adjacency& now) { adjacency_ = now; }

 private:
  const Body* body_;
  Adjacency adjacency_;  // empty until it is shown
};

}  // namespace palpate::physics
