#pragma once
// Where a body of tetrahedra comes to rest under its weight, without stepping.

#include <vector>

#include "physics_node/body/tet_model.h"

namespace palpate::physics {

enum class TetPreconditioner {
  diagonal,   // of the stiffness near rest
  two_level,  // Chebyshev's polynomial of it, round what a grid of large cells sees
};

struct StaticLoad {
  Vec3 gravity = Vec3::Zero();  // [m/s^2]
  double tolerance = 1e-6;      // |forces that are left| over |weights|
  TetPreconditioner preconditioner = TetPreconditioner::two_level;
};

struct StaticRest {
  std::vector<Vec3> displacement;  // (nodes) [m]
  bool solved = false;
  double residual = 0;   // as `tolerance` has it
  int newton = 0;        // iterations
  int applications = 0;  // of a stiffness to a vector, in all
};

/// Newton's method on conjugate gradients, with the tangent by differences of the forces and a line search down the energy; ends
/// where curvature is not positive with what it has, which leads downhill. Needs held nodes enough.
///
/// Applications to 1e-6 under a small weight, on a jittered cube of 2,028 free nodes that is held at the bottom, Poisson's ratio 0.45
/// and 0.49:
///              plain       nodal pressure   second order
///   diagonal   528, 1112   298, 667         638, 1406
///   two_level  103, 223    78, 158          128, 278
/// On the matrix alone blocks of 3 x 3 took as many as the diagonal or a fifth more; an incomplete Cholesky factor took 44 to 301, each at
/// twice the cost, and longer to make than all of two_level takes.
StaticRest find_rest(const TetModel& model, const StaticLoad& load);

}  // namespace palpate::physics
