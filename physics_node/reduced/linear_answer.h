#pragma once
// How a body of hexahedra answers small forces about its rest: x = (K + s M)^-1 b, by conjugate gradients with a V-cycle.

#include <Eigen/Core>
#include <vector>

#include "physics_node/step/multigrid/conjugate_gradients.h"

namespace palpate::physics {

/// K the stiffness at rest, M the lumped masses, s a shift that makes a body solvable which nothing holds. Held nodes do not move.
/// A field is a number for each component of each row, 3 * n_rows(): what is held, or no node, has rows of mass 0, which stay 0.
/// Cost: bench touch; some ten V-cycles a solve. Contract: the same bits on any number of threads. Allocates at construction only.
class LinearAnswer {
 public:
  /// The tolerance that modes and driving points ask for. Why: single precision has not much more.
  static constexpr double fine = 1e-5;

  /// @param shift  s, above 0 [1/s^2]
  LinearAnswer(const Body& body, double shift, const Crew& crew = {});

  /// @return did it converge to `tolerance` of |b|? Else x is the nearest that was found.
  bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, const Crew& crew) noexcept;

  Eigen::Index n_rows() const noexcept { return mass_.size() / 3; }
  double shift() const noexcept { return shift_; }
  const Eigen::VectorXd& mass() const noexcept { return mass_; }  // of each component; 0: held [kg]
  /// Six M-orthonormal motions that nothing resists (3 n_rows, 6); none where a node is held. Of a body of one piece.
  const Eigen::MatrixXd& rigid() const noexcept { return rigid_; }
  /// Row of a node of the body; -1: no cell has it.
  Eigen::Index row_of(Index node) const noexcept { return row_of_[static_cast<std::size_t>(node)]; }

 private:
  void find_rigid(const Body& body);

  Hierarchy<float> hierarchy_;
  ConjugateGradients<float> gradients_;
  double shift_;
  Eigen::VectorXd mass_;
  Eigen::MatrixXd rigid_;
  std::vector<Eigen::Index> row_of_;
};

}  // namespace palpate::physics
