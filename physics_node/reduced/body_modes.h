#pragma once
// The slowest swings of a body as one that runs asks for them: what each node moves by in a mode, and how far a mode is out now.

#include <span>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/reduced/linear_answer.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {

class BodyModes {
 public:
  /// None where the body is not of hexahedra, or where its modes do not converge.
  /// @param most  modes. Cost: lowest_modes(). Allocates
  BodyModes(const Body& body, int most, const Crew& crew = {});

  std::size_t size() const noexcept { return omega2_.size(); }
  double omega2(std::size_t i) const noexcept { return omega2_[i]; }           // [1/s^2]
  double damping(std::size_t i) const noexcept { return beta_ * omega2_[i]; }  // [1/s]
  /// Of a node, 0 where it is held. [kg^-1/2]
  Vec3 shape(std::size_t i, Index node) const noexcept;
  /// q = Phi^T M u and w = Phi^T M v of all modes. Cost: a pass over the nodes. Contract: takes no memory.
  void measure(const NodeMotion& moving, std::span<double> q, std::span<double> w) const noexcept;

 private:
  const Body* body_;
  double beta_;                   // viscosity over modulus [s]
  std::vector<double> omega2_;    // growing
  std::vector<Vec3> moment_;      // m phi of each node of the body in turn, by mode (n_nodes, n) [kg^1/2]
  std::vector<std::int64_t> at_;  // of each storage cell: its place among the nodes
};

}  // namespace palpate::physics
