#pragma once
// The stiffness of a body of tetrahedra near rest, as a matrix: for references and preconditioners, not for stepping.

#include <Eigen/SparseCore>

#include "physics_node/body/tet_model.h"

namespace palpate::physics {

/// Of all nodes, held or not, by node, then component [N/m].
///   K = sum_t V_t [lambda' g g^T + mu (S x I + ...)] + sum_n lambda V_n G_n G_n^T,   G_n = sum over t at n of V_t / 4 g_t / V_n
/// g the slope of a tetrahedron's volume, lambda' = lambda for plain elements and 0 with nodal pressure, where a node reaches as far as its
/// neighbours' neighbours. Of second order the same sum over points in place of tetrahedra, lambda' = lambda.
Eigen::SparseMatrix<double> tet_stiffness(const TetModel& model);

}  // namespace palpate::physics
