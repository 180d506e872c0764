#pragma once
// A mesh seen through a few large cells: what is slow to solve on the mesh is quick there.

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "common/math/vec3.h"

namespace palpate::physics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Motions of places that are trilinear in the cells of a grid, and the stiffness of such motions.
class CoarseGrid {
 public:
  /// @param places     that may move, in the order of the rows of `stiffness`, three each [m]
  /// @param stiffness  [N/m]
  /// @param edge       of a cell of the grid, about [m]
  CoarseGrid(const std::vector<Vec3>& places, const SparseRows& stiffness, double edge);

  /// Adds the motion that would undo the part of `residual` which the grid sees.
  void correct(const Eigen::VectorXd& residual, Eigen::VectorXd& motion) const;

 private:
  SparseRows to_places_, to_grid_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> stiffness_;
};

}  // namespace palpate::physics
